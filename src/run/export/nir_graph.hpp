#pragma once
// The NIR graph of an afferent.

#include "nir/graph.hpp"
#include "run/export/equation_text.hpp"

namespace corpuscle {

struct NirExport {
    nir::Graph graph;
    std::vector<Error> warnings;  ///< about parts of the afferent that the graph only approximates
};

/// Filters become LI nodes, sums Linear and Affine nodes, a rectifier a staircase of thresholds, and the neuron an IF or LIF. Returns an
/// error with the reason and, where there is one, a remedy if NIR has no node for a part of the afferent.
Result<NirExport> nir_export_of(const ExportedAfferent&);

}  // namespace corpuscle
