#pragma once
// The complete force of a request: a stimulus by name, or an array.

#include "core/force_source.hpp"
#include "page/object_reader.hpp"

namespace corpuscle::page {

struct PageForce {
    Clock clock;
    std::vector<double> force;  ///< N
    std::vector<Phase> phases;  ///< of a stimulus
    bool is_stimulus = false;
    std::uint64_t seed = 0;  ///< of all random numbers of the request
};

/// Reads the keys "rate", "seed", "stimulus" and "stimulus_set", or the array "force" instead of the last two.
Result<PageForce> read_force(ObjectReader&);

}  // namespace corpuscle::page
