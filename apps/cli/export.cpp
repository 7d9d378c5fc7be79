// corpuscle export: converts a netlist or an afferent to the format of another simulator.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "circuit/export/kit_map.hpp"
#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/verbs.hpp"
#include "core/text/ascii_text.hpp"
#include "io/output/output_check.hpp"
#include "run/export/targets.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* export_examples =
    R"(A netlist becomes a flat deck: subcircuits are expanded and every parameter is evaluated.
Transistors become subcircuits of expressions with the same currents (relative error 1e-5) and
small-signal parameters (0.1 %), but without noise. Directives that ngspice does not have (.step,
.mc, .expect ...) become comments, with a warning.

With --card the transistors are those of a foundry's kit, which is read from its own file: columns
are multipliers, units in series a chain. See doc/kits.md.

With --for svg a netlist becomes a schematic: its top level, or the block or subcircuit that --block
names. See doc/schematics.md.

An afferent becomes a script, a module or a NIR graph with its equations and all values; see
doc/export.md.

Examples:
  corpuscle export amplifier.cir --for ngspice -o amplifier-ng.cir
  ngspice -b amplifier-ng.cir -r amplifier.raw                          the same curves as 'corpuscle run amplifier.cir'
  corpuscle export amplifier.cir --for ngspice > deck.cir && ngspice -b deck.cir       tables and measurements
  corpuscle export invc.cir --for ngspice --card bsim3.lib --map bsim --nch nmos1 --pch pmos1 -o invc-kit.cir
  corpuscle export sa1-circuit --for ngspice --map sky130 --card sky130.lib.spice --set sa1-circuit.corner=ss -o sa1-ss.cir
  corpuscle export sa1 --for brian2 --set sa1.f_B=25Hz -o sa1.py && python3 sa1.py force.csv spikes.csv
  corpuscle export sa1-circuit --for svg --block summer -o summer.svg
  corpuscle export sa1 --for nir -o sa1.nir                             for neuromorphic simulators and chips)";

struct ExportArguments {
    ExportRequest request;
    std::string target = "ngspice", out;
};

Json document_of(const ExportTarget& target, const ExportedModel& model) {
    Json texts = Json::array();
    for (const auto& warning : model.warnings) texts.push_back(warning.text());
    Json document = {{"simulator", target.name}};
    if (target.is_text) document[std::string(target.kind)] = model.text;
    document["warnings"] = texts;
    return document;
}

Result<void> export_model(const ExportArguments& args, const CommonArguments& common) {
    const auto& target = *find_export_target(args.target);
    if (!target.is_text && args.out.empty())
        return bad_usage(fmt::format("--for {0}: the file is not text; name it: --out x.{0}", target.name));
    auto request = args.request;
    request.out = args.out;
    const auto model = TRY(write_model(target, request));
    OutputCheck outputs(common.overwrite);  // it refuses inputs, so they must have been read
    if (!args.out.empty()) TRY(outputs.check_file(args.out, target.is_own));
    if (!args.out.empty()) TRY(write_file(args.out, model.text));
    for (const auto& warning : model.warnings) print_warning(warning.text());
    if (common.json)
        fmt::print("{}\n", json_text(document_of(target, model)));
    else if (args.out.empty())
        fmt::print("{}", model.text);
    return {};
}

/// The names of all targets, and the description of --for.
std::vector<std::string> target_names() {
    std::vector<std::string> names;
    for (const auto* target : export_targets) names.emplace_back(target->name);
    return names;
}
const std::string& target_description() {
    static const std::string text = [] {
        std::string all = "the target:";
        for (const auto* target : export_targets)
            all += fmt::format("{} {} ({})", target == export_targets[0] ? "" : ";", target->name, target->description);
        return all;
    }();
    return text;
}

const std::string& map_description() {
    static const std::string text =
        fmt::format("how the kit spells its transistors: {} (default plain), or a file (doc/kits.md)", joined(circuit::kit_map_names()));
    return text;
}

}  // namespace

Verb make_export_verb() {
    const auto args = std::make_shared<ExportArguments>();
    return {.name = "export",
            .description = "convert a netlist or an afferent to the format of another simulator",
            .examples = export_examples,
            .options = {{"",
                         {suggesting(
                              afferent_names,
                              required(
                                  {"SUBJECT", &args->request.subject, "",
                                   "a SPICE netlist or a built-in one (sa1-circuit, fa1-circuit), or an afferent (sa1, sa1b+izhikevich)"})),
                          {"--for", &args->target, "SIMULATOR", target_description(), target_names()},
                          repeatable({"--set,-s", override_reader(args->request.settings, "--set"), "NAME.PARAMETER=VALUE",
                                      "set a parameter of the subject, such as sa1.f_B=25Hz"}),
                          {"--block", &args->request.block, "NAME", "draw this block or subcircuit of a netlist (with --for svg)"}}},
                        {"Kit (with --for ngspice)",
                         {{"--card", &args->request.kit.card, "FILE", "the kit's file: transistors are its devices instead of UICM"},
                          {"--map", &args->request.kit.map, "NAME|FILE", map_description()},
                          {"--nch", &args->request.kit.nch, "NAME", "the kit's device for N"},
                          {"--pch", &args->request.kit.pch, "NAME", "the kit's device for P"},
                          {"--hv-nch", &args->request.kit.hv_nch, "NAME",
                           "its N device of higher threshold; without it the threshold of the other is shifted"},
                          {"--hv-pch", &args->request.kit.hv_pch, "NAME", "its P device of higher threshold"}}},
                        {"Output", {{"--out,-o", &args->out, "FILE", "write to this file (default: standard output)"}}}},
            .reports = true,
            .writes_files = true,
            .run = [args](const CommonArguments& common) { return exit_status(export_model(*args, common)); }};
}

}  // namespace corpuscle
