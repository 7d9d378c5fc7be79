#include "io/text/line_reader.hpp"

#include <fmt/format.h>
#include <cstring>
#include <filesystem>

#include "core/text/ascii_text.hpp"
#include "io/table/foreign_format.hpp"

namespace corpuscle {

Result<LineReader> LineReader::open(const std::string& path) {
    LineReader lines;
    lines.path_ = path;
    lines.input_ = TRY(open_text_input(path));
    return lines;
}

/// Reads the next block of the file into the buffer, after moving the unused bytes to its beginning. Returns false at the end of the file.
Result<bool> LineReader::fill() {
    constexpr std::size_t block = std::size_t{1} << 20;
    if (ended_) return false;
    is_start_discarded_ = is_start_discarded_ || position_ > 0;
    std::memmove(buffer_.data(), buffer_.data() + position_, filled_ - position_);
    filled_ -= std::exchange(position_, 0);
    if (filled_ > max_line_bytes)
        return bad_input(fmt::format("the line is longer than {} MB", max_line_bytes >> 20), {path_, line_number_ + 1});
    if (buffer_.size() < filled_ + block + padding) buffer_.resize(filled_ + block + padding);
    const auto got = input_->read(buffer_.data() + filled_, block);
    if (!got) return Error{got.error().code, got.error().message, {path_, line_number_ + 1}};
    filled_ += *got;
    std::memset(buffer_.data() + filled_, 0, padding);
    bytes_read_ += static_cast<double>(*got);
    ended_ = *got < block;
    return *got > 0;
}

Result<bool> LineReader::next(std::string_view& line) {
    std::size_t searched = position_, end;  // positions: of the first byte not yet searched, and of the end of the line
    const auto found = [&] {
        const void* const at = std::memchr(buffer_.data() + searched, '\n', filled_ - searched);
        return at ? (end = static_cast<std::size_t>(static_cast<const char*>(at) - buffer_.data()), true) : false;
    };
    while (!found()) {
        const std::size_t pending = filled_ - position_;
        const auto more = TRY(fill());
        if (more) {
            searched = position_ + pending;
            continue;
        }
        if (filled_ == position_) return false;
        end = filled_;
        break;
    }
    line = std::string_view(buffer_).substr(position_, end - position_);
    position_ = std::min(end + 1, filled_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (++line_number_ == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    return true;
}

Result<void> LineReader::rewind() {
    if (!is_start_discarded_)
        return position_ = 0, line_number_ = 0, Result<void>{};  // the buffer still holds the beginning, so this works for a pipe too
    TRY(input_->rewind());
    filled_ = 0, position_ = 0, line_number_ = 0, bytes_read_ = 0, ended_ = false, is_start_discarded_ = false;
    return {};
}

std::string LineReader::copy_command(const std::string& filter, const std::string& mark) const {
    namespace fs = std::filesystem;
    std::error_code status;
    if (!fs::is_regular_file(path_, status) || path_.starts_with("/dev/")) return "";
    auto name = fs::path(path_).filename();
    if (lower(name.extension().string()) == ".gz") name = name.stem();
    const auto stem = name.stem().string() + mark, extension = name.extension().string();
    const auto exists = [&](const fs::path& file) {  // in the working directory, or in the directory of the recording
        return fs::exists(fs::symlink_status(file, status)) || fs::exists(fs::symlink_status(fs::path(path_).parent_path() / file, status));
    };
    std::string copy = stem + extension;
    for (int k = 2; exists(copy); ++k) copy = fmt::format("{}-{}{}", stem, k, extension);
    auto commands = input_->shell_commands();
    commands.push_back(filter);
    std::string line = fmt::format("{} < {}", commands[0], quote_shell_word(path_));
    for (std::size_t k = 1; k < commands.size(); ++k) line += " | " + commands[k];
    return fmt::format("{} > {}", line, quote_shell_word(copy));
}

}  // namespace corpuscle
