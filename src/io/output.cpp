#include "io/output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace corpuscle {

OutputFile::OutputFile(OutputFile&& o) noexcept
    : path_(std::move(o.path_)), part_(std::move(o.part_)), made_(std::move(o.made_)), file_(std::exchange(o.file_, nullptr)),
      size_(o.size_), grows_(o.grows_), synced_(o.synced_), begun_(o.begun_) {
    o.part_.clear();
}

OutputFile& OutputFile::operator=(OutputFile&& o) noexcept {
    std::swap(path_, o.path_), std::swap(part_, o.part_), std::swap(made_, o.made_), std::swap(file_, o.file_), std::swap(size_, o.size_),
        std::swap(grows_, o.grows_), std::swap(synced_, o.synced_), std::swap(begun_, o.begun_);
    return *this;
}

OutputFile::~OutputFile() {
    if (file_) std::fclose(file_);
    if (part_.empty()) return;
    std::remove(part_.c_str());
    for (const auto& directory : made_) ::rmdir(directory.c_str());  // leaves it if something else is in it
}

/// The directories above it.
Result<OutputFile> OutputFile::prepare(const std::string& path) {
    std::error_code status;
    const auto above = std::filesystem::path(path).parent_path();
    std::vector<std::string> made;  // the directories that were not there before, the innermost first
    for (auto d = above; !d.empty() && !std::filesystem::exists(d, status); d = d.parent_path()) made.push_back(d.string());
    status.clear();
    if (!above.empty()) std::filesystem::create_directories(above, status);
    if (status) return bad_input(fmt::format("the directory cannot be made: {}", status.message()), {above.string()});
    if (std::filesystem::is_directory(path, status)) return bad_input("this is a directory, not a file to write", {path});
    OutputFile out;
    out.path_ = path;
    out.made_ = std::move(made);
    return out;
}

Error OutputFile::broken() const { return bad_input(fmt::format("cannot be written to the end: {}", std::strerror(errno)), {path_}); }

namespace {

bool is_device(const std::string& path) {
    struct ::stat facts = {};
    return ::stat(path.c_str(), &facts) == 0 && !S_ISREG(facts.st_mode);
}

/// A new file beside the output: path.part-PID, or path.part-PID-2 ... Links are not followed. Its lock tells other runs that it is in
/// use; -1: errno says why it cannot be made.
int new_part(const std::string& path, std::string& part) {
    constexpr int most_tries = 1000;
    for (int k = 1; k <= most_tries; ++k) {
        part = fmt::format("{}.part-{}{}", path, ::getpid(), k == 1 ? "" : fmt::format("-{}", k));
        const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file < 0 && errno == EEXIST) continue;
        if (file < 0) return file;
        struct ::stat facts = {};
        (void)::flock(file, LOCK_EX | LOCK_NB);  // a file system without locks: then nothing is ever removed as abandoned
        if (::fstat(file, &facts) == 0 && facts.st_nlink > 0) return file;
        ::close(file);
    }
    errno = EEXIST;
    return -1;
}

/// The file this name stands for, for this program alone and empty; -1: errno says why. Another program may put its own in place between
/// the opening and the lock: then once more.
int owned(const char* name) {
    while (true) {
        const int file = ::open(name, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
        if (file < 0) return file;
        struct ::stat opened{}, named{};
        const bool regular = ::fstat(file, &opened) == 0 && S_ISREG(opened.st_mode);
        const bool locked = regular && ::flock(file, LOCK_EX | LOCK_NB) == 0;
        const bool same = locked && ::fstat(file, &opened) == 0 && ::lstat(name, &named) == 0 && opened.st_ino == named.st_ino &&
                          opened.st_dev == named.st_dev;
        if (same && ::ftruncate(file, 0) == 0) return file;
        const int why = regular ? errno : ELOOP;
        ::close(file);
        errno = why;
        if (!locked || same) return -1;
    }
}

/// A file system or a device that knows no fsync has done what it can.
bool is_on_disk(int file) { return ::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS; }

/// The system begins to write the bytes and does not wait for them, which takes 0.05 ms. A file system that keeps the order of data and
/// names (ext4, as it is set up by default) then never shows this file under its name without its bytes.
void start_writing_back(int file) { (void)::sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE); }

}  // namespace

Result<void> sync_directory_of(const std::string& path) {
    const auto above = std::filesystem::path(path).parent_path().string();
    const int directory = ::open(above.empty() ? "." : above.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory < 0) return {};  // one that may not be read is left to the system
    const bool done = is_on_disk(directory);
    const int why = errno;
    ::close(directory);
    return done ? Result<void>() : bad_input(fmt::format("cannot be kept on the disk: {}", std::strerror(why)), {path});
}

Result<OutputFile> OutputFile::create(const std::string& path) {
    auto out = prepare(path);
    if (!out) return out;
    std::string part;
    const bool in_place = is_device(path);  // /dev/null, a named pipe: not to be replaced by a file
    const int file = in_place ? ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC) : new_part(path, part);
    if (file < 0) return bad_input(fmt::format("cannot be written: {}", std::strerror(errno)), {path});
    out->file_ = ::fdopen(file, "wb");
    out->part_ = part;
    return out;
}

Result<OutputFile> OutputFile::growing(const std::string& path) {
    if (is_device(path)) {
        auto in_place = create(path);
        if (in_place) std::setvbuf(in_place->file_, nullptr, _IONBF, 0);
        return in_place;
    }
    auto out = prepare(path);
    if (!out) return out;
    const auto part = path + ".part";
    const int file = owned(part.c_str());
    if (file < 0 && errno == EWOULDBLOCK) return bad_input("another program is writing this file", {path});
    if (file < 0 && errno == ELOOP) return bad_input("is a link or no plain file: remove it, or name another output", {part});
    if (file < 0) return bad_input(fmt::format("cannot be written: {}", std::strerror(errno)), {path});
    out->part_ = part, out->grows_ = true;
    out->file_ = ::fdopen(file, "wb");
    std::setvbuf(out->file_, nullptr, _IONBF, 0);
    return out;
}

Result<void> OutputFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) == text.size()) {
        size_ += text.size();
        return {};
    }
    const auto error = broken();
    if (grows_ && ::ftruncate(::fileno(file_), static_cast<off_t>(size_)) == 0) {  // what was written before is whole
        std::clearerr(file_);
        std::fseek(file_, 0, SEEK_END);
    }
    return error;
}

Result<void> OutputFile::rewrite(std::size_t at, std::string_view text) {
    const auto written = ::pwrite(::fileno(file_), text.data(), text.size(), static_cast<off_t>(at));
    if (written < 0 && errno == ESPIPE)
        return bad_input("is a pipe, and what is written first can be completed only in a file; name a file", {path_});
    return written == static_cast<ssize_t>(text.size()) ? Result<void>() : broken();
}

Result<void> OutputFile::commit(Sync sync) {
    if (std::fflush(file_) != 0) return broken();
    if (std::ferror(file_) != 0) return bad_input("could not be written to the end", {path_});
    const auto close = [&] { return std::fclose(std::exchange(file_, nullptr)) == 0; };
    if (part_.empty()) return close() ? Result<void>() : broken();
    constexpr auto costly = std::chrono::seconds(1);
    synced_ = sync == Sync::always || std::chrono::steady_clock::now() - begun_ > costly;
    if (synced_ && !is_on_disk(::fileno(file_))) return broken();
    if (!synced_) start_writing_back(::fileno(file_));
    if (!grows_ && !close()) return broken();  // one that grows is kept from others until it has its name
    if (std::rename(part_.c_str(), path_.c_str()) != 0)
        return bad_input(fmt::format("cannot be put in its place: {}", std::strerror(errno)), {path_});
    part_.clear();
    if (grows_ && !close()) return broken();
    return {};
}

}  // namespace corpuscle
