#pragma once
// Limits the rate of events: an average rate, and a number of events that may come at once.

#include <algorithm>
#include <cstdint>

namespace corpuscle {

class RateLimit {
    double per_second_, burst_, left_;
    std::int64_t last_ = 0;  // ns, time of the last call of take()

public:
    /// `burst`: how many may happen at once after a pause.
    RateLimit(double per_second, double burst) : per_second_(per_second), burst_(burst), left_(burst) {}

    /// Counts one event at the time `now` (ns). Returns the time in ns until it is allowed; 0: it is allowed now.
    std::int64_t take(std::int64_t now) {
        left_ = std::min(burst_, left_ + static_cast<double>(now - last_) * 1e-9 * per_second_);
        last_ = now;
        left_ -= 1;
        return left_ >= 0 ? 0 : static_cast<std::int64_t>(-left_ / per_second_ * 1e9);
    }
};

}  // namespace corpuscle
