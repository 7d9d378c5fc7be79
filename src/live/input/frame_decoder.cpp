#include "live/input/frame_decoder.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/text/ascii_text.hpp"
#include "io/text/text_layout.hpp"
#include "live/input/frame_header.hpp"

namespace corpuscle {
namespace {

static_assert(std::endian::native == std::endian::little, "binary frames are copied as they are in memory");

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t max_field = 32;  // largest number of bytes of a field, with its separator

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
    comment_.clear(), value_index_.clear(), scale_runs_.clear(), header_error_.reset();
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
        if (line.empty() || is_comment(line)) {
            if (first_ && line.size() > 1) comment_ = trimmed(line.substr(1));
            continue;
        }
        if (std::exchange(first_, false)) {
            if (take_header(line)) continue;
            take_header(comment_, true);  // as numpy.savetxt writes it
        }
        ++seen_;
        if (!header_error_) return read_line(line);
        if (!first_error_) first_error_ = FrameError{FrameError::header, seen_, 0, header_error_->message};
        return Status::unreadable;
    }
}

FrameDecoder::Status FrameDecoder::unreadable(FrameError::Reason reason, std::size_t found) {
    if (!first_error_) first_error_ = {.reason = reason, .frame = seen_, .found = found};
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

/// Reads the header if the line is one.
bool FrameDecoder::take_header(std::string_view line, bool is_comment) {
    const std::size_t stamps = layout_.stamp == FrameStamp::none ? 0 : 1;
    auto names = header_names(line, layout_.sites + stamps, is_comment);
    if (names.empty()) return false;
    names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(stamps));
    read_header(names);
    const bool is_sentence = is_comment && header_error_ && line.find_first_of(",;\t") == line.npos;  // "sampled in ms"
    if (is_sentence) return header_error_.reset(), false;
    return ++headers_, true;
}

void FrameDecoder::read_header(const std::vector<std::string>& names) {
    if (!read_header_) return;
    auto columns = read_header_(names);
    if (!columns) {
        header_error_ = columns.error();
        return;
    }
    std::vector<double> scales(columns->scales.size());  // in the order of values_
    for (std::size_t k = 0; k < scales.size(); ++k) scales[columns->order.empty() ? k : columns->order[k]] = columns->scales[k];
    for (std::size_t k = 0; k < scales.size(); ++k)
        if (k > 0 && scales[k] == scales[k - 1])
            ++scale_runs_.back().end;
        else
            scale_runs_.push_back({k, k + 1, scales[k]});
    value_index_ = std::move(columns->order);
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
        if (rest.empty()) return wrong_width(line);
        values_[value_index_.empty() ? k : value_index_[k]] = number_in(next_field(rest)).value_or(not_a_number);
    }
    if (!rest.empty()) return wrong_width(line);
    return has_valid_stamp ? Status::frame : unreadable(FrameError::stamp);
}

FrameDecoder::Status FrameDecoder::wrong_width(std::string_view line) {
    if (!first_error_)
        first_error_ = {.reason = FrameError::width,
                        .frame = seen_,
                        .found = fields_in(line),
                        .has_decimal_commas = has_decimal_commas(line, layout_.sites + (layout_.stamp == FrameStamp::none ? 0 : 1))};
    return Status::unreadable;
}

std::size_t FrameDecoder::read_forces(std::span<double> force) const {
    lanes::ForceScaling scaling{layout_.offset, layout_.scale, layout_.limit, layout_.absolute};
    if (layout_.range) scaling.low = layout_.range->first, scaling.high = layout_.range->second;
    const auto convert = layout_.kind == FrameKind::f32 ? lanes_.f32 : layout_.kind == FrameKind::i16 ? lanes_.i16 : lanes_.f64;
    const char* const from = layout_.kind == FrameKind::csv ? reinterpret_cast<const char*>(values_.data()) : found_;
    if (scale_runs_.empty()) return convert(from, scaling, force.data(), force.size());
    std::size_t invalid = 0;
    for (const auto& run : scale_runs_) {
        scaling.scale = run.scale;
        invalid += convert(from + run.begin * sizeof(double), scaling, force.data() + run.begin, run.end - run.begin);
    }
    return invalid;
}

}  // namespace corpuscle
