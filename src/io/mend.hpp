#pragma once
// A channel's readings made whole: what is missing or out of range is filled in by straight lines, lone strays are taken for missing.
// What is done to a reading depends on it and its neighbours alone, whatever the blocks it comes in.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "signal/error.hpp"

namespace corpuscle {

/// What --despike is given: how far from its neighbours' median a reading may stand.
struct Despike {
    std::optional<double> limit = {};  ///< in what is read; none: 6 standard deviations, as the median of the window's deviations gives it
};

/// A reading further than the limit from the median of the 25 about it is missing (Hampel's rule). It comes 12 readings late.
class StrayFilter {
    static constexpr std::size_t half = 12, window = 2 * half + 1;
    std::optional<double> limit_;
    std::vector<double> last_;    // at most `window` readings, the oldest first
    std::vector<double> sorted_;  // the finite ones among them
    std::size_t centre_ = 0;      // place in last_ of the next reading to be judged

    double judged();

public:
    explicit StrayFilter(const Despike& despike) : limit_(despike.limit) {}
    void push(double x, std::vector<double>& out);
    void finish(std::vector<double>& out);
    std::int64_t found = 0;
};

/// Missing readings (NaN) become the straight line between their neighbours; at either end the nearest reading is held.
class GapFiller {
    static constexpr std::int64_t longest = 1'000'000;
    double before_ = std::numeric_limits<double>::quiet_NaN();
    std::int64_t missing_ = 0;  // readings since `before_`

    Result<void> push(double x, std::vector<double>& out);

public:
    Result<void> push(std::span<const double> x, std::vector<double>& out);
    Result<void> finish(std::vector<double>& out);
    std::int64_t filled = 0;
};

}  // namespace corpuscle
