#include "study/sweep/writer_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <sstream>
#include <utility>

namespace corpuscle {
namespace {

std::string lock_path(const std::string& results) { return results + "-writer"; }

struct flock all_of_it(short kind) {
    struct flock lock = {};
    lock.l_type = kind;
    lock.l_whence = SEEK_SET;
    return lock;
}

/// Whether what is open here is what stands there: the one who had the lock before may have removed it meanwhile.
bool still_there(int file, const std::string& path) {
    struct stat open_one = {}, there = {};
    return ::fstat(file, &open_one) == 0 && ::stat(path.c_str(), &there) == 0 && open_one.st_ino == there.st_ino &&
           open_one.st_dev == there.st_dev;
}

/// Whether it is empty, or what note() writes: anything else is somebody's file and must not be emptied.
bool is_ours(int file) {
    struct stat status = {};
    if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode) || status.st_nlink > 1 || status.st_size > 512) return false;
    if (status.st_size == 0) return true;
    std::array<char, 513> text = {};
    if (::pread(file, text.data(), text.size() - 1, 0) <= 0) return false;
    std::istringstream words(text.data());
    double process = 0, since = 0, finished = 0, to_do = 0;
    std::string host, more;
    return static_cast<bool>(words >> process >> since >> finished >> to_do >> host) && !(words >> more);
}

Error not_ours(const std::string& path, std::string_view why) {
    return bad_input(fmt::format("stands where the mark of the one who writes the results would be, and {}; move it away, or give another "
                                 "file with --out",
                                 why),
                     {path});
}

Error held(const std::string& results) {
    const auto who = WriterLock::holder(results);
    const auto whom = who && who->process ? fmt::format("process {} on {}", who->process, who->host) : std::string("another process");
    return bad_input(fmt::format("is being written by {}; 'corpuscle sweep FILE --status' says how far it is. Wait for it, or give another "
                                 "file with --out (shards have one each, for 'corpuscle sweep merge')",
                                 whom),
                     {results});
}

}  // namespace

WriterLock::WriterLock(WriterLock&& other) noexcept : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}
WriterLock& WriterLock::operator=(WriterLock&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(file_, other.file_);
    return *this;
}
WriterLock::~WriterLock() {
    if (file_ < 0) return;
    ::unlink(path_.c_str());
    ::close(file_);
}

Result<WriterLock> WriterLock::take(const std::string& results) {
    WriterLock lock;
    const auto path = lock_path(results);
    for (;;) {
        const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (file < 0 && errno == ELOOP) return not_ours(path, "is a link");
        if (file < 0)
            return bad_input(fmt::format("cannot be written: there is no making a file beside it ({}); give a place that can be written "
                                         "to with --out",
                                         std::strerror(errno)),
                             {results});
        auto whole = all_of_it(F_WRLCK);
        if (::fcntl(file, F_OFD_SETLK, &whole) != 0) {
            const int cause = errno;
            ::close(file);
            if (cause == EAGAIN || cause == EACCES) return held(results);
            return bad_input(fmt::format("cannot be locked ({}): is this file system one that knows locks?", std::strerror(cause)), {path});
        }
        if (still_there(file, path)) {
            if (!is_ours(file)) return ::close(file), not_ours(path, "holds something else");
            lock.path_ = path, lock.file_ = file;
            lock.note(0, 0);
            return lock;
        }
        ::close(file);
    }
}

void WriterLock::note(std::int64_t finished, std::int64_t to_do) const {
    std::array<char, 256> host = {};
    ::gethostname(host.data(), host.size() - 1);
    const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    const auto text = fmt::format("{} {:.3f} {} {} {}\n", ::getpid(), now, finished, to_do, host[0] ? host.data() : "-");
    // It is told to people only; on a full disk it is left out.
    if (::ftruncate(file_, 0) == 0) [[maybe_unused]]
        const auto written = ::pwrite(file_, text.data(), text.size(), 0);
}

std::optional<WriterLock::Writer> WriterLock::holder(const std::string& results) {
    const int file = ::open(lock_path(results).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) return {};
    auto whole = all_of_it(F_RDLCK);
    const bool free = ::fcntl(file, F_OFD_GETLK, &whole) == 0 && whole.l_type == F_UNLCK;
    std::array<char, 512> text = {};
    const auto size = ::read(file, text.data(), text.size() - 1);
    ::close(file);
    if (free) return {};
    Writer out;
    if (size > 0) std::istringstream(text.data()) >> out.process >> out.since >> out.finished >> out.to_do >> out.host;
    return out;
}

}  // namespace corpuscle
