#include "io/sandbox/samples_message.hpp"

#include <optional>

namespace corpuscle {
namespace {

Error broken_response(const std::string& path) { return bad_input("invalid response of the helper process that reads this file", {path}); }

/// Reads the first number of a response. If it states that the response is an error, returns this error.
Result<void> read_status(Message& m, const std::string& path) {
    std::uint64_t code = 1;
    if (!m.get(code)) return broken_response(path);
    if (code == 0) return {};
    Error error;
    error.code = static_cast<ErrorCode>(code);
    const bool known = error.code == ErrorCode::bad_input || error.code == ErrorCode::bad_usage || error.code == ErrorCode::interrupted;
    if (!known || !m.get(error.message) || !m.get(error.location.file)) return broken_response(path);
    return error;
}

/// An optional number is sent as 0 if it is missing, otherwise as the number plus 1.
void put_optional(Message& m, std::optional<std::size_t> n) { m.put(n ? *n + 1 : 0); }

bool get_optional(Message& m, std::optional<std::size_t>& out) {
    std::uint64_t n = 0;
    if (!m.get(n)) return false;
    out = n > 0 ? std::optional<std::size_t>(n - 1) : std::nullopt;
    return true;
}

void put_texts(Message& m, const std::vector<std::string>& texts) {
    m.put(texts.size());
    for (const auto& t : texts) m.put(t);
}

bool get_texts(Message& m, std::vector<std::string>& texts) {
    std::uint64_t count = 0;
    bool is_complete = m.get(count);
    for (std::string text; is_complete && texts.size() < count;) {
        is_complete = m.get(text);
        texts.push_back(text);
    }
    return is_complete;
}

}  // namespace

Message encode(const OpenRequest& request) {
    Message m;
    m.put(request.path);
    m.put(request.options.transpose ? 1 + static_cast<std::uint64_t>(*request.options.transpose)
                                    : 0);  // 0 if not set, 1 for false, 2 for true
    m.put(request.options.dataset ? 1 : 0);
    m.put(request.options.dataset.value_or(""));
    return m;
}

bool decode(Message& m, OpenRequest& request) {
    std::uint64_t transpose = 0, has_dataset = 0;
    std::string dataset;
    if (!m.get(request.path) || !m.get(transpose) || !m.get(has_dataset) || !m.get(dataset)) return false;
    if (transpose) request.options.transpose = transpose == 2;
    if (has_dataset) request.options.dataset = std::move(dataset);
    return true;
}

Message encode(const FetchRequest& request) {
    Message m;
    m.put(request.first), m.put(request.rows), m.put(request.wanted.size());
    m.put(request.wanted.data(), request.wanted.size() * sizeof(std::size_t));
    return m;
}

bool decode(Message& m, FetchRequest& request) {
    std::uint64_t count = 0;
    if (!m.get(request.first) || !m.get(request.rows) || !m.get(count) || count > m.bytes().size()) return false;  // a wrong count
    request.wanted.resize(count);
    return m.get(request.wanted.data(), count * sizeof(std::size_t));
}

Message encode(const Error& error) {
    Message m;
    m.put(static_cast<std::uint64_t>(error.code));
    m.put(error.message);
    m.put(error.location.file);
    return m;
}

Message encode(const SamplesInfo& info) {
    Message m;
    m.put(0);
    m.put(static_cast<std::uint64_t>(info.rows));
    const double rate = info.rate.value_or(0);
    m.put(&rate, sizeof rate);
    put_optional(m, info.time_column);
    m.put(info.columns.size());
    for (const auto& c : info.columns) m.put(c.name), m.put(c.unit);
    put_texts(m, info.notes);
    return m;
}

Message encode(const std::vector<std::vector<double>>& columns) {
    Message m;
    m.put(0);
    for (const auto& column : columns) m.put(column.data(), column.size() * sizeof(double));
    return m;
}

Result<SamplesInfo> decode_info(Message& m, const std::string& path) {
    SamplesInfo info;
    TRY(read_status(m, path));
    std::uint64_t rows = 0, columns = 0;
    double rate = 0;
    bool is_complete = m.get(rows) && m.get(&rate, sizeof rate) && get_optional(m, info.time_column) && m.get(columns);
    info.rows = static_cast<std::int64_t>(rows);
    if (rate != 0) info.rate = rate;
    for (std::uint64_t k = 0; is_complete && k < columns; ++k) {
        Column c;
        is_complete = m.get(c.name) && m.get(c.unit);
        info.columns.push_back(std::move(c));
    }
    if (!is_complete || !get_texts(m, info.notes) || (info.time_column && *info.time_column >= info.columns.size()))
        return broken_response(path);
    return info;
}

Result<void> decode_rows(Message& m, std::size_t at, std::size_t rows, std::vector<std::vector<double>>& out, const std::string& path) {
    TRY(read_status(m, path));
    for (auto& column : out)
        if (!m.get(column.data() + at, rows * sizeof(double))) return broken_response(path);
    return {};
}

}  // namespace corpuscle
