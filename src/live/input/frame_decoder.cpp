#include "live/input/frame_decoder.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

static_assert(std::endian::native == std::endian::little, "binary frames are copied as they are in memory");

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t max_field = 32;  // largest number of bytes of a field, with its separator

bool is_separator(char c) { return c == ',' || c == ';' || c == '\t' || c == ' '; }

/// Removes the next field from the line. Blanks around a field are ignored; several blanks are one separator.
std::string_view next_field(std::string_view& line) {
    const auto end = std::min(static_cast<std::size_t>(std::find_if(line.begin(), line.end(), is_separator) - line.begin()), line.size());
    const auto field = line.substr(0, end);
    auto rest = trimmed(line.substr(end));
    if (!rest.empty() && (rest.front() == ',' || rest.front() == ';')) rest = trimmed(rest.substr(1));
    line = rest;
    return field;
}

/// Number of fields in a line.
std::size_t fields_in(std::string_view line) {
    std::size_t fields = 0;
    for (; !line.empty(); ++fields) next_field(line);
    return fields;
}

/// The number in a field, which may be NaN; no value if it is not a number.
std::optional<double> number_in(std::string_view field) {
    double x = 0;
    if (field.starts_with('+')) field.remove_prefix(1);  // from_chars() does not accept it
    const auto [end, status] = std::from_chars(field.data(), field.data() + field.size(), x);
    return status == std::errc{} && end == field.data() + field.size() ? std::optional(x) : std::nullopt;
}

/// The functions for this machine's instruction set.
const lanes::FrameKernels& best_lanes() {
    const auto set = instruction_set();
    return lanes::frame_kernels(set ? *set : InstructionSet::baseline);
}

}  // namespace

FrameDecoder::FrameDecoder(const FrameLayout& layout, std::size_t frames, HeaderReader read_header)
    : layout_(layout), lanes_(best_lanes()),
      bytes_(std::max<std::size_t>(65536,
                                   2 * (1 + frames) * (layout.kind == FrameKind::csv ? (layout.sites + 1) * max_field : layout.bytes()))),
      read_header_(std::move(read_header)) {
    if (layout.kind == FrameKind::csv) values_.resize(layout.sites);
}

std::span<char> FrameDecoder::buffer() {
    if (begin_ == end_) begin_ = end_ = scanned_ = 0;
    if (begin_ > 0 && end_ > bytes_.size() / 2) {  // moves the bytes that are not decoded yet to the beginning
        std::memmove(bytes_.data(), bytes_.data() + begin_, end_ - begin_);
        scanned_ -= std::min(scanned_, begin_), end_ -= begin_, begin_ = 0;
    }
    if (end_ == bytes_.size()) skipping_ = true, begin_ = end_ = scanned_ = 0;  // the whole buffer is one line without an end
    return std::span(bytes_).subspan(end_);
}

void FrameDecoder::reset() {
    begin_ = end_ = scanned_ = 0, skipping_ = false, first_ = true;
    value_index_.clear(), header_error_.reset();
}

FrameDecoder::Status FrameDecoder::next() {
    if (layout_.kind != FrameKind::csv) {
        if (end_ - begin_ < layout_.bytes()) return Status::nothing;
        ++seen_;
        const char* const at = bytes_.data() + begin_;
        begin_ += layout_.bytes();
        found_ = at + layout_.stamp_bytes();
        if (layout_.stamp == FrameStamp::sequence) std::memcpy(&number_, at, sizeof number_);
        if (layout_.stamp != FrameStamp::time) return Status::frame;
        double seconds = 0;
        std::memcpy(&seconds, at, sizeof seconds);
        return read_stamp(seconds) ? Status::frame : unreadable(FrameError::stamp);
    }
    for (;;) {
        scanned_ = std::max(scanned_, begin_);
        const auto* const end = static_cast<const char*>(std::memchr(bytes_.data() + scanned_, '\n', end_ - scanned_));
        if (!end) return scanned_ = end_, Status::nothing;
        const std::string_view full_line(bytes_.data() + begin_, end);
        begin_ = static_cast<std::size_t>(end - bytes_.data()) + 1;
        if (std::exchange(skipping_, false)) return ++seen_, unreadable(FrameError::too_long);
        const auto line = trimmed(full_line.ends_with('\r') ? full_line.substr(0, full_line.size() - 1) : full_line);
        if (line.empty() || line.front() == '#' || line.front() == '%') continue;
        if (std::exchange(first_, false) && is_header(line)) {
            read_header(line);
            continue;
        }
        ++seen_;
        if (!header_error_) return read_line(line);
        if (!first_error_) first_error_ = FrameError{FrameError::header, seen_, 0, header_error_->message};
        return Status::unreadable;
    }
}

FrameDecoder::Status FrameDecoder::unreadable(FrameError::Reason reason, std::size_t found) {
    if (!first_error_) first_error_ = FrameError{reason, seen_, found, {}};
    return Status::unreadable;
}

bool FrameDecoder::add_datagram(std::size_t bytes) {
    if (layout_.kind == FrameKind::csv) {
        if (bytes > 0 && bytes_[end_ + bytes - 1] != '\n') bytes_[end_ + bytes++] = '\n';
    } else if (bytes % layout_.bytes() != 0) {
        ++seen_;
        return unreadable(FrameError::datagram, bytes), false;
    }
    return add_bytes(bytes), true;
}

/// True for a line with as many fields as a frame, if none of them is a number or "nan".
bool FrameDecoder::is_header(std::string_view line) const {
    std::size_t fields = 0;
    for (; !line.empty(); ++fields)
        if (number_in(next_field(line))) return false;
    return fields == layout_.sites + (layout_.stamp == FrameStamp::none ? 0 : 1);
}

void FrameDecoder::read_header(std::string_view line) {
    ++headers_;
    if (!read_header_) return;
    std::vector<std::string> names;
    while (!line.empty()) {
        auto field = next_field(line);
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
        names.emplace_back(field);
    }
    if (layout_.stamp != FrameStamp::none) names.erase(names.begin());
    auto indices = read_header_(names);
    if (!indices)
        header_error_ = indices.error();
    else
        value_index_ = *std::move(indices);
}

bool FrameDecoder::read_stamp(double seconds) {
    const double number = std::floor(seconds * layout_.rate + 0.5);
    if (!(std::abs(number) < 9e15)) return false;
    number_ = static_cast<std::uint32_t>(static_cast<std::int64_t>(number));
    return true;
}

bool FrameDecoder::read_stamp(std::string_view text) {
    if (layout_.stamp == FrameStamp::time) return read_stamp(number_in(text).value_or(not_a_number));
    std::int64_t number = 0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
    number_ = static_cast<std::uint32_t>(number);
    return status == std::errc{} && end == text.data() + text.size();
}

/// Reads the stamp and the values of a line. It is unreadable if the stamp is invalid, or the number of fields is wrong.
FrameDecoder::Status FrameDecoder::read_line(const std::string_view line) {
    auto rest = line;
    const bool has_valid_stamp = layout_.stamp == FrameStamp::none || read_stamp(next_field(rest));
    for (std::size_t k = 0; k < values_.size(); ++k) {
        if (rest.empty()) return unreadable(FrameError::width, fields_in(line));
        values_[value_index_.empty() ? k : value_index_[k]] = number_in(next_field(rest)).value_or(not_a_number);
    }
    if (!rest.empty()) return unreadable(FrameError::width, fields_in(line));
    return has_valid_stamp ? Status::frame : unreadable(FrameError::stamp);
}

std::size_t FrameDecoder::read_forces(std::span<double> force) const {
    lanes::ForceScaling scaling{layout_.offset, layout_.scale, layout_.limit, layout_.absolute};
    if (layout_.range) scaling.low = layout_.range->first, scaling.high = layout_.range->second;
    const auto convert = layout_.kind == FrameKind::f32 ? lanes_.f32 : layout_.kind == FrameKind::i16 ? lanes_.i16 : lanes_.f64;
    const char* const from = layout_.kind == FrameKind::csv ? reinterpret_cast<const char*>(values_.data()) : found_;
    return convert(from, scaling, force.data(), force.size());
}

}  // namespace corpuscle
