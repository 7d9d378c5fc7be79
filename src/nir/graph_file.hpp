#pragma once
// NIR files, which are HDF5 files.

#include <span>

#include "io/hdf5/hdf5_tree.hpp"
#include "nir/graph.hpp"

namespace corpuscle::nir {

/// Reads a graph. Graphs within the graph become parts of it. Metadata are not read. Returns an error if the file is not a NIR file, has a
/// node that is not simulated, or is inconsistent.
Result<Graph> read_graph(const std::string& path);

/// The graph of the datasets of a NIR file; `path` is for messages.
Result<Graph> graph_of(std::span<const Hdf5Array>, const std::string& path);

/// A text of the metadata of a file.
struct Metadata {
    std::string name, text;
};

/// The bytes of the file of a graph, which graph_of() must accept.
Result<std::string> graph_bytes(const Graph&, const std::vector<Metadata>&);

}  // namespace corpuscle::nir
