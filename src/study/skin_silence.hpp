#pragma once
// Classes of a skin in which no afferent fired: the largest force on their afferents, and how much stronger the same stimulus must be.

#include <optional>
#include <vector>

#include "study/skin_run.hpp"

namespace corpuscle {

struct SilentClass {
    std::size_t of = 0;            ///< index of the class
    double felt = 0;               ///< N: largest force on an afferent of the class
    std::optional<double> factor;  ///< by which the stimulus must be stronger for one of them to fire
};

/// Estimates the force on each afferent, from above, by its receptive field's mean over the largest force of each site within a block.
/// Exact if the sites have their largest force at the same time. Memory is proportional to sites and afferents.
class SkinSilence final : public SkinListener {
    const Innervation* skin_ = nullptr;
    double dt_ = 0, largest_ = 0;
    std::vector<char> fired_;   // for each class
    std::vector<double> felt_;  // largest force for each class, N
    std::vector<double> peak_;  // of each site that the block touches, N
    std::vector<double> of_unit_;
    std::vector<std::uint32_t> touched_;
    std::vector<double> course_;  // total force of all sites

    void find_peaks(const SkinAnswered&);
    double most_felt(std::size_t class_index);

public:
    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinAnswered&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    /// Valid after end().
    std::vector<SilentClass> found(Method, bool sampled) const;
};

}  // namespace corpuscle
