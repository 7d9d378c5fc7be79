#include "io/remote_samples.hpp"

#include <algorithm>
#include <cstring>
#include <new>

#include "io/helper_process.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t most_numbers = std::size_t{1} << 17;  // in an answer, if it is more than one row

void put(Message& m, const Error& error) {
    m.put(static_cast<std::uint64_t>(error.code));
    m.put(error.sentence);
    m.put(error.place.file);
}

void put(Message& m, const SamplesFacts& facts) {
    m.put(0);
    m.put(static_cast<std::uint64_t>(facts.rows));
    const double rate = facts.rate.value_or(0);
    m.put(&rate, sizeof rate);
    m.put(facts.time ? *facts.time + 1 : 0);
    m.put(facts.columns.size());
    for (const auto& c : facts.columns) m.put(c.name), m.put(c.unit);
}

/// The error at the beginning of an answer, if it is one.
std::optional<Error> error_in(Message& m) {
    std::uint64_t code = 1;
    Error error = bad_input("the answer of the process that reads it is broken");
    if (!m.get(code)) return error;
    if (code == 0) return {};
    error.code = static_cast<Code>(code);
    if (!m.get(error.sentence) || !m.get(error.place.file)) error.code = Code::bad_input;
    return error;
}

Result<SamplesFacts> facts_in(Message& m) {
    SamplesFacts facts;
    if (auto error = error_in(m)) return *std::move(error);
    std::uint64_t rows = 0, time = 0, columns = 0;
    double rate = 0;
    bool whole = m.get(rows) && m.get(&rate, sizeof rate) && m.get(time) && m.get(columns);
    facts.rows = static_cast<std::int64_t>(rows);
    if (rate != 0) facts.rate = rate;
    if (time > 0) facts.time = time - 1;
    for (std::uint64_t k = 0; whole && k < columns; ++k) {
        Column c;
        whole = m.get(c.name) && m.get(c.unit);
        facts.columns.push_back(std::move(c));
    }
    if (!whole) return bad_input("the answer of the process that reads it is broken");
    return facts;
}

/// What is asked for: rows from a number on, of columns.
struct Question {
    std::uint64_t first = 0, rows = 0;
    std::vector<std::size_t> wanted = {};

    Message message() const {
        Message m;
        m.put(first), m.put(rows), m.put(wanted.size());
        m.put(wanted.data(), wanted.size() * sizeof(std::size_t));
        return m;
    }
    bool read(Message& m) {
        std::uint64_t count = 0;
        if (!m.get(first) || !m.get(rows) || !m.get(count)) return false;
        wanted.resize(count);
        return m.get(wanted.data(), count * sizeof(std::size_t));
    }
};

Message answer_to(const Question& question, Samples& samples) {
    Message m;
    std::vector<std::vector<double>> out(question.wanted.size(), std::vector<double>(question.rows));
    if (auto ok = samples.fetch(static_cast<std::int64_t>(question.first), question.rows, question.wanted, out); !ok)
        return put(m, ok.error()), m;
    m.put(0);
    for (const auto& column : out) m.put(column.data(), column.size() * sizeof(double));
    return m;
}

/// The child's life.
void serve(int socket, const std::string& path, const std::function<SamplesResult()>& open) {
    try {
        Message first;
        auto samples = open();
        samples ? put(first, (*samples)->facts()) : put(first, samples.error());
        if (!give_answer(socket, first) || !samples) return;
        Question question;
        for (Message m; next_question(socket, m) && question.read(m);)
            if (!give_answer(socket, answer_to(question, **samples))) return;
    } catch (const std::bad_alloc&) {
        Message m;
        put(m, bad_input("this file takes more memory than there is", {path}));
        give_answer(socket, m);
    }
}

class RemoteSamples final : public Samples {
    std::string path_, library_;
    HelperProcess helper_;
    SamplesFacts facts_;

    Result<void> fetch_piece(const Question& question, std::size_t done, std::vector<std::vector<double>>& out) {
        helper_.ask(question.message());
        auto answer = helper_.answer(path_, library_);
        if (!answer) return answer.error();
        if (auto error = error_in(*answer)) return *std::move(error);
        for (auto& column : out)
            if (!answer->get(column.data() + done, question.rows * sizeof(double)))
                return bad_input("the answer of the process that reads it is broken", {path_});
        return {};
    }

public:
    RemoteSamples(std::string path, std::string library, HelperProcess helper)
        : path_(std::move(path)), library_(std::move(library)), helper_(std::move(helper)) {}

    Result<void> open() {
        auto answer = helper_.answer(path_, library_);
        if (!answer) return answer.error();
        auto facts = facts_in(*answer);
        if (!facts) return facts.error();
        facts_ = *std::move(facts);
        return {};
    }

    const SamplesFacts& facts() const override { return facts_; }

    Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        const std::size_t most = std::max<std::size_t>(1, most_numbers / std::max<std::size_t>(1, wanted.size()));
        Question question{0, 0, {wanted.begin(), wanted.end()}};
        for (std::size_t done = 0; done < rows; done += question.rows) {
            question.first = static_cast<std::uint64_t>(first) + done;
            question.rows = std::min(most, rows - done);
            if (auto ok = fetch_piece(question, done, out); !ok) return ok;
        }
        return {};
    }
};

}  // namespace

SamplesResult in_helper_process(const std::string& path, const std::string& library, const std::function<SamplesResult()>& open) {
    auto helper = HelperProcess::start([&](int socket) { serve(socket, path, open); });
    if (!helper) return helper.error();
    auto samples = std::make_unique<RemoteSamples>(path, library, *std::move(helper));
    if (auto ok = samples->open(); !ok) return ok.error();
    return std::unique_ptr<Samples>(std::move(samples));
}

}  // namespace corpuscle
