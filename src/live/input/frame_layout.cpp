#include "live/input/frame_layout.hpp"

#include <fmt/format.h>

namespace corpuscle {
namespace {

std::string counted_noun(std::size_t n, std::string_view noun) {
    return fmt::format("{} {}{}", n, noun == "axis" && n != 1 ? "axe" : noun, n == 1 ? "" : "s");
}

/// The stamp and the number of values of a frame: "a sequence number and 4793 numbers".
std::string contents_of(const FrameLayout& layout, std::size_t numbers) {
    const auto values = counted_noun(numbers, "number");
    return layout.stamp == FrameStamp::none
               ? values
               : fmt::format("a {} and {}", layout.stamp == FrameStamp::sequence ? "sequence number" : "time", values);
}

/// "'hand' has 4793 sites, so a frame must have 4793 numbers"
std::string expected_frame(const FrameLayout& layout, std::string_view population) {
    return fmt::format("'{}' has {}, so a frame must have {}", population, counted_noun(layout.sites, layout.site_noun),
                       contents_of(layout, layout.sites));
}

/// A remedy for frames of taxels with three axes whose layout does not say so; otherwise "".
std::string axes_advice(const FrameLayout& layout, std::size_t numbers) {
    return layout.site_noun == "taxel" && numbers == 3 * layout.sites
               ? "; for Fx, Fy and Fz of each taxel add a column x_axis to their layout"
               : "";
}

/// A remedy for a line whose commas may be decimal commas; otherwise "".
std::string decimal_advice(const FrameError& error) {
    return error.has_decimal_commas ? "; if its commas are decimal commas, replace them by points before sending, as sed -u 's/,/./g' does"
                                    : "";
}

}  // namespace

std::string describe_frame_error(const FrameError& error, const FrameLayout& layout, std::string_view population) {
    const std::size_t stamps = layout.stamp == FrameStamp::none ? 0 : 1;
    switch (error.reason) {
        case FrameError::width:
            return fmt::format("frame {} has {}; {}", error.frame,
                               error.found < stamps ? "nothing" : contents_of(layout, error.found - stamps),
                               expected_frame(layout, population)) +
                   decimal_advice(error) + axes_advice(layout, error.found - stamps);
        case FrameError::stamp:
            return fmt::format("frame {} does not begin with {}; {}", error.frame,
                               layout.stamp == FrameStamp::sequence ? "its sequence number, an integer" : "its time in seconds",
                               expected_frame(layout, population));
        case FrameError::too_long:
            return fmt::format("frame {} is a line longer than any frame; {}", error.frame, expected_frame(layout, population));
        case FrameError::datagram:
            return fmt::format("a datagram has {} bytes; {}, which are {} bytes", error.found, expected_frame(layout, population),
                               layout.bytes());
        case FrameError::header:
            return error.detail;
    }
    return {};
}

}  // namespace corpuscle
