#include "io/sandbox/samples_message.hpp"

#include "core/bytes.hpp"

namespace corpuscle {

/// The members of a column that are sent.
inline auto byte_fields(Column& c) { return std::tie(c.name, c.unit); }

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
std::string message_of(const T&... values) {
    ByteWriter out;
    out.put(values...);
    return out.take();
}

constexpr std::uint64_t success = 0;  // the status of a response that is not an error

}  // namespace

std::string encode(const OpenRequest& request) { return message_of(request.path, request.options.transpose, request.options.dataset); }

bool decode(const std::string& m, OpenRequest& request) {
    return ByteReader(m).get(request.path, request.options.transpose, request.options.dataset);
}

std::string encode(const FetchRequest& request) { return message_of(request.first, request.rows, request.wanted); }

bool decode(const std::string& m, FetchRequest& request) { return ByteReader(m).get(request.first, request.rows, request.wanted); }

std::string encode(const Error& error) { return message_of(static_cast<std::uint64_t>(error.code), error.message, error.location.file); }

std::string encode(const SamplesInfo& info) {
    return message_of(success, info.rows, info.rate, info.time_column, info.columns, info.notes);
}

std::string encode(const std::vector<std::vector<double>>& columns) {
    ByteWriter out;
    out.put(success);
    for (const auto& column : columns) out.put_raw(column.data(), column.size() * sizeof(double));
    return out.take();
}

Result<SamplesInfo> decode_info(const std::string& m, const std::string& path) {
    ByteReader in(m);
    TRY(read_status(in, path));
    SamplesInfo info;
    if (!in.get(info.rows, info.rate, info.time_column, info.columns, info.notes) ||
        (info.time_column && *info.time_column >= info.columns.size()))
        return broken_response(path);
    return info;
}

Result<void> decode_rows(const std::string& m, std::size_t at, std::size_t rows, std::vector<std::vector<double>>& out,
                         const std::string& path) {
    ByteReader in(m);
    TRY(read_status(in, path));
    for (auto& column : out)
        if (!in.get_raw(column.data() + at, rows * sizeof(double))) return broken_response(path);
    return {};
}

}  // namespace corpuscle
