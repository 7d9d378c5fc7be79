#pragma once
// A thousand chips of the inverter, without and with its bias generator, and the published means and spreads of tables 17 and 18.

#include "reproduction/claims/sample_statistics.hpp"

namespace corpuscle::bias_chips {

struct InverterCase {
    const char *circuit, *name, *voltage, *current;  ///< voltage, current: the netlist's names of V_Q and I_Q
    struct PublishedSpread {
        double mean, percent;  // V or A; % of the mean
    } V[3], I[3];              ///< one for each of `variations`
    bool is_fitted;            ///< true: the process card's spread was fitted to these numbers
};
inline constexpr InverterCase inverter_cases[] = {
    {"quiescent",
     "no biasing",
     "v(qa)",
     "i(visa)",
     {{355.5e-3, 2.64}, {355.1e-3, 0.13}, {355.2e-3, 2.28}},
     {{17.51e-9, 28.4}, {17.59e-9, 1.19}, {17.50e-9, 27.2}},
     true},
    {"bias",
     "biasing",
     "v(q)",
     "i(vis)",
     {{350.1e-3, 0.02}, {350.1e-3, 0.19}, {350.1e-3, 0.18}},
     {{199.6e-9, 0.77}, {199.4e-9, 2.56}, {199.0e-9, 2.59}},
     false},
};
/// The random quantities that a .mc directive samples: the process by corner mc, the mismatch unless it is switched off.
struct Variation {
    const char *name, *corner, *mc_options;
};
inline constexpr Variation variations[] = {{"process", "mc", "mismatch=0"}, {"mismatch", "tt", "process=0"}, {"all", "mc", ""}};

using Chips = std::vector<NetlistResult>;
/// Simulates 1000 chips of a circuit.
Result<Chips> simulate_chips(const std::string& circuit, const Variation&);

/// A parameter of the model card of the element with this index, which must be a transistor: "avt", V m.
double model_parameter(const circuit::Circuit&, std::size_t element, const char* name);
/// Channel area of an array, summed over its unit transistors, m^2.
double channel_area(const circuit::Element&);

}  // namespace corpuscle::bias_chips
