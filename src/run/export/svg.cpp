// svg: the schematic of a netlist (circuit/schematic).

#include <fmt/format.h>

#include "circuit/schematic/schematic.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "model/catalog.hpp"
#include "run/export/targets.hpp"

namespace corpuscle {
namespace {

Result<ExportedModel> write_svg(const ExportRequest& request) {
    if (circuit::find_embedded_netlist(request.subject) == nullptr && read_model_spec(request.subject))
        return bad_input(
            fmt::format("{} is an afferent of equations, and --for svg draws netlists; choose one, such as sa1-circuit", request.subject));
    auto applied = TRY(circuit::apply_overrides(request.subject, request.settings));
    TRY(check_all_used(applied.unused, std::array<std::string_view, 1>{request.subject}));
    return ExportedModel{TRY(circuit::draw_schematic(applied.result, request.block)).svg, {}};
}

bool is_own_svg(std::string_view beginning) {
    return beginning.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"schematic\"");
}

}  // namespace

const ExportTarget svg_target{.name = "svg",
                              .description = "the schematic of a netlist",
                              .kind = "schematic",
                              .takes_block = true,
                              .is_text = true,
                              .write = write_svg,
                              .is_own = is_own_svg};

}  // namespace corpuscle
