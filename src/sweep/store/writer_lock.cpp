#include "sweep/store/writer_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <sstream>

#include "io/output/output_check.hpp"

namespace corpuscle {
namespace {

std::string lock_path(const std::string& results) { return results + "-writer"; }

/// `kind`: F_RDLCK or F_WRLCK.
struct flock whole_file_lock(short kind) {
    struct flock lock = {};
    lock.l_type = kind;
    lock.l_whence = SEEK_SET;
    return lock;
}

/// The content of a lock file as write_progress() writes it; all members are 0 or empty if the file is empty. No value: anything else.
std::optional<WriterLock::Writer> read_writer(int file) {
    std::array<char, 512> text = {};
    const auto size = ::pread(file, text.data(), text.size() - 1, 0);
    WriterLock::Writer out;
    if (size == 0) return out;
    std::istringstream words(text.data());
    std::string more;
    if (size < 0 || !(words >> out.process >> out.since >> out.finished >> out.planned >> out.host) || words >> more) return {};
    return out;
}

/// True if the file is empty or looks as if write_progress() wrote it. Any other file must not be overwritten.
bool is_ours(int file) {
    struct stat status = {};
    return ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1 && status.st_size < 512 && read_writer(file);
}

/// `why`: a verb and its object, such as "is a link".
Error not_ours(const std::string& path, std::string_view why) {
    return bad_input(fmt::format("is at the path of the results' lock file, but {}; move it away, or give another "
                                 "file with --out",
                                 why),
                     {path});
}

Error locked_error(const std::string& results) {
    const auto holder = WriterLock::holder(results);
    const auto writer =
        holder && holder->process ? fmt::format("process {} on {}", holder->process, holder->host) : std::string("another process");
    return bad_input(fmt::format("is being written by {}; 'corpuscle sweep FILE --status' shows its progress. Wait for it, or give another "
                                 "file with --out (each shard needs a separate file, for 'corpuscle sweep merge')",
                                 writer),
                     {results});
}

}  // namespace

WriterLock::~WriterLock() { ::unlink(path_.c_str()); }

Result<std::unique_ptr<WriterLock>> WriterLock::take(const std::string& results) {
    const auto path = lock_path(results);
    for (;;) {
        Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
        if (!file && errno == ELOOP) return not_ours(path, "is a link");
        if (!file)
            return bad_input(fmt::format("cannot be written: its folder is not writable ({}); give a writable path "
                                         "with --out",
                                         std::strerror(errno)),
                             {results});
        auto lock_range = whole_file_lock(F_WRLCK);
        if (::fcntl(file.get(), F_OFD_SETLK, &lock_range) != 0) {
            if (errno == EAGAIN || errno == EACCES) return locked_error(results);
            return bad_input(fmt::format("cannot be locked ({}): does this file system support locks?", std::strerror(errno)), {path});
        }
        if (!is_file_at(file.get(), path)) continue;
        if (!is_ours(file.get())) return not_ours(path, "has other content");
        auto lock = std::make_unique<WriterLock>(path, std::move(file));
        lock->write_progress(0, 0);
        return lock;
    }
}

void WriterLock::write_progress(std::int64_t finished, std::int64_t planned) const {
    std::array<char, 256> host = {};
    ::gethostname(host.data(), host.size() - 1);
    const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    const auto text = fmt::format("{} {:.3f} {} {} {}\n", ::getpid(), now, finished, planned, host[0] ? host.data() : "-");
    // The content is only for messages, so errors, such as a full disk, are ignored.
    if (::ftruncate(file_.get(), 0) == 0) [[maybe_unused]]
        const auto written = ::pwrite(file_.get(), text.data(), text.size(), 0);
}

std::optional<WriterLock::Writer> WriterLock::holder(const std::string& results) {
    const Descriptor file(::open(lock_path(results).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (!file) return {};
    auto lock_range = whole_file_lock(F_RDLCK);
    const bool is_free = ::fcntl(file.get(), F_OFD_GETLK, &lock_range) == 0 && lock_range.l_type == F_UNLCK;
    if (is_free) return {};
    return read_writer(file.get()).value_or(Writer{});
}

}  // namespace corpuscle
