#include "io/text/gzip_text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/text/input_files.hpp"
#include "core/text/utf8.hpp"
#include "io/table/foreign_format.hpp"

namespace corpuscle {
namespace {

/// A file as it is.
class PlainText final : public TextInput {
    std::string path_;
    FileHandle file_;
    double size_ = 0, read_ = 0;  // bytes of the file (0: not known), and bytes read so far

    Result<std::size_t> fetch(char* to, std::size_t max_bytes) override {
        const auto got = read_input(file_.get(), {to, max_bytes}, path_);
        if (got) read_ += static_cast<double>(*got);
        return got;
    }

    Result<void> restart() override {
        if (std::fseek(file_.get(), 0, SEEK_SET) != 0)
            return bad_input("this input cannot be read twice; save it to a file first", {path_});
        read_ = 0;
        return {};
    }

public:
    explicit PlainText(std::string path) : path_(std::move(path)), file_(open_input(path_)) {
        std::error_code status;
        if (const auto size = std::filesystem::file_size(path_, status); !status) size_ = static_cast<double>(size);
    }
    bool is_open() const { return file_ != nullptr; }
    double progress() const override { return size_ > 0 ? std::min(1.0, read_ / size_) : 1; }
};

/// A UTF-16 text as UTF-8. U+FFFD replaces a surrogate without its partner.
class Utf16Text final : public TextInput {
    std::string path_;
    std::unique_ptr<TextInput> units_;  // the file, in code units of two bytes
    bool big_endian_;
    std::string out_;           // converted text
    std::size_t returned_ = 0;  // bytes of out_ that have been returned
    char32_t high_ = 0;         // a high surrogate whose low surrogate has not come yet; 0: none
    bool ended_ = false;        // true after the last code unit was read

    /// Converts the next code unit.
    void append_unit(char32_t unit) {
        const bool low = unit >= 0xdc00 && unit < 0xe000;
        if (high_ != 0) {
            append_utf8(out_, low ? 0x10000 + ((high_ - 0xd800) << 10) + (unit - 0xdc00) : 0xfffd);
            high_ = 0;
            if (low) return;
        }
        if (unit >= 0xd800 && unit < 0xdc00)
            high_ = unit;
        else
            append_utf8(out_, low ? 0xfffd : unit);
    }

    Result<void> refill() {
        char block[1 << 14];
        const auto got = TRY(units_->read(block, sizeof block));
        out_.clear(), returned_ = 0;
        ended_ = got < sizeof block;
        if (got % 2 != 0) return bad_input("this UTF-16 text is incomplete: it ends within a character", {path_});
        for (std::size_t k = 0; k < got; k += 2) {
            const auto a = static_cast<unsigned char>(block[k]), b = static_cast<unsigned char>(block[k + 1]);
            append_unit(big_endian_ ? a * 256U + b : b * 256U + a);
        }
        if (ended_ && high_ != 0) append_utf8(out_, 0xfffd), high_ = 0;
        return {};
    }

    Result<std::size_t> fetch(char* to, std::size_t max_bytes) override {
        std::size_t count = 0;
        while (count < max_bytes) {
            if (returned_ == out_.size()) {
                if (ended_) break;
                TRY(refill());
                continue;
            }
            const std::size_t n = std::min(max_bytes - count, out_.size() - returned_);
            std::memcpy(to + count, out_.data() + returned_, n);
            count += n, returned_ += n;
        }
        return count;
    }

    Result<void> restart() override {
        out_.clear(), returned_ = 0, high_ = 0, ended_ = false;
        return units_->rewind();
    }

public:
    Utf16Text(std::string path, std::unique_ptr<TextInput> units, bool big_endian)
        : path_(std::move(path)), units_(std::move(units)), big_endian_(big_endian) {}
    double progress() const override { return units_->progress(); }
    std::vector<std::string> shell_commands() const override {
        auto all = units_->shell_commands();
        all.push_back(fmt::format("iconv -f UTF-16{} -t UTF-8", big_endian_ ? "BE" : "LE"));
        return all;
    }
};

/// The byte order of a UTF-16 text that begins with these bytes: 'L' for little-endian, 'B' for big-endian, '\0' if it is not UTF-16.
/// UTF-16 has a byte order mark, or every other byte at the beginning is 0.
char utf16_order(std::string_view first) {
    if (first.starts_with("\xff\xfe")) return 'L';
    if (first.starts_with("\xfe\xff")) return 'B';
    const std::size_t pairs = std::min<std::size_t>(first.size() / 2, 64);
    std::size_t zeros[2] = {0, 0};  // number of bytes 0 at even and at odd positions
    for (std::size_t k = 0; k < 2 * pairs; ++k) zeros[k % 2] += first[k] == '\0';
    if (pairs >= 3 && zeros[1] == pairs && zeros[0] == 0) return 'L';
    return pairs >= 3 && zeros[0] == pairs && zeros[1] == 0 ? 'B' : '\0';
}

}  // namespace

Result<std::size_t> TextInput::read(char* to, std::size_t max_bytes) {
    const std::size_t n = std::min(max_bytes, lookahead_.size());
    std::memcpy(to, lookahead_.data(), n);
    lookahead_.erase(0, n);
    if (n == max_bytes) return n;
    const auto more = TRY(fetch(to + n, max_bytes - n));
    return n + more;
}

Result<std::string_view> TextInput::peek(std::size_t count) {
    if (const std::size_t old_size = lookahead_.size(); old_size < count) {
        lookahead_.resize(count);
        const auto got = fetch(lookahead_.data() + old_size, count - old_size);
        lookahead_.resize(old_size + (got ? *got : 0));
        if (!got) return got.error();
    }
    return std::string_view(lookahead_).substr(0, count);
}

Result<void> TextInput::rewind() {
    lookahead_.clear();
    return restart();
}

Result<std::unique_ptr<TextInput>> open_text_input(const std::string& path) {
    std::error_code status;
    if (std::filesystem::is_directory(path, status)) return bad_input("this is a directory, not a file", {path});
    auto plain = std::make_unique<PlainText>(path);
    if (!plain->is_open()) return bad_input(fmt::format("cannot be opened: {}", std::strerror(errno)), {path});
    std::unique_ptr<TextInput> input = std::move(plain);
    constexpr std::size_t signature_bytes = 512;  // at the beginning of the file, to recognise its format
    auto first = input->peek(signature_bytes);
    const bool packed = first && first->starts_with("\x1f\x8b");
    if (packed) {
        input = make_gzip_text(path, std::move(input));
        first = input->peek(signature_bytes);
    }
    if (!first) return first.error();
    const auto foreign = describe_foreign_format(*first, path);
    if (const auto refusal = foreign.empty() ? describe_misnamed_format(*first, path) : foreign; !refusal.empty())
        return bad_input(
            packed ? "this gzip file does not contain text; decompress it first: " + unpack_command("gzip", ".gz", path) : refusal, {path});
    if (const char order = utf16_order(*first))
        return std::unique_ptr<TextInput>(std::make_unique<Utf16Text>(path, std::move(input), order == 'B'));
    if (first->find('\0') != first->npos) return bad_input("not a text file: it contains NUL bytes, as binary files do", {path});
    return input;
}

}  // namespace corpuscle
