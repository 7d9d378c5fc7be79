#pragma once
// The experiment of fig. 4 A and B on the built-in fingertip: the same press in five directions and at five places.

#include <array>
#include <string>

#include "reproduction/claims/study.hpp"
#include "reproduction/skin/fingertip.hpp"

namespace corpuscle::directions {

/// The direction of a force, or the side of the fingertip to which a place is shifted. The finger is a right index finger seen from the
/// palm, so radial is x and distal is y.
struct Direction {
    const char* name;
    double azimuth;  ///< degrees
};
inline constexpr std::array<Direction, 4> sides = {{{"radial", 0}, {"distal", 90}, {"ulnar", 180}, {"proximal", 270}}};

inline constexpr double tilt = 20;  ///< degrees from the normal, of the four oblique forces

/// How the spikes of one afferent depend on the direction of the force.
struct AfferentTuning {
    std::string afferent;          ///< "sa1"
    double direction = 0;          ///< its preferred direction in the skin, rad
    double normal = 0;             ///< spikes under the normal force
    std::array<double, 4> spikes;  ///< under each oblique force

    double mean() const { return (spikes[0] + spikes[1] + spikes[2] + spikes[3]) / 4; }
    bool responds() const { return normal + mean() > 0; }
    /// True if the largest and the smallest count differ by at least a fifth of the mean and by two spikes. The simulation has no noise, so
    /// there is no statistical test.
    bool is_tuned() const;
    double x() const { return (spikes[0] - spikes[2]) / 2; }  ///< spikes; the components of the preferred direction as it shows in spikes
    double y() const { return (spikes[1] - spikes[3]) / 2; }
};

/// Presses the middle of the fingertip with 4 N in five directions. Returns all afferents.
Result<std::vector<AfferentTuning>> measure_tuning();

/// Adds claims and plots on directions and places to the study.
Result<void> report(StudyResult&);

}  // namespace corpuscle::directions
