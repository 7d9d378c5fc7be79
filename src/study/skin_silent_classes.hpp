#pragma once
// Classes of a skin in which no afferent fired: the largest force on their afferents, and how much stronger the same stimulus must be.

#include <optional>
#include <vector>

#include "study/skin_run.hpp"

namespace corpuscle {

struct SilentClass {
    std::size_t class_index = 0;   ///< index of the class
    double max_force = 0;          ///< N: largest force on an afferent of the class
    std::optional<double> factor;  ///< by which the stimulus must be stronger for one of them to fire
};

/// Computes an upper bound of the force on each afferent: the weighted mean, over its receptive field, of the largest force of each site
/// within a block. Exact if the sites have their largest force at the same time. Memory is proportional to sites and afferents.
class SkinSilenceDetector final : public SkinSink {
    const Innervation* skin_ = nullptr;
    double dt_ = 0, max_total_force_ = 0;
    std::vector<char> has_fired_;    // for each class
    std::vector<double> max_force_;  // largest force for each class, N
    std::vector<double> site_peak_;  // of each site that the block touches, N
    std::vector<double> force_on_afferent_;
    std::vector<std::uint32_t> touched_sites_;
    std::vector<double> total_force_;  // total force of all sites

    void find_peaks(const SkinRunBlock&);
    double max_force_on_class(std::size_t class_index);

public:
    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinRunBlock&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    /// Valid after end().
    std::vector<SilentClass> silent_classes(Method, bool sampled) const;
};

}  // namespace corpuscle
