#include "io/sandbox/remote_samples.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <algorithm>
#include <cerrno>

#include "io/sandbox/helper_messages.hpp"
#include "io/sandbox/helper_process.hpp"
#include "io/table/archive.hpp"

namespace corpuscle {

/// The members of a column that are sent.
inline auto byte_fields(Column& c) { return std::tie(c.name, c.unit); }

namespace {

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

constexpr std::size_t max_numbers_in_response = std::size_t{1} << 17;  // exceeded only if a single row has more numbers

class RemoteSamples final : public Samples {
    std::string path_, library_;
    HelperProcess helper_;

    /// Requests rows from the helper and stores them in the columns of `out` from position `done` on.
    Result<void> fetch_part(const FetchRequest& request, std::size_t done, std::vector<std::vector<double>>& out) {
        helper_.send(encode(request));
        auto response = TRY(helper_.receive(path_, library_));
        return decode_rows(response, done, request.rows, out, path_);
    }

public:
    RemoteSamples(std::string path, std::string library, HelperProcess helper)
        : path_(std::move(path)), library_(std::move(library)), helper_(std::move(helper)) {}

    Result<void> open(const TableOptions& options) {
        helper_.send(encode(OpenRequest{path_, options}));
        auto response = TRY(helper_.receive(path_, library_));
        info_ = TRY(decode_info(response, path_));
        return {};
    }

    Result<void> fetch(std::int64_t first, std::size_t rows, std::span<const std::size_t> wanted,
                       std::vector<std::vector<double>>& out) override {
        const std::size_t max_rows = std::max<std::size_t>(1, max_numbers_in_response / std::max<std::size_t>(1, wanted.size()));
        FetchRequest request{0, 0, {wanted.begin(), wanted.end()}};  // first row and number of rows are set below
        for (std::size_t done = 0; done < rows; done += request.rows) {
            request.first = static_cast<std::uint64_t>(first) + done;
            request.rows = std::min(max_rows, rows - done);
            TRY(fetch_part(request, done, out));
        }
        return {};
    }
};

}  // namespace

std::string encode(const OpenRequest& request) { return message_of(request.path, request.options.transpose, request.options.dataset); }

bool decode(const std::string& m, OpenRequest& request) {
    return ByteReader(m).get(request.path, request.options.transpose, request.options.dataset);
}

std::string encode(const FetchRequest& request) { return message_of(request.first, request.rows, request.wanted); }

bool decode(const std::string& m, FetchRequest& request) { return ByteReader(m).get(request.first, request.rows, request.wanted); }

std::string encode(const Error& error) { return message_of(static_cast<std::uint64_t>(error.code), error.message, error.location.file); }

std::string encode(const SamplesInfo& info) {
    return encode_response(info.rows, info.rate, info.start, info.time_column, info.columns, info.notes);
}

std::string encode(const std::vector<std::vector<double>>& columns) {
    ByteWriter out;
    out.put(std::uint64_t{0});  // not an error
    for (const auto& column : columns) out.put_raw(column.data(), column.size() * sizeof(double));
    return out.take();
}

Result<void> decode_status(const std::string& m, const std::string& path) {
    ByteReader in(m);
    return read_status(in, path);
}

Result<SamplesInfo> decode_info(const std::string& m, const std::string& path) {
    ByteReader in(m);
    TRY(read_status(in, path));
    SamplesInfo info;
    if (!in.get(info.rows, info.rate, info.start, info.time_column, info.columns, info.notes) ||
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

SamplesResult open_remote_samples_with(const std::string& program, const std::string& path, const HelperProgram& reader,
                                       const TableOptions& options) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
    if (!file) return bad_input(fmt::format("cannot be opened: {}", std::strerror(errno)), {path});
    auto helper = HelperProcess::start(program, file.get());
    if (!helper) return bad_input(helper.error().message, {path});
    auto samples = std::make_unique<RemoteSamples>(path, reader.library, *std::move(helper));
    TRY(samples->open(options));
    return std::unique_ptr<Samples>(std::move(samples));
}

SamplesResult open_remote_samples(const std::string& path, const HelperProgram& reader, const TableOptions& options) {
    TRY(open_bytes(path));  // for its clear messages, and to register the file as an input
    const auto program = find_helper_program(reader.program);
    if (!program) return bad_input(program.error().message, {path});
    return open_remote_samples_with(*program, path, reader, options);
}

}  // namespace corpuscle
