#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/text/input_files.hpp"
#include "io/table/archive.hpp"

namespace corpuscle {
namespace {

class FileBytes final : public SeekableBytes {
    std::string name_;
    FileHandle file_;
    std::uint64_t size_;

public:
    FileBytes(std::string name, FileHandle file, std::uint64_t size) : name_(std::move(name)), file_(std::move(file)), size_(size) {}

    const std::string& name() const override { return name_; }
    std::uint64_t size() const override { return size_; }
    Result<void> read(std::span<std::byte> out) override {
        if (std::fread(out.data(), 1, out.size(), file_.get()) == out.size()) return {};
        return bad_input(std::ferror(file_.get()) ? fmt::format("cannot be read: {}", std::strerror(errno)) : "the file is incomplete",
                         {name_});
    }
    Result<void> seek(std::uint64_t at) override {
        if (at <= size_ && ::fseeko(file_.get(), static_cast<off_t>(at), SEEK_SET) == 0) return {};
        return bad_input("the file is incomplete", {name_});
    }
};

}  // namespace

Result<std::unique_ptr<SeekableBytes>> open_bytes(const std::string& path) {
    std::error_code status;
    if (std::filesystem::is_directory(path, status)) return bad_input("this is a directory, not a file", {path});
    auto file = open_input(path);
    if (!file) return bad_input(fmt::format("cannot be opened: {}", std::strerror(errno)), {path});
    const auto size = std::filesystem::file_size(path, status);
    if (status) return bad_input("this is not a regular file; save it to one first", {path});
    return std::unique_ptr<SeekableBytes>(std::make_unique<FileBytes>(path, std::move(file), size));
}

Result<std::unique_ptr<SeekableBytes>> copy_to_temporary_file(SeekableBytes& from) {
    FileHandle file(std::tmpfile());
    if (!file) return bad_input(fmt::format("a temporary file cannot be created: {}", std::strerror(errno)), {from.name()});
    TRY(from.seek(0));
    std::vector<std::byte> buffer(std::size_t{1} << 20);
    for (std::uint64_t left = from.size(); left > 0;) {
        const auto chunk = std::span(buffer).first(static_cast<std::size_t>(std::min<std::uint64_t>(left, buffer.size())));
        TRY(from.read(chunk));
        if (std::fwrite(chunk.data(), 1, chunk.size(), file.get()) != chunk.size())
            return bad_input(fmt::format("cannot be copied to a temporary file: {}", std::strerror(errno)), {from.name()});
        left -= chunk.size();
    }
    if (std::fflush(file.get()) != 0)
        return bad_input(fmt::format("cannot be copied to a temporary file: {}", std::strerror(errno)), {from.name()});
    return std::unique_ptr<SeekableBytes>(std::make_unique<FileBytes>(from.name(), std::move(file), from.size()));
}

}  // namespace corpuscle
