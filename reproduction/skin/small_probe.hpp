#pragma once
// The afferents of a skin under a small probe: least forces and receptive fields.

#include <string>
#include <vector>

#include "skin/innervation.hpp"

namespace corpuscle {

/// The afferents of one class.
struct ProbedClass {
    std::string afferent;             ///< name of the class: "sa1"
    std::vector<std::size_t> units;   ///< those that respond to a site, counted from 0 at the first afferent of the class
    std::vector<std::uint32_t> site;  ///< for each of them, the site at which it is most sensitive
    /// For each of them, the least force (N) on the probe at this site that evokes a spike; NaN if 10 N do not.
    std::vector<double> least_force;
    std::vector<double> field_area;  ///< of some of them, the area (m2) of the sites at which four times the least force evokes a spike
};

/// How the probe presses: a sphere of 0.5 mm radius, a linear ramp from zero force, a hold.
inline constexpr double probe_radius = 0.5e-3, probe_ramp = 50e-3, probe_hold = 100e-3;  // m, s, s
inline constexpr double probe_rate = 4e3;                                                // Hz, of the simulation

/// Measures all afferents of a skin, and in each class the fields of at most `fields_per_class`, evenly spaced in its list. Least
/// forces are found by bisection to 2 %. Contact waves are included, conduction
/// is not.
Result<std::vector<ProbedClass>> probe_skin(const Innervation&, std::size_t fields_per_class);

}  // namespace corpuscle
