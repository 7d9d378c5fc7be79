#pragma once
// The thesis's force sensor (4.1, 4.2): eq. 13, and netlists of transducer cells in a row.

#include <span>
#include <string>
#include <vector>

#include "reproduction/claims/study_netlist.hpp"

namespace corpuscle {

constexpr double gram_force = 9.80665e-3;    // N
constexpr double min_gf = 20, max_gf = 400;  ///< gf: the range of forces over which the thesis evaluates its transducer (4.2)

/// Eq. 13 corrected (errata F1): conductance G = 1/R_0 + F^m / a, with the force F in gf, the resistance R_0 without force, and a = 170
/// kohm gf^m.
struct ForceSensor {
    double R_0 = 10e6, a = 170e3, m = 0.72;                                       ///< ohm, ohm gf^m, exponent
    double conductance(double gf) const;                                          ///< S
    double resistance(double gf) const { return 1 / conductance(gf); }            ///< ohm
    double slope(double gf) const;                                                ///< dG/dF, S/gf
    StudyCurve conductance_curve(double from, double to, double step = 1) const;  ///< S over gf
};

/// Netlist lines of a transducer's transistors; transducer_netlist adds a sensor and an amplifier to each cell. Nodes: vx (sensor), vz
/// (amplifier output), if (output current, held at the supply by the source vif), vdd, and vy (reference of the amplifier).
struct TransducerCell {
    std::string name, lines;
};
/// The thesis's transducer, fig. 22 and table 1, with its output at node `drain`. The second function leaves out M3 and connects the bulks
/// to `bulk`.
std::string improved_cell(const std::string& drain = "if");
std::string improved_cell_with_bulks(const std::string& bulk, const std::string& drain = "if");
/// Fig. 22 with the diode of the next block's mirror (table 3's M3A) as its load; the diode is connected to the source vif.
std::string improved_cell_with_diode();
/// Fig. 21: one transistor of `columns` unit transistors in parallel.
std::string single_transistor_cell(int columns);

/// Fig. 20 with the feedback resistor R_F (ohm), and a follower behind the amplifier; the follower's output is node z.
std::string voltage_cell(double R_F);

/// A netlist of all cells with a common force, supply (vdd) and reference (vy, 0.1 V). `force` is the value of the source vforce, 1 V per
/// N: "4", or "dc 0 force 1" for the stimulus. The cells' voltages and currents are named v(xNAME.vx), i(xNAME.vif). `parts` is the line
/// that includes the subcircuits.
std::string transducer_netlist(std::span<const TransducerCell>, const std::string& force,
                               const std::string& parts = ".include 'parts/transducer.inc'");

/// The lowest supply (V) at which each cell still regulates its sensor's voltage under this force: v(vx) is at least 95 % of the 0.1 V of
/// v(vy), so that the sensor's current follows eq. 15. The supply is swept from 0.3 to 1 V; NaN if v(vx) never reaches that value.
Result<std::vector<double>> find_lowest_supplies(std::span<const TransducerCell>, double newtons,
                                                 const std::vector<std::string>& settings = {},
                                                 const std::string& parts = ".include 'parts/transducer.inc'");

}  // namespace corpuscle
