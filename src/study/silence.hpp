#pragma once
// Afferents that never fired: how much more of the same force would make them fire.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "study/respond.hpp"

namespace corpuscle {

/// Samples of force that are kept to answer the question; what comes later is left out.
inline constexpr std::size_t most_silent_samples = std::size_t{1} << 18;

/// The factor, from 1 on, by which force must be multiplied for the afferent to fire; to 2 %, and rather too large. None: it takes more
/// than a million times as much.
std::optional<double> factor_to_fire(const AfferentPlan&, const Run&, std::span<const double> force);

/// An afferent, with all of its copies, that never fired on any channel of any input.
struct SilentAfferent {
    std::string name;
    double force = 0;              ///< N: the largest on the channel that had most
    std::optional<double> factor;  ///< to fire
};

/// Finds them. Netlists are left out: to ask one takes longer than all of the run.
class Silence final : public Listener {
    std::vector<std::vector<double>> kept_;  // of each channel of the input at work
    std::vector<double> largest_;            // ... N
    std::vector<char> fired_;                // of each afferent
    std::vector<double> course_;             // of the channel with the largest force so far
    double force_ = 0, dt_ = 0;

public:
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    /// `afferents`: those that took part, copies among them.
    std::vector<SilentAfferent> found(std::span<const AfferentPlan> afferents, const RespondOptions&) const;
};

/// "fa1 never fired: the force was 0.5 N at most; it fires from about 6.3 times the same force on".
std::string sentence_of(const SilentAfferent&);

/// "1.5", "0.0021": two digits, rounded up.
std::string rounded_up(double);

}  // namespace corpuscle
