// NIR: the graph of an afferent as an HDF5 file.

#include <fmt/format.h>

#include "nir/graph_file.hpp"
#include "run/export/nir_graph.hpp"

namespace corpuscle {
namespace {

Result<ExportedModel> write_nir(const ExportRequest& request) {
    const auto afferent = TRY(exported_afferent(request, nir_target));
    auto out = TRY(nir_export_of(afferent));
    std::string heading;
    for (const auto& line : afferent.heading) heading += line + "\n";
    auto bytes = TRY(nir::graph_bytes(out.graph, {{"description", heading}}));
    out.warnings.push_back(
        bad_input("a NIR graph begins at rest with the force 0, and its spikes are on the steps: choose a short step, such as 0.1 ms"));
    return ExportedModel{std::move(bytes), std::move(out.warnings)};
}

/// The mark is among the texts at the beginning of the file.
bool is_own_graph(std::string_view beginning) {
    return beginning.starts_with("\x89HDF") && beginning.find(export_mark) != beginning.npos;
}

}  // namespace

const ExportTarget nir_target{.name = "nir",
                              .description = "a NIR graph, of an afferent",
                              .kind = "graph",
                              .is_text = false,
                              .write = write_nir,
                              .is_own = is_own_graph};

}  // namespace corpuscle
