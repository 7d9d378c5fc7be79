#include "io/spice/raw_file.hpp"

#include <fmt/format.h>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/text/ascii_text.hpp"
#include "core/text/input_files.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_variables = 100'000;

/// The layout of the numbers behind "Binary:".
struct BinaryLayout {
    std::size_t first_bytes = 8, other_bytes = 8;  // of a number of the first variable, and of the others
    bool by_variable = false;                      // all points of a variable follow one another

    std::size_t bytes_per_point(std::size_t variables) const { return first_bytes + (variables - 1) * other_bytes; }
};

double number_at(const char* p, std::size_t bytes) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < bytes; ++k) bits |= std::uint64_t{static_cast<unsigned char>(p[k])} << (8 * k);
    return bytes == 8 ? std::bit_cast<double>(bits) : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
}

class RawParser {
    std::string_view bytes_;
    std::string path_;
    std::size_t at_ = 0;
    long line_ = 0;         // number of the last line of a header; unknown after binary data
    bool is_wide_ = false;  // the headers are UTF-16
    bool is_located_ = true;

    // of the plot that is being read
    RawPlot plot_ = {};
    std::string flags_ = {};
    std::size_t variables_ = 0, points_ = 0;

    Error error(std::string message) const { return bad_input(std::move(message), {path_, is_located_ ? line_ : 0}); }

    /// The next line of a header, in ASCII.
    std::string next_line() {
        std::string out;
        ++line_;
        for (const std::size_t step = is_wide_ ? 2 : 1; at_ + step <= bytes_.size();) {
            const bool is_ascii = !is_wide_ || bytes_[at_ + 1] == 0;
            const char c = is_ascii ? bytes_[at_] : '?';
            at_ += step;
            if (c == '\n') return out;
            if (c != '\r') out += c;
        }
        at_ = bytes_.size();
        return out;
    }

    /// The part behind "No. Points:" as a number.
    Result<std::size_t> count_of(std::string_view text, std::string_view what, std::size_t max) const {
        const auto count = parse_bare_number<std::size_t>(trimmed(text));
        if (!count || *count > max)
            return error(fmt::format("'{}' is not a number of {} from 1 to {}; write the file again with the simulator",
                                     trimmed(text).substr(0, 40), what, max));
        return *count;
    }

    Result<void> read_variables() {
        if (variables_ == 0) return error("the line 'No. Variables:' is missing or 0 above 'Variables:'");
        for (std::size_t k = 0; k < variables_; ++k) {
            const auto line = next_line();
            const auto text = trimmed(line);
            const auto name = trimmed(text.substr(std::min(text.find_first_of(" \t"), text.size())));
            if (name.empty()) return error(fmt::format("expected variable {} with its number, name and type: '0 v(g) voltage'", k));
            plot_.variables.emplace_back(name.substr(0, name.find_first_of(" \t")));
        }
        return {};
    }

    /// One line of a header. Returns true if the numbers follow.
    Result<bool> read_header_line(std::string_view line) {
        const auto colon = std::min(line.find(':'), line.size());
        const auto key = trimmed(line.substr(0, colon));
        const auto text = trimmed(line.substr(std::min(colon + 1, line.size())));
        if (key == "Title") plot_ = {}, plot_.title = text, variables_ = points_ = 0, flags_.clear();
        if (key == "Plotname") plot_.name = text;
        if (key == "Flags") flags_ = lower(text);
        if (key == "No. Variables") variables_ = TRY(count_of(text, "variables", max_variables));
        if (key == "No. Points") points_ = TRY(count_of(text, "points", bytes_.size()));
        if (key == "Variables") {
            plot_.variables.clear(), plot_.values.clear();
            TRY(read_variables());
        }
        return key == "Binary" || key == "Values";
    }

    Result<void> check_header() const {
        if (plot_.variables.empty()) return error("the list of variables is missing; this is not a .raw file of SPICE");
        if (plot_.variables.size() != variables_)
            return error(
                fmt::format("'No. Variables: {}' differs from the list of {} variables above it", variables_, plot_.variables.size()));
        if (points_ == 0) return error(fmt::format("the plot '{}' has no points; run the simulation again", plot_.name.substr(0, 60)));
        if (flags_.find("complex") != flags_.npos)
            return error(fmt::format("the plot '{}' is complex (an AC analysis); real curves are needed, such as those of .dc",
                                     plot_.name.substr(0, 60)));
        return {};
    }

    /// LTspice's files have one plot. Their numbers, except those of the first variable, are in single precision, unless a flag or the size
    /// of the file says otherwise.
    BinaryLayout layout() const {
        BinaryLayout out;
        if (!is_wide_) return out;
        out.by_variable = flags_.find("fastaccess") != flags_.npos;
        const auto left = bytes_.size() - at_;
        if (flags_.find("double") != flags_.npos || left / points_ >= 8 * variables_) return out;
        out.other_bytes = 4;
        if (left / points_ < out.bytes_per_point(variables_)) out.first_bytes = 4;
        return out;
    }

    Result<void> read_binary() {
        const auto layout = this->layout();
        const auto left = bytes_.size() - at_, per_point = layout.bytes_per_point(variables_);
        if (left / per_point < points_)
            return error(fmt::format("the file ends after {} of {} points of '{}'; was the simulation interrupted?", left / per_point,
                                     points_, plot_.name.substr(0, 60)));
        for (std::size_t k = 0, offset = 0; k < variables_; ++k) {
            const auto size = k == 0 ? layout.first_bytes : layout.other_bytes, stride = layout.by_variable ? size : per_point;
            for (std::size_t p = 0; p < points_; ++p) plot_.values[k].push_back(number_at(bytes_.data() + at_ + offset + p * stride, size));
            offset += layout.by_variable ? size * points_ : size;
        }
        at_ += points_ * per_point, is_located_ = false;
        return {};
    }

    /// The next word of the text; "" at its end.
    std::string_view next_word() {
        constexpr std::string_view blanks = " \t\r\n";
        while (at_ < bytes_.size() && blanks.find(bytes_[at_]) != blanks.npos) line_ += bytes_[at_++] == '\n';
        const auto from = at_;
        while (at_ < bytes_.size() && blanks.find(bytes_[at_]) == blanks.npos) ++at_;
        return bytes_.substr(from, at_ - from);
    }

    Result<void> read_text() {
        ++line_;  // next_word() counts the ends of lines
        for (std::size_t p = 0; p < points_; ++p) {
            next_word();  // the number of the point
            for (std::size_t k = 0; k < variables_; ++k) {
                auto word = next_word();
                if (word.starts_with('+')) word.remove_prefix(1);
                const auto value = parse_bare_number<double>(word);
                if (!value)
                    return error(fmt::format("'{}' is not a number; point {} of {} needs a value of {}", word.substr(0, 40), p, points_,
                                             plot_.variables[k].substr(0, 40)));
                plot_.values[k].push_back(*value);
            }
        }
        next_line(), line_ -= 1;
        return {};
    }

public:
    RawParser(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path) {
        is_wide_ = bytes.size() > 1 && bytes[0] == 'T' && bytes[1] == 0;
    }

    Result<std::vector<RawPlot>> parse() {
        std::vector<RawPlot> out;
        if (bytes_.empty()) return bad_input("the file is empty; expected a .raw file of SPICE", {path_});
        while (at_ < bytes_.size()) {
            const auto line = next_line();
            if (line_ == 1 && !line.starts_with("Title:"))
                return error("a .raw file of SPICE begins with 'Title:'; for columns of numbers, name the file .csv");
            if (!TRY(read_header_line(line))) continue;
            TRY(check_header());
            plot_.values.resize(variables_);
            TRY(line.starts_with("Binary") ? read_binary() : read_text());
            out.push_back(std::exchange(plot_, {}));
            variables_ = points_ = 0;
        }
        if (out.empty()) return error("the file ends before its numbers ('Binary:' or 'Values:'); run the simulation again");
        return out;
    }
};

}  // namespace

Result<std::vector<RawPlot>> parse_raw(std::string_view bytes, const std::string& path) { return RawParser(bytes, path).parse(); }

Result<std::vector<RawPlot>> read_raw_file(const std::string& path) {
    const auto bytes = TRY(read_entire_input(path, max_raw_bytes, ".raw file"));
    return parse_raw(bytes, path);
}

}  // namespace corpuscle
