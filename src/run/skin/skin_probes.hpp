#pragma once
// Records currents and membranes of a skin. Lanes record no probes, so each afferent is simulated a second time, individually, under the
// same force; its spikes are the same bit for bit.

#include "model/copies.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

class SkinProbes {
public:
    static constexpr std::size_t max_afferents = 50;  ///< largest number of afferents of a class

    /// Returns an error if a class has more than max_afferents afferents.
    static Result<SkinProbes> make(const Innervation&, const SimulationOptions&);
    /// The probes of each class.
    std::vector<std::span<const Probe>> class_probes() const;
    /// Simulates the next block.
    Result<void> respond(const SiteForce&, std::size_t steps, ThreadPool&);
    /// [afferent][probe][sample] of the last block.
    std::span<const std::vector<std::vector<double>>> values() const { return values_; }

private:
    const Innervation* skin_ = nullptr;
    std::vector<std::unique_ptr<Afferent>> afferents_;
    std::vector<State> states_;
    std::vector<std::vector<double>> force_;  // on each afferent in the current block, N
    std::vector<std::vector<std::vector<double>>> values_;

    void compute_force(const SiteForce&, std::size_t steps);
};

}  // namespace corpuscle
