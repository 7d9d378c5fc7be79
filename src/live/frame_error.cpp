#include "live/frame_error.hpp"

#include <fmt/format.h>

#include "live/frame_layout.hpp"

namespace corpuscle {
namespace {

std::string counted_noun(std::size_t n, std::string_view noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

/// "a count and 4793 numbers"
std::string contents_of(const FrameLayout& layout, std::size_t numbers) {
    const auto values = counted_noun(numbers, "number");
    return layout.stamp == FrameStamp::none
               ? values
               : fmt::format("a {} and {}", layout.stamp == FrameStamp::sequence ? "sequence number" : "time", values);
}

std::string expected_frame(const FrameLayout& layout, std::string_view population) {
    return fmt::format("'{}' has {}, so a frame must have {}", population, counted_noun(layout.sites, "site"),
                       contents_of(layout, layout.sites));
}

}  // namespace

std::string describe_frame_error(const FrameError& misfit, const FrameLayout& layout, std::string_view population) {
    const std::size_t stamps = layout.stamp == FrameStamp::none ? 0 : 1;
    switch (misfit.reason) {
        case FrameError::width:
            return fmt::format("frame {} has {}; {}", misfit.frame,
                               misfit.found < stamps ? "nothing" : contents_of(layout, misfit.found - stamps),
                               expected_frame(layout, population));
        case FrameError::stamp:
            return fmt::format("frame {} does not begin with {}; {}", misfit.frame,
                               layout.stamp == FrameStamp::sequence ? "its sequence number, an integer" : "its time in seconds",
                               expected_frame(layout, population));
        case FrameError::endless:
            return fmt::format("frame {} is a line longer than any frame; {}", misfit.frame, expected_frame(layout, population));
        case FrameError::datagram:
            return fmt::format("a datagram has {} bytes; {}, {} bytes of binary", misfit.found, expected_frame(layout, population),
                               layout.bytes());
        case FrameError::header:
            return misfit.detail;
    }
    return {};
}

}  // namespace corpuscle
