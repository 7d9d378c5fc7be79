#pragma once
// A NIR graph with one input, the force in N, and one output, the spikes of neurons, as an afferent.

#include "core/afferent_factory.hpp"

namespace corpuscle::nir {

/// True if the text names a NIR file: it ends in ".nir".
inline bool names_graph(std::string_view text) { return text.ends_with(".nir"); }

/// The afferent of a NIR file, which is read when the afferent is planned. It has no parameters. A node with a membrane and one element can
/// be recorded: "lif.v".
class GraphSpec final : public AfferentSpec {
public:
    explicit GraphSpec(std::string_view path) : AfferentSpec(path) {}
    Result<PlannedAfferent> plan(std::span<const ParameterOverride>, std::span<const std::string> probes) const override;
};

}  // namespace corpuscle::nir
