#pragma once
// A thousand chips of the inverter, without and with its bias generator, and the means and spreads of tables 17 and 18.

#include "study/sample_statistics.hpp"

namespace corpuscle::bias_chips {

struct InverterCase {
    const char *circuit, *name, *voltage, *current;  ///< voltage, current: of the output, in the netlist
    struct PublishedSpread {
        double mean, percent;  // V or A; % of the mean
    } V[3], I[3];              ///< one for each of `variations`
    bool is_fitted;  ///< true: the spread of the process card was fitted to this row
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
struct Variation {
    const char *name, *corner, *mc_options;
};
inline constexpr Variation variations[] = {{"process", "mc", "mismatch=0"}, {"mismatch", "tt", "process=0"}, {"all", "mc", ""}};

using Chips = std::vector<NetlistResult>;
/// Simulates 1000 chips of a circuit.
Result<Chips> simulate_chips(const std::string& circuit, const Variation&);

/// A parameter of a transistor's model card: "avt", V m.
double model_parameter(const circuit::Circuit&, std::size_t element, const char* name);
/// Total channel area of the unit transistors of an array, m^2.
double channel_area(const circuit::Element&);

}  // namespace corpuscle::bias_chips
