#pragma once
// If many afferents share one force and one set of receptor parameters, the current of their receptor is computed once.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/afferent_factory.hpp"
#include "model/lanes/kernel.hpp"

namespace corpuscle::lanes {

/// The currents of one output under a profile, A: for each step the current at its beginning and at its end, and their sum.
struct ProfileCurrents {
    std::vector<double> from, to, end_sum;
};

/// A receptor in double precision whose currents are those of all afferents, apart from a gain.
class SharedReceptor {
public:
    virtual ~SharedReceptor() = default;
    virtual std::vector<double> save() const = 0;
    virtual bool resume(std::span<const double>) = 0;  ///< returns false if the values are not a state of this receptor
    /// Simulates the next steps, one for each sample of force (N). `first`: true for the first block of a simulation.
    virtual void run(std::span<const double> force, bool first, std::array<ProfileCurrents, max_outputs>& out) = 0;
};

/// The shared receptor of a plan.
std::unique_ptr<SharedReceptor> make_shared_receptor(const AfferentPlan&, const SimulationOptions&);

/// True if the current of the plan's receptor is proportional to force.
bool scales_with_force(const AfferentPlan&);

}  // namespace corpuscle::lanes
