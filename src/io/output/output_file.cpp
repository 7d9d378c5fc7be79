#include "io/output/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "io/output/descriptor.hpp"

namespace corpuscle {

OutputFile::OutputFile(OutputFile&& o) noexcept
    : path_(std::move(o.path_)), temporary_path_(std::move(o.temporary_path_)), created_directories_(std::move(o.created_directories_)),
      file_(std::exchange(o.file_, nullptr)), size_(o.size_), is_growing_(o.is_growing_), is_synced_(o.is_synced_),
      start_time_(o.start_time_) {
    o.temporary_path_.clear();
}

OutputFile& OutputFile::operator=(OutputFile&& o) noexcept {
    std::swap(path_, o.path_), std::swap(temporary_path_, o.temporary_path_), std::swap(created_directories_, o.created_directories_),
        std::swap(file_, o.file_), std::swap(size_, o.size_), std::swap(is_growing_, o.is_growing_), std::swap(is_synced_, o.is_synced_),
        std::swap(start_time_, o.start_time_);
    return *this;
}

OutputFile::~OutputFile() {
    if (file_) std::fclose(file_);
    if (temporary_path_.empty()) return;
    std::remove(temporary_path_.c_str());
    for (const auto& directory : created_directories_) ::rmdir(directory.c_str());  // fails if the directory is not empty
}

/// Creates the missing directories of the path, and an OutputFile without an open file.
Result<OutputFile> OutputFile::prepare(const std::string& path) {
    std::error_code status;
    const auto parent = std::filesystem::path(path).parent_path();
    std::vector<std::string> created;  // the new directories, innermost first
    for (auto d = parent; !d.empty() && !std::filesystem::exists(d, status); d = d.parent_path()) created.push_back(d.string());
    status.clear();
    if (!parent.empty()) std::filesystem::create_directories(parent, status);
    if (status) return bad_input(fmt::format("the directory cannot be created: {}", status.message()), {parent.string()});
    if (std::filesystem::is_directory(path, status)) return bad_input("this is a directory, not a file to write", {path});
    OutputFile out;
    out.path_ = path;
    out.created_directories_ = std::move(created);
    return out;
}

Error OutputFile::write_error() const {
    return bad_input(fmt::format("could not be written completely: {}", std::strerror(errno)), {path_});
}

namespace {

/// True if the path exists and is not a regular file.
bool is_device(const std::string& path) {
    struct ::stat file_status = {};
    return ::stat(path.c_str(), &file_status) == 0 && !S_ISREG(file_status.st_mode);
}

/// Creates a temporary file, path.part-PID or path.part-PID-2 ..., and stores its path in `part`. Does not follow links. Locks the file,
/// which shows other runs that it is in use. Returns its descriptor, or -1 with errno on failure.
int create_part(const std::string& path, std::string& part) {
    constexpr int max_tries = 1000;
    for (int k = 1; k <= max_tries; ++k) {
        part = fmt::format("{}.part-{}{}", path, ::getpid(), k == 1 ? "" : fmt::format("-{}", k));
        const int file = ::open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file < 0 && errno == EEXIST) continue;
        if (file < 0) return file;
        struct ::stat file_status = {};
        (void)::flock(file, LOCK_EX | LOCK_NB);  // if the file system has no locks, temporary files are never taken for abandoned
        // The number of links is 0 if another run removed the file before it was locked.
        if (::fstat(file, &file_status) == 0 && file_status.st_nlink > 0) return file;
        ::close(file);
    }
    errno = EEXIST;
    return -1;
}

/// Opens or creates the file of this name, locks it for this process and empties it. Returns its descriptor, or -1 with errno on failure:
/// EWOULDBLOCK if another process has locked it, ELOOP if it is a link or not a regular file. Retries if another program replaces the file
/// between opening and locking.
int open_exclusively(const char* name) {
    while (true) {
        const int file = ::open(name, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
        if (file < 0) return file;
        struct ::stat opened{}, named{};
        const bool regular = ::fstat(file, &opened) == 0 && S_ISREG(opened.st_mode);
        const bool locked = regular && ::flock(file, LOCK_EX | LOCK_NB) == 0;
        const bool same = locked && ::fstat(file, &opened) == 0 && ::lstat(name, &named) == 0 && opened.st_ino == named.st_ino &&
                          opened.st_dev == named.st_dev;
        if (same && ::ftruncate(file, 0) == 0) return file;
        const int error_number = regular ? errno : ELOOP;
        ::close(file);
        errno = error_number;
        if (!locked || same) return -1;
    }
}

/// Synchronises a file to disk. Returns false and sets errno on failure. If the file system or device has no fsync, this counts as success.
bool sync_to_disk(int file) { return ::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS; }

/// Starts writing the bytes of a file to disk and does not wait for the end, so it takes only 0.05 ms. On a file system that writes data
/// before metadata (the default of ext4), the file then never appears under its final name without its bytes.
void start_writing_back(int file) { (void)::sync_file_range(file, 0, 0, SYNC_FILE_RANGE_WRITE); }

}  // namespace

Result<void> sync_directory_of(const std::string& path) {
    const auto parent = std::filesystem::path(path).parent_path().string();
    const Descriptor directory(::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!directory || sync_to_disk(directory.get())) return {};  // without permission to open it, it cannot be synchronised
    return bad_input(fmt::format("cannot be synchronised to disk: {}", std::strerror(errno)), {path});
}

Result<OutputFile> OutputFile::create(const std::string& path) {
    auto out = prepare(path);
    if (!out) return out;
    std::string part;
    const bool in_place = is_device(path);  // /dev/null or a named pipe must not be replaced by a file
    const int file = in_place ? ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC) : create_part(path, part);
    if (file < 0) return bad_input(fmt::format("cannot be written: {}", std::strerror(errno)), {path});
    out->file_ = ::fdopen(file, "wb");
    out->temporary_path_ = part;
    return out;
}

Result<OutputFile> OutputFile::create_growing(const std::string& path) {
    if (is_device(path)) {
        auto in_place = create(path);
        if (in_place) std::setvbuf(in_place->file_, nullptr, _IONBF, 0);
        return in_place;
    }
    auto out = prepare(path);
    if (!out) return out;
    const auto part = path + ".part";
    const int file = open_exclusively(part.c_str());
    if (file < 0 && errno == EWOULDBLOCK) return bad_input("another program is writing this file", {path});
    if (file < 0 && errno == ELOOP) return bad_input("is a link or not a regular file; remove it, or name another output", {part});
    if (file < 0) return bad_input(fmt::format("cannot be written: {}", std::strerror(errno)), {path});
    out->temporary_path_ = part, out->is_growing_ = true;
    out->file_ = ::fdopen(file, "wb");
    std::setvbuf(out->file_, nullptr, _IONBF, 0);
    return out;
}

Result<void> OutputFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) == text.size()) {
        size_ += text.size();
        return {};
    }
    const auto error = write_error();
    if (is_growing_ && ::ftruncate(::fileno(file_), static_cast<off_t>(size_)) == 0) {  // back to the last complete write
        std::clearerr(file_);
        std::fseek(file_, 0, SEEK_END);
    }
    return error;
}

Result<void> OutputFile::overwrite(std::size_t at, std::string_view text) {
    const auto written = ::pwrite(::fileno(file_), text.data(), text.size(), static_cast<off_t>(at));
    if (written < 0 && errno == ESPIPE)
        return bad_input("is a pipe, but this output needs a file, because its beginning is updated at the end", {path_});
    return written == static_cast<ssize_t>(text.size()) ? Result<void>() : write_error();
}

Result<void> OutputFile::commit(SyncPolicy sync) {
    if (std::fflush(file_) != 0) return write_error();
    if (std::ferror(file_) != 0) return bad_input("could not be written completely", {path_});
    const auto close = [&] { return std::fclose(std::exchange(file_, nullptr)) == 0; };
    if (temporary_path_.empty()) return close() ? Result<void>() : write_error();
    constexpr auto slow = std::chrono::seconds(1);  // since the file was created
    is_synced_ = sync == SyncPolicy::always || std::chrono::steady_clock::now() - start_time_ > slow;
    if (is_synced_ && !sync_to_disk(::fileno(file_))) return write_error();
    if (!is_synced_) start_writing_back(::fileno(file_));
    if (!is_growing_ && !close()) return write_error();  // a growing file stays locked until it is renamed
    if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0)
        return bad_input(fmt::format("cannot be renamed to its final name: {}", std::strerror(errno)), {path_});
    temporary_path_.clear();
    if (is_growing_ && !close()) return write_error();
    return {};
}

Result<void> replace_file(const std::string& path, std::string_view bytes) {
    auto file = TRY(OutputFile::create(path));
    TRY(file.write(bytes));
    TRY(file.commit(SyncPolicy::always));
    return sync_directory_of(path);
}

}  // namespace corpuscle
