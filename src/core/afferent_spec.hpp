#pragma once
// An afferent as the user specifies it. Equations (model/catalog.cpp) and netlists (circuit/afferent/netlist_plan.cpp) are specified
// differently; run/afferent_plan.cpp reads the text of either.

#include <span>

#include "core/afferent_factory.hpp"

namespace corpuscle {

/// The specification of an afferent: the text of the user, already read, without the overrides.
class AfferentSpec {
    std::string text_;

public:
    explicit AfferentSpec(std::string_view text) : text_(text) {}
    AfferentSpec(const AfferentSpec&) = delete;
    AfferentSpec& operator=(const AfferentSpec&) = delete;
    virtual ~AfferentSpec() = default;

    /// The text: "SA1", "sa1b+izhikevich", "path/own.cir". It is one of the targets of overrides for this afferent.
    const std::string& text() const { return text_; }
    /// Plans the afferent with the overrides that are for it. `probes`: recorded instead of the .save quantities of a netlist that has at
    /// least one of them.
    virtual Result<PlannedAfferent> plan(std::span<const ParameterOverride>, std::span<const std::string> probes) const = 0;
};

}  // namespace corpuscle
