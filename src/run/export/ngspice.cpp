// ngspice: the deck of a netlist (circuit/export).

#include <fmt/format.h>

#include "circuit/export/ngspice_deck.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "model/catalog.hpp"
#include "run/export/targets.hpp"

namespace corpuscle {
namespace {

Result<ExportedModel> write_ngspice(const ExportRequest& request) {
    if (circuit::find_embedded_netlist(request.subject) == nullptr && read_model_spec(request.subject))
        return bad_input(
            fmt::format("{} is an afferent of equations, and --for ngspice exports netlists; choose another target, such as "
                        "--for brian2, or a netlist, such as sa1-circuit",
                        request.subject));
    auto applied = TRY(circuit::apply_overrides(request.subject, request.settings));
    TRY(check_all_used(applied.unused, std::array<std::string_view, 1>{request.subject}));
    std::optional<circuit::Kit> kit;
    if (!request.kit.first_option().empty()) kit = TRY(read_kit(request.kit, request.out)), kit->corner = applied.result.overrides().corner;
    auto circuit = TRY(applied.result.elaborate());
    auto warnings = circuit.warnings;
    auto deck = TRY(circuit::ngspice_deck(std::make_shared<const circuit::Circuit>(std::move(circuit)), kit ? &*kit : nullptr));
    warnings.insert(warnings.end(), deck.warnings.begin(), deck.warnings.end());
    return ExportedModel{std::move(deck.text), std::move(warnings)};
}

/// The mark is in the second line; the first is the title.
bool is_own_deck(std::string_view beginning) {
    beginning.remove_prefix(std::min(beginning.find('\n'), beginning.size()));
    return beginning.starts_with("\n* Written by 'corpuscle export ");
}

}  // namespace

const ExportTarget ngspice_target{.name = "ngspice",
                                  .description = "a deck for ngspice 39, of a netlist",
                                  .kind = "deck",
                                  .takes_kit = true,
                                  .is_text = true,
                                  .write = write_ngspice,
                                  .is_own = is_own_deck};

Result<ExportedModel> write_model(const ExportTarget& target, const ExportRequest& request) {
    const auto option = request.kit.first_option();
    if (!target.takes_kit && !option.empty())
        return bad_usage(fmt::format("{} is for --for ngspice; {} exports no transistors", option, target.name));
    if (!target.takes_block && !request.block.empty())
        return bad_usage(fmt::format("--block {} is for --for svg; {} exports the complete subject", request.block, target.name));
    return target.write(request);
}

const ExportTarget* find_export_target(std::string_view name) {
    for (const auto* target : export_targets)
        if (target->name == name) return target;
    return nullptr;
}

}  // namespace corpuscle
