// Arbitrary bytes as a NIR file, or as the datasets that a helper program sends. A graph that is accepted must be simulated without a
// result that is out of its arrays, and a file that is refused must have a message.

#include <cmath>
#include <string>

#include "io/hdf5/hdf5_tree.hpp"
#include "nir/graph_file.hpp"
#include "nir/network.hpp"
#include "recording.hpp"

namespace {

using namespace corpuscle;

void simulate(Result<nir::Graph> graph) {
    if (!graph) return fuzz::check(graph.error(), 0);
    fuzz::require(graph->input_count() > 0 && graph->output_count() > 0);
    if (graph->input_count() + graph->output_count() > 100'000) return;
    const auto shared = std::make_shared<const nir::Graph>(*std::move(graph));
    for (const auto update : {nir::Update::exact, nir::Update::euler, nir::Update::backward_euler}) {
        const auto network = nir::Network::create(shared, 1e-3, update);
        if (!network) {
            fuzz::check(network.error(), 0);
            continue;
        }
        auto state = network->start(), workspace = network->workspace();
        const std::vector<double> input(network->input_count(), 1.0);
        std::vector<double> output(network->output_count());
        for (int k = 0; k < 3; ++k) network->step(input, output, state, workspace);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 1) return 0;
    const std::string bytes(reinterpret_cast<const char*>(data + 1), size - 1);
    if (data[0] & 1) {
        const auto arrays = decode_tree(bytes, "x.nir");
        if (arrays) simulate(nir::graph_of(*arrays, "x.nir"));
        return 0;
    }
    if (!bytes.starts_with("\x89HDF")) return 0;
    static const std::string path = "/tmp/corpuscle-fuzz-" + std::to_string(::getpid()) + ".nir";
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(bytes.data(), 1, bytes.size(), f);
        std::fclose(f);
    }
    simulate(nir::read_graph(path));
    return 0;
}
