#pragma once
// Classes of a skin of which no afferent fired: how much force its afferents felt, and how much more of the same touch makes them fire.

#include <optional>
#include <vector>

#include "study/skin_run.hpp"

namespace corpuscle {

struct SilentClass {
    std::size_t of = 0;            ///< which class
    double felt = 0;               ///< N: no afferent of it felt more
    std::optional<double> factor;  ///< by which the same touch must be stronger for one of them to fire
};

/// Takes what each afferent feels for not more than its field's mean of the largest force at each site within a block: exact where sites
/// have their largest force together. Memory goes with the sites and units.
class SkinSilence final : public SkinListener {
    const Innervation* skin_ = nullptr;
    double dt_ = 0, largest_ = 0;
    std::vector<char> fired_;   // of each class
    std::vector<double> felt_;  // ... N
    std::vector<double> peak_;  // of each site that the block touches, N
    std::vector<double> of_unit_;
    std::vector<std::uint32_t> touched_;
    std::vector<double> course_;  // force of all sites together

    void find_peaks(const SkinAnswered&);
    double most_felt(std::size_t of);

public:
    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinAnswered&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    /// From end() on.
    std::vector<SilentClass> found(Method, bool sampled) const;
};

}  // namespace corpuscle
