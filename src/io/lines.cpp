#include "io/lines.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "signal/input_files.hpp"

namespace corpuscle {

Result<Lines> Lines::open(const std::string& path) {
    std::error_code status;
    if (std::filesystem::is_directory(path, status)) return bad_input("this is a directory, not a recording", {path});
    Lines lines;
    lines.path_ = path;
    lines.file_.reset(open_input(path));
    if (!lines.file_) return bad_input(fmt::format("cannot be opened: {}", std::strerror(errno)), {path});
    if (const auto size = std::filesystem::file_size(path, status); !status) lines.size_ = static_cast<double>(size);
    return lines;
}

Result<bool> Lines::fill() {
    constexpr std::size_t block = std::size_t{1} << 20;
    if (ended_) return false;
    lost_ = lost_ || at_ > 0;
    std::memmove(buffer_.data(), buffer_.data() + at_, filled_ - at_);
    filled_ -= std::exchange(at_, 0);
    if (filled_ > longest) return bad_input(fmt::format("a line of more than {} MB", longest >> 20), {path_, number_ + 1});
    if (buffer_.size() < filled_ + block + behind) buffer_.resize(filled_ + block + behind);
    const auto read = read_input(file_.get(), {buffer_.data() + filled_, block}, path_);
    if (!read) return Error{read.error().code, read.error().sentence, {path_, number_ + 1}};
    const auto got = *read;
    filled_ += got;
    std::memset(buffer_.data() + filled_, 0, behind);
    read_ += static_cast<double>(got);
    if (got < block) ended_ = true;
    return got > 0;
}

Result<bool> Lines::next(std::string_view& line) {
    std::size_t searched = at_, end;
    const auto found = [&] {
        const void* const at = std::memchr(buffer_.data() + searched, '\n', filled_ - searched);
        return at ? (end = static_cast<std::size_t>(static_cast<const char*>(at) - buffer_.data()), true) : false;
    };
    while (!found()) {
        const std::size_t pending = filled_ - at_;
        const auto more = fill();
        if (!more) return more.error();
        if (*more) {
            searched = at_ + pending;
            continue;
        }
        if (filled_ == at_) return false;
        end = filled_;
        break;
    }
    line = std::string_view(buffer_).substr(at_, end - at_);
    at_ = std::min(end + 1, filled_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (++number_ == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    return true;
}

Result<void> Lines::rewind() {
    if (!lost_) return at_ = 0, number_ = 0, Result<void>{};  // all that was read is still here: a pipe can do this, too
    if (std::fseek(file_.get(), 0, SEEK_SET) != 0) return bad_input("this input cannot be read twice; save it to a file", {path_});
    filled_ = 0, at_ = 0, number_ = 0, read_ = 0, ended_ = false, lost_ = false;
    return {};
}

}  // namespace corpuscle
