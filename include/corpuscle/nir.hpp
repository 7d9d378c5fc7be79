#pragma once
// Spiking networks in NIR files (Neuromorphic Intermediate Representation, https://neuroir.org).

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "corpuscle/error.hpp"

namespace corpuscle {

/// A node of a NIR graph.
struct NirNode {
    std::string name, type;                                 ///< "lif1", "CubaLIF"
    std::vector<std::uint64_t> input_shape, output_shape;
    std::map<std::string, std::vector<double>> parameters;  ///< in row-major order; a weight has the shape [output, input]
};

/// A graph that was read. Runs may happen on several threads at the same time.
class NirGraph {
    struct Impl;
    std::shared_ptr<const Impl> impl_;

public:
    /// Called often with the completed fraction, 0 to 1. If it returns false, the run stops with InterruptedError.
    using Progress = std::function<bool(double)>;

    /// Reads a file. Graphs within the graph become parts of it. Throws InputError.
    CORPUSCLE_API explicit NirGraph(const std::string& path);

    CORPUSCLE_API std::vector<NirNode> nodes() const;
    CORPUSCLE_API std::vector<std::pair<std::string, std::string>> edges() const;  ///< names of the nodes from which and to which
    CORPUSCLE_API std::string version() const;                                     ///< of NIR, as the file states it
    CORPUSCLE_API std::vector<std::string> input_nodes() const;   ///< the nodes of the type Input, in the order of their signals
    CORPUSCLE_API std::vector<std::string> output_nodes() const;  ///< the same for Output
    CORPUSCLE_API std::size_t input_count() const;                ///< number of signals of all input nodes
    CORPUSCLE_API std::size_t output_count() const;

    /// Simulates the graph. `input`: for each step the input_count() signals; a spike is the value 1 for one step. `rate`: steps per second.
    /// `method`: "exact", "euler" (forward) or "backward-euler". Returns for each step the output_count() signals. See doc/nir.md. Throws
    /// InputError if the input has no complete steps or is not finite, or if the rate is too low for the method.
    CORPUSCLE_API std::vector<double> run(std::span<const double> input, double rate, const std::string& method = "exact",
                                          const Progress& = {}) const;
};

}  // namespace corpuscle
