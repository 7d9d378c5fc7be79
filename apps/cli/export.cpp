// corpuscle export: converts a netlist to the format of another simulator.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "circuit/export/ngspice_deck.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/verbs.hpp"
#include "io/output/output_check.hpp"

namespace corpuscle {
namespace {

using namespace circuit;
using Json = nlohmann::ordered_json;

constexpr const char* export_examples =
    R"(The deck is flat: subcircuits are expanded and every parameter is evaluated. Transistors become
subcircuits of expressions with the same currents (relative error 1e-5) and small-signal parameters
(0.1 %), but without noise. Directives that ngspice does not have (.step, .mc, .expect ...) become
comments, with a warning.

Examples:
  corpuscle export amplifier.cir --for ngspice -o amplifier-ng.cir
  ngspice -b amplifier-ng.cir -r amplifier.raw                          the same curves as 'corpuscle run amplifier.cir'
  corpuscle export amplifier.cir --for ngspice > deck.cir && ngspice -b deck.cir       tables and measurements)";

struct ExportArguments {
    std::string netlist, target = "ngspice", out;
};

Json document_of(const NgspiceDeck& deck, const std::vector<Error>& warnings) {
    Json texts = Json::array();
    for (const auto& warning : warnings) texts.push_back(warning.text());
    return {{"simulator", "ngspice"}, {"deck", deck.text}, {"warnings", texts}};
}

Result<void> export_netlist(const ExportArguments& args, const CommonArguments& common) {
    const auto netlist = TRY(open_netlist(args.netlist));
    OutputCheck outputs(common.overwrite);
    if (!args.out.empty()) TRY(outputs.check_file(args.out, is_own_deck));
    auto circuit = TRY(netlist.elaborate());
    auto warnings = circuit.warnings;
    const auto deck = TRY(ngspice_deck(std::make_shared<const Circuit>(std::move(circuit))));
    warnings.insert(warnings.end(), deck.warnings.begin(), deck.warnings.end());
    if (!args.out.empty()) TRY(write_file(args.out, deck.text));
    for (const auto& warning : warnings) print_warning(warning.text());
    if (common.json)
        fmt::print("{}\n", json_text(document_of(deck, warnings)));
    else if (args.out.empty())
        fmt::print("{}", deck.text);
    return {};
}

}  // namespace

Verb make_export_verb() {
    const auto args = std::make_shared<ExportArguments>();
    return {.name = "export",
            .description = "convert a netlist to the format of another simulator",
            .examples = export_examples,
            .options = {{"",
                         {suggesting(netlist_names, required({"NETLIST", &args->netlist, "",
                                                              "a SPICE netlist, or a built-in one: sa1-circuit, fa1-circuit"})),
                          {"--for", &args->target, "SIMULATOR", "the target simulator: ngspice (version 39)", one_of("ngspice")}}},
                        {"Output", {{"--out,-o", &args->out, "FILE", "write to this file (default: standard output)"}}}},
            .reports = true,
            .writes_files = true,
            .run = [args](const CommonArguments& common) { return exit_status(export_netlist(*args, common)); }};
}

}  // namespace corpuscle
