#include "io/output.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace corpuscle {

OutputFile::OutputFile(OutputFile&& o) noexcept
    : path_(std::move(o.path_)), part_(std::move(o.part_)), made_(std::move(o.made_)), file_(std::exchange(o.file_, nullptr)) {
    o.part_.clear();
}

OutputFile& OutputFile::operator=(OutputFile&& o) noexcept {
    std::swap(path_, o.path_), std::swap(part_, o.part_), std::swap(made_, o.made_), std::swap(file_, o.file_);
    return *this;
}

OutputFile::~OutputFile() {
    if (file_) std::fclose(file_);
    if (part_.empty()) return;
    std::remove(part_.c_str());
    for (const auto& directory : made_) ::rmdir(directory.c_str());  // leaves it if something else is in it
}

Result<OutputFile> OutputFile::create(const std::string& path) {
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
    const auto part = fmt::format("{}.part-{}", path, ::getpid());
    out.file_ = std::fopen(part.c_str(), "wb");
    if (!out.file_) return bad_input(fmt::format("cannot be written: {}", std::strerror(errno)), {path});
    out.part_ = part;
    out.made_ = std::move(made);
    return out;
}

Result<void> OutputFile::write(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_) == text.size()) return {};
    return bad_input(fmt::format("cannot be written to the end: {}", std::strerror(errno)), {path_});
}

Result<void> OutputFile::commit() {
    const bool whole = std::ferror(file_) == 0;
    if (std::fclose(std::exchange(file_, nullptr)) != 0)
        return bad_input(fmt::format("cannot be written to the end: {}", std::strerror(errno)), {path_});
    if (!whole) return bad_input("could not be written to the end", {path_});
    if (std::rename(part_.c_str(), path_.c_str()) != 0)
        return bad_input(fmt::format("cannot be put in its place: {}", std::strerror(errno)), {path_});
    part_.clear();
    return {};
}

}  // namespace corpuscle
