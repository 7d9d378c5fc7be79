#include "core/text/input_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <vector>

namespace corpuscle {
namespace {

/// The registered inputs.
struct InputFiles {
    std::mutex mutex;
    std::map<std::pair<dev_t, ino_t>, std::string> paths;  // by device and inode
};

InputFiles& input_files() {
    static InputFiles all;
    return all;
}

/// Device and inode of a regular file; nullopt if `path` is not one.
std::optional<std::pair<dev_t, ino_t>> identity_of(const std::string& path) {
    struct ::stat file_status = {};
    const bool found = path == "-" ? ::fstat(0, &file_status) == 0 : ::stat(path.c_str(), &file_status) == 0;
    if (!found || !S_ISREG(file_status.st_mode)) return {};
    return std::pair{file_status.st_dev, file_status.st_ino};
}

std::atomic<bool (*)()> interruption_check = nullptr;  // null: no function was set

bool is_interrupted() {
    const auto check = interruption_check.load();
    return check && check();
}

constexpr int poll_ms = 100;  // a signal that arrives just before poll() is noticed after at most this time

/// Like read(), but returns -1 with errno EINTR as soon as is_interrupted() is true. Other signals do not end it.
ssize_t read_when_ready(int file, std::span<char> to) {
    for (;;) {
        if (is_interrupted()) return errno = EINTR, -1;
        pollfd ready = {file, POLLIN, 0};
        const int count = ::poll(&ready, 1, poll_ms);
        if (count == 0 || (count < 0 && errno == EINTR)) continue;
        const auto got = ::read(file, to.data(), to.size());
        if (got >= 0 || (errno != EINTR && errno != EAGAIN)) return got;
    }
}

}  // namespace

void remember_input(const std::string& path) {
    const auto identity = identity_of(path);
    if (!identity) return;
    const std::scoped_lock lock(input_files().mutex);
    input_files().paths.try_emplace(*identity, path);
}

std::optional<std::string> known_input_path(const std::string& path) {
    const auto identity = path == "-" ? std::nullopt : identity_of(path);
    if (!identity) return {};
    const std::scoped_lock lock(input_files().mutex);
    const auto at = input_files().paths.find(*identity);
    if (at == input_files().paths.end()) return {};
    if (identity_of(at->second) == identity) return at->second;
    input_files().paths.erase(at);  // the input was deleted, and its inode now belongs to another file
    return {};
}

void set_interruption_check(bool (*is_interrupted)()) { interruption_check = is_interrupted; }

FileHandle open_input(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (file < 0) return {};
    ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);  // only open() must not wait; reads do
    remember_input(path);
    return FileHandle(::fdopen(file, "rb"));
}

Result<std::size_t> read_input(std::FILE* file, std::span<char> to, const std::string& name) {
    struct ::stat file_status = {};
    const auto error = [&] { return bad_input(std::string("cannot be read: ") + std::strerror(errno), {name}); };
    if (::fstat(::fileno(file), &file_status) == 0 && S_ISREG(file_status.st_mode)) {
        const auto got = std::fread(to.data(), 1, to.size(), file);
        if (got < to.size() && std::ferror(file)) return error();
        return got;
    }
    std::size_t filled = 0;
    while (filled < to.size()) {
        const auto got = read_when_ready(::fileno(file), to.subspan(filled));
        if (got < 0 && errno == EINTR) return Error{ErrorCode::interrupted, "interrupted", {name}};
        if (got < 0) return error();
        if (got == 0) break;
        filled += static_cast<std::size_t>(got);
    }
    return filled;
}

Result<std::string> read_entire_input(const std::string& path, std::size_t max_bytes, const std::string& kind) {
    struct ::stat file_status = {};
    if (::stat(path.c_str(), &file_status) == 0 && S_ISDIR(file_status.st_mode))
        return bad_input(fmt::format("this is a directory, not a {}", kind), {path});
    const auto file = open_input(path);
    if (!file)
        return bad_input(fmt::format("cannot be read: {}", errno == ENOENT ? "there is no such file" : std::strerror(errno)), {path});
    std::string text;
    for (std::vector<char> block(std::size_t{1} << 16);;) {
        const auto got = TRY(read_input(file.get(), block, path));
        text.append(block.data(), got);
        if (text.size() > max_bytes) return bad_input(fmt::format("not a {}: it is larger than {} MB", kind, max_bytes >> 20), {path});
        if (got < block.size()) return text;
    }
}

std::string peek_input(const std::string& path, std::size_t count) {
    struct ::stat file_status = {};
    if (::stat(path.c_str(), &file_status) != 0 || !S_ISREG(file_status.st_mode)) return {};
    const FileHandle file(std::fopen(path.c_str(), "rbe"));
    std::string first(count, '\0');
    first.resize(file ? std::fread(first.data(), 1, count, file.get()) : 0);
    return first;
}

}  // namespace corpuscle
