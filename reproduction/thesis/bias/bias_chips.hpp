#pragma once
// A thousand chips of a circuit.

#include "reproduction/claims/sample_statistics.hpp"

namespace corpuscle::bias_chips {

/// The random quantities that a .mc directive samples: the process by corner mc, the mismatch unless it is switched off.
struct Variation {
    const char *corner, *mc_options;
};
inline constexpr Variation process_only{"mc", "mismatch=0"}, mismatch_only{"tt", "process=0"};

using Chips = std::vector<NetlistResult>;
/// Simulates 1000 chips of a circuit.
Result<Chips> simulate_chips(const std::string& circuit, const Variation&);

/// A parameter of the model card of the element with this index, which must be a transistor: "avt", V m.
double model_parameter(const circuit::Circuit&, std::size_t element, const char* name);
/// Channel area of an array, summed over its unit transistors, m^2.
double channel_area(const circuit::Element&);

}  // namespace corpuscle::bias_chips
