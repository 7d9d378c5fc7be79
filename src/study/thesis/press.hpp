#pragma once
// The thesis's press (1.2, fig. 4), for studies: its phases, its samples, and what is told of the spikes under it.

#include <string>
#include <vector>

#include "measure/measures.hpp"
#include "study/claim.hpp"
#include "study/trains.hpp"

namespace corpuscle::press {

// s; late: the plateau's last 100 ms
inline constexpr Stretch rest{0, 0.25}, up{0.25, 0.375}, plateau{0.375, 0.625}, late{0.525, 0.625}, down{0.625, 0.75}, after{0.75, 1.0};
inline constexpr double least = 0.2, most = 4;  // N

/// Its force at samples T apart, over time.
Result<Line> samples(double T);

inline double count(const std::vector<double>& train, const Stretch& s) { return measure<SpikeCount>(train, s); }
/// "0 5 9 1 0": spikes at rest, in protraction, plateau, retraction and after.
std::string pattern(const std::vector<double>& train);
/// The instantaneous frequency as the thesis draws it: of each spike to the next one, at the time of the first of them (3.3).
Line frequency(const std::vector<double>& train);
/// As many tools draw it: at the time of the second.
Line frequency_behind(const std::vector<double>& train);

/// Says beside a claim what is known elsewhere, and how well; nothing is judged by it.
Claim& known_as(Claim&, double value, const std::string& mark);

/// The thesis's models as it runs them: Algorithms 4 to 6 at its own 1 ms, spikes on the samples.
Asked as_algorithm(std::string afferent, std::vector<std::string> settings = {});

}  // namespace corpuscle::press
