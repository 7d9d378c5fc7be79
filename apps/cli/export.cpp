// corpuscle export: converts a netlist to the format of another simulator.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "circuit/export/ngspice_deck.hpp"
#include "circuit/variant/embedded_netlists.hpp"
#include "cli/arguments/own_files.hpp"
#include "cli/output/output_files.hpp"
#include "cli/output/printable.hpp"
#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "io/output/output_check.hpp"

namespace corpuscle {
namespace {

using namespace circuit;
using Json = nlohmann::ordered_json;

Json document_of(const NgspiceDeck& deck, const std::vector<Error>& warnings) {
    Json texts = Json::array();
    for (const auto& warning : warnings) texts.push_back(warning.text());
    return {{"simulator", "ngspice"}, {"deck", deck.text}, {"warnings", texts}};
}

Result<void> export_netlist(const ExportArguments& args, const CommonArguments& common) {
    const auto netlist = open_netlist(args.netlist);
    if (!netlist) return netlist.error();
    OutputCheck outputs(common.overwrite);
    if (!args.out.empty())
        if (auto ok = outputs.check_file(args.out, is_own_deck); !ok) return ok;
    auto circuit = netlist->elaborate();
    if (!circuit) return circuit.error();
    auto warnings = circuit->warnings;
    const auto deck = ngspice_deck(std::make_shared<const Circuit>(std::move(*circuit)));
    if (!deck) return deck.error();
    warnings.insert(warnings.end(), deck->warnings.begin(), deck->warnings.end());
    if (!args.out.empty())
        if (auto ok = write_file(args.out, deck->text); !ok) return ok;
    for (const auto& warning : warnings) print_warning(warning.text());
    if (common.json)
        fmt::print("{}\n", json_text(document_of(*deck, warnings)));
    else if (args.out.empty())
        fmt::print("{}", deck->text);
    return {};
}

}  // namespace

int export_to(const ExportArguments& args, const CommonArguments& common) {
    const auto done = export_netlist(args, common);
    return done ? 0 : report_error(done.error());
}

}  // namespace corpuscle
