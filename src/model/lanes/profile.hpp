#pragma once
// The shortcut for one force felt by many: its transduction, worked out once.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "model/catalog.hpp"
#include "model/lanes/kernel.hpp"

namespace corpuscle::lanes {

/// A profile's currents, A: for each output, one value a step; those at its ends, and their sum.
struct ProfileCurrents {
    std::vector<double> from, to, both;
};

class ProfileTransduction {
public:
    virtual ~ProfileTransduction() = default;
    virtual std::vector<double> save() const = 0;
    virtual bool resume(std::span<const double>) = 0;  ///< false: these are not its own
    /// The next steps; `first`: they begin the profile.
    virtual void run(std::span<const double> force, bool first, std::array<ProfileCurrents, most_outputs>& out) = 0;
};

/// Of a plan's transduction.
std::unique_ptr<ProfileTransduction> profile_transduction(const AfferentPlan&, const Run&);

/// Whether twice the force is twice the current.
bool scales(const AfferentPlan&);

}  // namespace corpuscle::lanes
