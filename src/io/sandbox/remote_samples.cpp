#include "io/sandbox/remote_samples.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "io/sandbox/helper_process.hpp"
#include "io/sandbox/samples_message.hpp"
#include "io/table/archive.hpp"

namespace corpuscle {
namespace {

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
