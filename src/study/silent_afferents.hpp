#pragma once
// Afferents that never fired, and the factor by which the same force must be multiplied to make them fire.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/afferent_run.hpp"

namespace corpuscle {

/// Number of force samples, over all channels, that are kept for the search of the factor; later samples are ignored.
inline constexpr std::size_t max_silence_samples = std::size_t{1} << 18;

/// The factor, at least 1, by which force must be multiplied for the afferent to fire. Accurate to 2 %, rounded up. None if it exceeds a
/// million.
std::optional<double> factor_to_fire(const AfferentPlan&, const SimulationOptions&, std::span<const double> force);

/// An afferent that, with all of its copies, never fired on any channel of any input.
struct SilentAfferent {
    std::string name;
    double force = 0;              ///< N: the largest force on any channel
    std::optional<double> factor;  ///< by which force must be multiplied
};

/// Finds silent afferents. Netlists are left out, because the search would take longer than the run.
class SilenceDetector final : public ResponseSink {
    std::vector<std::vector<double>> force_samples_;  // force of each channel of the current input
    std::vector<double> max_force_;                   // of each channel of the current input, N
    std::vector<char> has_fired_;                     // of each plan
    std::vector<double> strongest_channel_;           // force samples of the channel, among all inputs, with the largest force so far
    double strongest_max_ = 0, dt_ = 0;               // of that channel: the largest force, N, and the sample period, s

public:
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    /// `afferents`: the plans of the run, including copies.
    std::vector<SilentAfferent> silent_afferents(std::span<const AfferentPlan> afferents, const RespondOptions&) const;
};

/// "fa1 never fired: the largest force was 0.5 N; it would fire at about 6.3 times this force".
std::string silence_message(const SilentAfferent&);

/// Two significant digits, rounded up: "1.5", "0.0021".
std::string format_rounded_up(double);

}  // namespace corpuscle
