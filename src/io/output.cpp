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
      size_(o.size_), grows_(o.grows_) {
    o.part_.clear();
}

OutputFile& OutputFile::operator=(OutputFile&& o) noexcept {
    std::swap(path_, o.path_), std::swap(part_, o.part_), std::swap(made_, o.made_), std::swap(file_, o.file_), std::swap(size_, o.size_),
        std::swap(grows_, o.grows_);
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

Result<OutputFile> OutputFile::create(const std::string& path) {
    auto out = prepare(path);
    if (!out) return out;
    const auto part = fmt::format("{}.part-{}", path, ::getpid());
    out->file_ = std::fopen(part.c_str(), "wb");
    if (!out->file_) return bad_input(fmt::format("cannot be written: {}", std::strerror(errno)), {path});
    out->part_ = part;
    return out;
}

namespace {

/// The file of this name, for this program alone and empty; -1: errno says why. Another program may put its own in place between the
/// opening and the lock: then once more.
int owned(const char* name) {
    while (true) {
        const int file = ::open(name, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (file < 0) return file;
        struct ::stat opened{}, named{};
        const bool locked = ::flock(file, LOCK_EX | LOCK_NB) == 0;
        const bool same = locked && ::fstat(file, &opened) == 0 && ::stat(name, &named) == 0 && opened.st_ino == named.st_ino;
        if (same && ::ftruncate(file, 0) == 0) return file;
        const int why = errno;
        ::close(file);
        errno = why;
        if (!locked || same) return -1;
    }
}

}  // namespace

Result<OutputFile> OutputFile::growing(const std::string& path) {
    auto out = prepare(path);
    if (!out) return out;
    const auto part = path + ".part";
    const int file = owned(part.c_str());
    if (file < 0 && errno == EWOULDBLOCK) return bad_input("another program is writing this file", {path});
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
    return written == static_cast<ssize_t>(text.size()) ? Result<void>() : broken();
}

Result<void> OutputFile::commit() {
    const bool whole = std::ferror(file_) == 0;
    const auto close = [&] { return std::fclose(std::exchange(file_, nullptr)) == 0; };
    if (!grows_ && !close()) return broken();  // one that grows is kept from others until it has its name
    if (!whole) return bad_input("could not be written to the end", {path_});
    if (std::rename(part_.c_str(), path_.c_str()) != 0)
        return bad_input(fmt::format("cannot be put in its place: {}", std::strerror(errno)), {path_});
    part_.clear();
    if (grows_ && !close()) return broken();
    return {};
}

}  // namespace corpuscle
