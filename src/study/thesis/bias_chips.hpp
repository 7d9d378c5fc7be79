#pragma once
// A thousand chips of the inverter, without and with its bias generator, and the means and spreads of tables 17 and 18.

#include "study/spread.hpp"

namespace corpuscle::bias_chips {

struct Row {
    const char *circuit, *name, *voltage, *current;
    struct Printed {
        double mean, spread;  // V or A; % of the mean
    } V[3], I[3];
    bool fitted;  ///< true: the spread of the process card was fitted to this row
};
inline constexpr Row rows[] = {
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
struct Way {
    const char *name, *corner, *words;
};
inline constexpr Way ways[] = {{"process", "mc", "mismatch=0"}, {"mismatch", "tt", "process=0"}, {"all", "mc", ""}};

using Chips = std::vector<Found>;
/// Simulates 1000 chips of a circuit.
Result<Chips> chips_of(const std::string& circuit, const Way&);

/// A parameter of a transistor's model card: "avt", V m.
double card(const circuit::Circuit&, std::size_t element, const char* name);
/// Channel area of all its unit transistors, m^2.
double area(const circuit::Element&);

}  // namespace corpuscle::bias_chips
