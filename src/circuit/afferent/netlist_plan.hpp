#pragma once
// The plan of an afferent that is a netlist.

#include "core/afferent_factory.hpp"

namespace corpuscle::circuit {

/// The afferent of an embedded netlist or of a netlist file with a force input and a spike output (doc/circuits.md). The file is read when
/// the afferent is planned, because an override can choose the process corner; see netlist_overrides.hpp.
class NetlistSpec final : public AfferentSpec {
public:
    explicit NetlistSpec(std::string_view name_or_path) : AfferentSpec(name_or_path) {}
    Result<PlannedAfferent> plan(std::span<const ParameterOverride>, std::span<const std::string> probes) const override;
};

}  // namespace corpuscle::circuit
