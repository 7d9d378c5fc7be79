#include "core/spike.hpp"

namespace corpuscle {

std::vector<double> spike_times(std::span<const Spike> train, const Clock& clock) {
    std::vector<double> out;
    out.reserve(train.size());
    for (const Spike& s : train) out.push_back(clock.time(s.step, s.offset));
    return out;
}

}  // namespace corpuscle
