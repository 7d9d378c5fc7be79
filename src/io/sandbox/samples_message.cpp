#include "io/sandbox/samples_message.hpp"

#include "core/bytes.hpp"

namespace corpuscle {
namespace {

Error broken_response(const std::string& path) { return bad_input("invalid response of the helper process that reads this file", {path}); }

/// Reads the first number of a response. If it states that the response is an error, returns this error.
Result<void> read_status(ByteReader& in, const std::string& path) {
    std::uint64_t code = 1;
    if (!in.get(code)) return broken_response(path);
    if (code == 0) return {};
    Error error;
    error.code = static_cast<ErrorCode>(code);
    const bool known = error.code == ErrorCode::bad_input || error.code == ErrorCode::bad_usage || error.code == ErrorCode::interrupted;
    if (!known || !in.get(error.message, error.location.file)) return broken_response(path);
    return error;
}

template <class... T>
Message message_of(const T&... values) {
    ByteWriter out;
    out.put(values...);
    return Message(out.take());
}

constexpr std::uint64_t success = 0;  // the status of a response that is not an error

}  // namespace

Message encode(const OpenRequest& request) { return message_of(request.path, request.options.transpose, request.options.dataset); }

bool decode(const Message& m, OpenRequest& request) {
    return ByteReader(m.bytes()).get(request.path, request.options.transpose, request.options.dataset);
}

Message encode(const FetchRequest& request) { return message_of(request.first, request.rows, request.wanted); }

bool decode(const Message& m, FetchRequest& request) { return ByteReader(m.bytes()).get(request.first, request.rows, request.wanted); }

Message encode(const Error& error) { return message_of(static_cast<std::uint64_t>(error.code), error.message, error.location.file); }

Message encode(const SamplesInfo& info) {
    std::vector<std::pair<std::string, std::string>> columns;
    for (const auto& c : info.columns) columns.emplace_back(c.name, c.unit);
    return message_of(success, info.rows, info.rate, info.time_column, columns, info.notes);
}

Message encode(const std::vector<std::vector<double>>& columns) {
    ByteWriter out;
    out.put(success);
    for (const auto& column : columns) out.put_raw(column.data(), column.size() * sizeof(double));
    return Message(out.take());
}

Result<SamplesInfo> decode_info(const Message& m, const std::string& path) {
    ByteReader in(m.bytes());
    TRY(read_status(in, path));
    SamplesInfo info;
    std::vector<std::pair<std::string, std::string>> columns;
    if (!in.get(info.rows, info.rate, info.time_column, columns, info.notes) || (info.time_column && *info.time_column >= columns.size()))
        return broken_response(path);
    for (auto& [name, unit] : columns) info.columns.push_back({std::move(name), std::move(unit)});
    return info;
}

Result<void> decode_rows(const Message& m, std::size_t at, std::size_t rows, std::vector<std::vector<double>>& out,
                         const std::string& path) {
    ByteReader in(m.bytes());
    TRY(read_status(in, path));
    for (auto& column : out)
        if (!in.get_raw(column.data() + at, rows * sizeof(double))) return broken_response(path);
    return {};
}

}  // namespace corpuscle
