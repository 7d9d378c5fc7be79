#pragma once
// The thesis's sensor and what may stand around it (4.1, 4.2), for studies: eq. 13, and transducers as netlists of cells beside each other.

#include <span>
#include <string>
#include <vector>

#include "study/deck.hpp"

namespace corpuscle {

constexpr double gram_force = 9.80665e-3;       // N
constexpr double least_gf = 20, most_gf = 400;  ///< where the thesis reads its transducer off (4.2)

/// Eq. 13 as it is meant (errata F1): G = 1/R_0 + F^m / a, F in gf, a = 170 kohm gf^m.
struct ForceSensor {
    double R_0 = 10e6, a = 170e3, m = 0.72;
    double conductance(double gf) const;
    double resistance(double gf) const { return 1 / conductance(gf); }
    double slope(double gf) const;  ///< dG/dF, S/gf
    Line conductances(double from, double to, double step = 1) const;
};

/// A transducer around a sensor of its own: lines between vx (the sensor), vz (the amplifier's output), if (what is read, held at the
/// supply by a source vif), vdd, vy. Its devices' names begin with the letters of SPICE.
struct TransducerCell {
    std::string name, lines;
};
/// The thesis's, fig. 22 and table 1, what is read drawn from `drain`; and what is left of it without M3: the bulks at `bulk`.
std::string improved_cell(const std::string& drain = "if");
std::string improved_cell_at(const std::string& bulk, const std::string& drain = "if");
/// Fig. 22 read by the diode of the next block's mirror (table 3's M3A), which stands at the source vif.
std::string read_cell();
/// Fig. 21: one transistor of `columns` units.
std::string plain_cell(int columns);

/// Fig. 20 with a follower behind the amplifier, its output at z.
std::string voltage_cell(double R_F);

/// All of them beside each other under one force (source vforce, V as N: "4", "dc 0 force 1"), supply (vdd) and reference (vy):
/// v(xNAME.vx), i(xNAME.vif). `parts` stands for the line that includes the parts.
std::string transducers(std::span<const TransducerCell>, const std::string& force,
                        const std::string& parts = ".include 'parts/transducer.inc'");

/// The least supply at which each still holds its sensor: v_x at least 95 % of the 0.1 V of v_y, and so the sensor's current that of
/// eq. 15. NaN: at none up to 1 V.
Result<std::vector<double>> lowest_supplies(std::span<const TransducerCell>, double newtons, const std::vector<std::string>& settings = {},
                                            const std::string& parts = ".include 'parts/transducer.inc'");

}  // namespace corpuscle
