// corpuscle run: runs the analyses of a netlist and prints or writes the results.

#include <fmt/format.h>

#include "circuit/analyses.hpp"
#include "circuit/cost/cost.hpp"
#include "circuit/devices.hpp"
#include "cli/arguments/shared_arguments.hpp"
#include "cli/output/terminal.hpp"
#include "cli/run/curve_files.hpp"
#include "cli/run/variant_printer.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/verbs.hpp"
#include "run/netlist/variant_run.hpp"

namespace corpuscle {
namespace {

using namespace circuit;

constexpr const char* run_examples = R"(

Further directives:
  .print dc v(out)                  print a table of curves
  .meas dc NAME find v(out) at=0.3  measure one number
  .expect NAME VALUE 1%             fail if a measured number differs: the netlist tests itself
  .spike v(s) 0.35                  the threshold that defines a spike in a .tran
  .assert v(a) 0 0.6                the range in which the circuit works as designed
  .force press                      the stimulus of the FORCE sources
  .options accuracy=fine|finest     more than the default accuracy

The file of a .tran is written during the run. After Ctrl-C it is readable.

Examples:
  corpuscle run circuits/divider.cir
  corpuscle run circuits/spiker.cir -o spiker.raw
  corpuscle run sa1-circuit --corner ff --temp 85 --set summer.N3B=8x4 --probe 'vf,u,i(N3B)' -o sa1.csv
  corpuscle run sa1-circuit --set noisefmax=1kHz           with the noise of its devices, up to 1 kHz
  corpuscle run amplifier.cir -o amplifier.raw
  corpuscle run amplifier.cir -o amplifier.csv --json)";

struct RunArguments {
    NetlistArguments netlists;
    std::vector<std::string> settings;
    std::string netlist, out;
    bool ascii = false, budget = false;
};

/// Collects the saved curves in memory for the JSON document. It is not used with --out.
class CollectedPlots final : public PointSink {
    PlotRecorder recorder_;

public:
    std::vector<Plot> plots;
    Result<void> begin(const Plot& head) override { return recorder_.begin(head); }
    Result<void> add_point(const PlotRow& row) override { return recorder_.add_point(row); }
    Result<void> end() override { return plots.push_back(std::move(recorder_.plot)), Result<void>(); }
};

/// Prints the variants, and writes their curves to the files.
class VariantOutput final : public VariantHandler {
    const RunArguments& args_;
    const CommonArguments& common_;
    VariantPrinter& printer_;
    CurveFiles& files_;
    std::optional<CostMeter> cost_meter_;  // with --budget
    CollectedPlots collected_;

public:
    VariantOutput(const RunArguments& args, const CommonArguments& common, VariantPrinter& printer, CurveFiles& files)
        : args_(args), common_(common), printer_(printer), files_(files) {}

    Result<RunOptions> begin(const Variant& variant, AnalysisContext& context) override {
        RunOptions options{.keep_points = false, .print_tables = !common_.json && !common_.quiet};
        collected_.plots.clear();
        if (common_.json) options.curve_sink = &collected_;
        if (!args_.out.empty()) {
            TRY(files_.begin_variant(variant));
            options.curve_sink = &files_;
        }
        if (args_.budget) TRY(cost_meter_.emplace(context).attach(options));
        return options;
    }
    Result<void> end(const Variant& variant, RunOutcome&& outcome) override {
        auto plots = args_.out.empty() ? std::move(collected_.plots) : outcome.plots();
        VariantResult result{variant, std::move(outcome), std::move(plots)};
        if (cost_meter_) result.cost = TRY(cost_meter_->cost());
        printer_.add(result);
        return {};
    }
    void fail(const Variant& variant, const Error& error) override { printer_.fail(variant.label, error); }
};

/// Keeps the files of an incomplete run, with a warning that says where they end.
void keep_partial_files(CurveFiles& files) {
    const auto note = files.finish_early(interrupted());
    if (!note)
        report_error(note.error());
    else if (!note->empty())
        print_warning(*note);
}

/// The netlist with its overrides and with the probes of --probe in addition to its own.
Result<Netlist> netlist_of(const RunArguments& args) {
    NetlistChanges changes{args.netlists.overrides, args.netlists.probes};
    for (const auto& text : args.settings) changes.overrides.push_back(TRY(parse_netlist_override(args.netlist, text, "--set")));
    const auto open = [&](const std::string& corner) { return open_netlist(args.netlist, corner); };
    return change_netlist(open, args.netlist, changes, "--probe ");
}

Result<void> run_netlist(const RunArguments& args, const CommonArguments& common) {
    const auto netlist = TRY(netlist_of(args));
    auto variants = TRY(NetlistVariants::create(netlist));
    const bool has_steps = variants.count() > 1;
    VariantPrinter printer(common, has_steps, variants.has_chips());
    CurveFiles files(args.out, args.ascii, has_steps, common.overwrite);
    const auto done = [&] {
        Progress progress(common.quiet);
        VariantOutput output(args, common, printer, files);
        return run_variants(variants, {}, output, [&](double fraction) { return progress.update(fraction), !interrupted(); });
    }();
    printer.finish();
    if (!done) return keep_partial_files(files), done;
    TRY(files.finish());
    if (!printer.failures.empty()) return error_of_failures(printer.failures, variants.count());
    if (printer.failed_expectation) return *printer.failed_expectation;
    return {};
}

/// The examples of --help, after the analyses that a netlist may contain.
std::string run_help() {
    std::string known;
    for (const auto* a : circuit::analyses) known += fmt::format("\n  {}\n      {}", a->usage, a->description);
    return "A netlist is SPICE: a title, elements (" + circuit::element_letters() +
           "), .model, .subckt, .param, .include,\n"
           ".lib, .options ... and the analyses to run:" +
           known + run_examples;
}

}  // namespace

Verb make_run_verb() {
    const auto args = std::make_shared<RunArguments>();
    return {.name = "run",
            .description = "run the analyses of a netlist -> .raw, CSV, printed measurements",
            .examples = run_help(),
            .options = {{"",
                         {suggesting(netlist_names, required({"NETLIST", &args->netlist, "",
                                                              "a SPICE netlist, or a built-in one: sa1-circuit, fa1-circuit"})),
                          {"--set,-s", &args->settings, "NAME=VALUE",
                           "set a .param, an array (summer.N3B=8x4), a device value (cco.cu=4pF), a device parameter (N3B.w=1.2um) or a "
                           "number of .options (noisefmax=1kHz)"},
                          {"--budget", &args->budget, "", "also print power, area and leakage of each block"}}},
                        netlist_options(args->netlists),
                        {"Output",
                         {{"--out,-o", &args->out, "FILE", "write the curves: x.raw (the format of ngspice, binary) or x.csv"},
                          {"--ascii", &args->ascii, "", "write the .raw file as text"}}}},
            .reports = true,
            .writes_files = true,
            .run = interruptible(args, run_netlist)};
}

}  // namespace corpuscle
