#pragma once
// Classes of a skin in which no afferent fired: the largest force on their afferents, and the factor by which the same stimulus must be
// stronger to make one of them fire.

#include <optional>
#include <vector>

#include "run/run_inputs.hpp"

namespace corpuscle {

struct SilentClass {
    std::size_t class_index = 0;   ///< in SkinPlan::classes
    double max_force = 0;          ///< N, upper bound of the force on any afferent of the class (see below)
    std::optional<double> factor;  ///< by which the stimulus must be multiplied for an afferent of the class to fire; see factor_to_fire()
};

/// Finds the classes in which no afferent fires. The force on an afferent is estimated by an upper bound: for each block, the sum over its
/// receptive field of weight times the largest force of the site within the block. The bound is exact if all sites have their largest force
/// at the same time. Memory is proportional to the number of sites and afferents.
class SkinSilenceDetector final : public Sink {
    const Innervation* skin_ = nullptr;
    double dt_ = 0;                             // sample period, s
    double max_total_force_ = 0;                // largest total force of all sites, N
    std::vector<char> has_fired_;               // for each class: 1 if an afferent has fired
    std::vector<double> class_max_force_;       // for each class: upper bound of the force on its afferents so far, N
    std::vector<double> site_peak_;             // largest force of each site within the current block, N; valid for touched_sites_
    std::vector<std::uint32_t> touched_sites_;  // sites with force in the current block
    std::vector<double> force_on_afferent_;     // zeros between calls; the sums while max_force_on_class() computes them, N
    std::vector<double> total_force_;           // total force of all sites at each sample, the first max_silence_samples of them, N

    void find_site_peaks(const RunBlock&);
    double max_force_on_class(std::size_t class_index);

public:
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;
    /// Valid after end(). The arguments are the options of the run, for the search of the factor.
    std::vector<SilentClass> silent_classes(Method, bool sampled) const;
};

}  // namespace corpuscle
