#pragma once
// A shortcut for one force shared by many afferents: the current of their common receptor is computed once.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "model/catalog.hpp"
#include "model/lanes/kernel.hpp"

namespace corpuscle::lanes {

/// Currents of a profile, A: for each output and step the values at both ends, and their sum.
struct ProfileCurrents {
    std::vector<double> from, to, end_sum;
};

class SharedReceptor {
public:
    virtual ~SharedReceptor() = default;
    virtual std::vector<double> save() const = 0;
    virtual bool resume(std::span<const double>) = 0;  ///< false: not a state of this receptor
    /// Simulates the next steps. `first`: they are the beginning of the profile.
    virtual void run(std::span<const double> force, bool first, std::array<ProfileCurrents, max_outputs>& out) = 0;
};

/// The shared receptor of a plan.
std::unique_ptr<SharedReceptor> make_shared_receptor(const AfferentPlan&, const SimulationOptions&);

/// True if twice the force gives twice the current.
bool scales_with_force(const AfferentPlan&);

}  // namespace corpuscle::lanes
