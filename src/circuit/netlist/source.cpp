// What a V or I gives: DC, AC and its course in time.

#include <fmt/format.h>
#include <algorithm>

#include "circuit/netlist/flat.hpp"
#include "circuit/netlist/number.hpp"
#include "signal/field.hpp"

namespace corpuscle::circuit {
namespace {

using Shape = Waveform::Shape;

struct ShapeRow {
    std::string_view name;
    Shape shape;
    std::size_t least, most;
    std::string_view sentence;
};
constexpr ShapeRow shapes[] = {
    {"pulse", Shape::pulse, 2, 8, "pulse(v1 v2 td tr tf pw per np)"},  {"sin", Shape::sine, 2, 6, "sin(vo va freq td theta phase)"},
    {"exp", Shape::exponential, 2, 6, "exp(v1 v2 td1 tau1 td2 tau2)"}, {"pwl", Shape::points, 2, most_elements, "pwl(t1 v1 t2 v2 ...)"},
    {"force", Shape::force, 0, 1, "force, or force and a scale"},
};
const ShapeRow* shape_of(std::string_view word) {
    for (const auto& row : shapes)
        if (row.name == word) return &row;
    return nullptr;
}

class SourceReader {
    const Frame& frame_;
    const Statement& s_;
    std::size_t k_ = 3;  // the word that comes
    Waveform out_;
    std::vector<std::size_t> number_words_;

public:
    SourceReader(const Frame& frame, const Statement& s) : frame_(frame), s_(s) {}

    Result<Waveform> read() {
        if (number_comes())
            if (const auto ok = dc(); !ok) return ok.error();
        while (k_ < s_.words.size())
            if (const auto ok = part(); !ok) return ok.error();
        for (const auto& pair : s_.named)
            if (const auto ok = named(pair); !ok) return ok.error();
        return std::move(out_);
    }

private:
    bool keyword(std::size_t k) const {
        const auto w = s_.text(k);
        return s_.words[k].kind == Word::Kind::plain && (w == "dc" || w == "ac" || shape_of(w));
    }
    bool number_comes() const {
        if (k_ >= s_.words.size() || keyword(k_)) return false;
        return s_.words[k_].kind != Word::Kind::plain || whole_number(s_.text(k_)) || frame_.parameter(s_.text(k_));
    }
    Result<double> number() {
        const Text text{&s_, s_.words[k_++]};
        return frame_.number(text);
    }
    Error wrong(std::string_view sentence, std::size_t k) const {
        return bad_input(fmt::format("{}: {}", s_.text(std::size_t{0}), sentence), s_.place(k));
    }

    Result<void> dc() {
        if (k_ >= s_.words.size() || keyword(k_)) return wrong("dc wants a number", k_);
        if (out_.has_dc) return wrong("a second dc value", k_);
        const auto value = number();
        if (!value) return value.error();
        out_.dc = *value, out_.has_dc = true;
        return {};
    }

    Result<void> ac() {
        out_.ac_magnitude = 1;
        for (double* to : {&out_.ac_magnitude, &out_.ac_phase}) {
            if (k_ >= s_.words.size() || keyword(k_)) return {};
            const auto value = number();
            if (!value) return value.error();
            *to = *value;
        }
        return {};
    }

    Result<void> part() {
        const auto w = s_.text(k_);
        if (w == "dc") return ++k_, dc();
        if (w == "ac") return ++k_, ac();
        const auto* row = shape_of(w);
        if (!row) return wrong(unknown(w), k_);
        if (out_.shape != Shape::none) return wrong(fmt::format("a second course in time, '{}'", w), k_);
        ++k_;
        return shape(*row);
    }

    static std::string unknown(std::string_view w) {
        constexpr std::string_view known[] = {"dc", "ac", "pulse", "sin", "exp", "pwl", "force"};
        if (w == "sffm" || w == "am" || w == "trnoise" || w == "trrandom" || w == "external")
            return fmt::format("{} sources are not read; known are pulse, sin, exp, pwl and force", w);
        return fmt::format("unknown word '{}'{}", w, did_you_mean(w, known));
    }

    Result<void> shape(const ShapeRow& row) {
        out_.shape = row.shape;
        const auto head = k_ - 1;
        while (k_ < s_.words.size() && !keyword(k_)) {
            number_words_.push_back(k_);
            const auto value = number();
            if (!value) return value.error();
            out_.numbers.push_back(*value);
        }
        const auto n = out_.numbers.size();
        if (n < row.least || n > row.most)
            return wrong(fmt::format("{} has {} number{}; wanted is {}{}", row.name, n, n == 1 ? "" : "s", row.sentence,
                                     n > row.most ? fmt::format(" with at most {}", row.most) : ""),
                         head);
        if (row.shape == Shape::force && n == 0) out_.numbers = {1};
        return row.shape == Shape::points ? points() : Result<void>();
    }

    Result<void> points() {
        const auto& x = out_.numbers;
        if (x.size() % 2)
            return wrong(fmt::format("pwl has {} numbers; they come in pairs of a time and a value", x.size()), number_words_.back());
        for (std::size_t k = 2; k < x.size(); k += 2)
            if (x[k] <= x[k - 2]) return wrong(fmt::format("pwl: time {:g} does not come after {:g}", x[k], x[k - 2]), number_words_[k]);
        return {};
    }

    Result<void> named(const Named& pair) {
        const auto name = s_.text(pair.name);
        const auto refuse = [&](std::string_view why) {
            return bad_input(fmt::format("{}: {}", s_.text(std::size_t{0}), why), s_.place(pair.name));
        };
        const auto value = frame_.number({&s_, pair.value});
        if (!value) return value.error();
        if (name == "dc" && !out_.has_dc)
            out_.dc = *value, out_.has_dc = true;
        else if (name == "ac" && out_.ac_magnitude == 0)
            out_.ac_magnitude = *value;
        else if (name == "td" && out_.shape == Shape::points)
            for (std::size_t k = 0; k < out_.numbers.size(); k += 2) out_.numbers[k] += *value;
        else if (name == "r" && out_.shape == Shape::points)
            return refuse("a pwl that repeats (r=) is not read");
        else if (name == "td" || name == "r")
            return refuse(fmt::format("{}= goes with pwl alone", name));
        else if (name == "dc" || name == "ac")
            return refuse(fmt::format("a second {} value", name));
        return {};
    }
};

}  // namespace

Result<Waveform> read_waveform(const Frame& frame, const Statement& s) { return SourceReader(frame, s).read(); }

}  // namespace corpuscle::circuit
