#pragma once
// Afferents that never fired, and the factor by which the same force must be multiplied to make them fire.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/run_inputs.hpp"

namespace corpuscle {

/// Largest number of force samples of an input, summed over its channels, that are kept for the search of the factor. Later samples are
/// ignored.
inline constexpr std::size_t max_silence_samples = std::size_t{1} << 18;

/// The smallest factor, at least 1, by which `force` (N) must be multiplied for the afferent to fire; the result is at most 2 %
/// larger. No value if the factor exceeds a million.
std::optional<double> factor_to_fire(const AfferentPlan&, const SimulationOptions&, std::span<const double> force);

/// An afferent that, with all of its copies, never fired on any channel of any input.
struct SilentAfferent {
    std::string name;
    double force = 0;              ///< N, the largest force on any channel of any input
    std::optional<double> factor;  ///< see factor_to_fire(); for copies, of the first copy
};

/// Finds silent afferents, and their factors for the channel with the largest force of the run. Netlists are left out, because the search
/// would take longer than the run.
class SilenceDetector final : public Sink {
    std::vector<std::vector<double>> force_samples_;  // kept force samples of each channel of the current input, N
    std::vector<double> channel_max_;                 // largest force of each channel of the current input, N
    std::vector<char> has_fired_;                     // of each plan: 1 if it has fired on any channel of any input
    double largest_force_ = 0;                        // of all channels of all inputs so far, N
    std::vector<double> largest_force_samples_;       // kept force samples of the channel with the largest force, N
    double dt_ = 0;                                   // sample period of that channel, s

public:
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;
    /// `afferents`: the plans of the run, including copies.
    std::vector<SilentAfferent> silent_afferents(std::span<const AfferentPlan> afferents, const RespondOptions&) const;
};

/// A message such as "fa1 never fired: the largest force was 0.5 N; it would fire at about 6.3 times this
/// force".
std::string silence_message(const SilentAfferent&);

/// A number with two significant digits, rounded up: "1.5", "0.0021".
std::string format_rounded_up(double);

}  // namespace corpuscle
