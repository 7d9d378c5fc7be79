// corpuscle run: runs the analyses of a netlist and prints or writes the results.

#include <fmt/format.h>
#include <algorithm>

#include "circuit/analyses.hpp"
#include "circuit/cost/cost.hpp"
#include "circuit/devices.hpp"
#include "circuit/output/saved_quantities.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "cli/arguments/shared_arguments.hpp"
#include "cli/output/terminal.hpp"
#include "cli/run/curve_files.hpp"
#include "cli/run/variant_printer.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/verbs.hpp"

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

/// The progress of a variant. If there are transients, other analyses are not counted, because transients take most of the time.
class VariantProgress {
    std::size_t analyses_ = 0, transients_ = 0;  // in the netlist
    std::size_t done_ = 0;                       // number of counted analyses that have ended
    double last_ = 0;                            // last fraction of the current analysis; a smaller one means that the next has begun

public:
    explicit VariantProgress(const Circuit& circuit) {
        for (const auto& c : circuit.directives) analyses_ += find_analysis(c.name) != nullptr, transients_ += c.name == "tran";
    }
    /// The finished fraction of the variant when `fraction` of `analysis` ("tran"), the current one, is finished; both 0 to 1.
    double of(std::string_view analysis, double fraction) {
        if (transients_ > 0 && analysis != "tran") return static_cast<double>(done_) / static_cast<double>(transients_);
        if (fraction < last_) ++done_;
        last_ = fraction;
        return (static_cast<double>(done_) + fraction) /
               static_cast<double>(transients_ > 0 ? transients_ : std::max<std::size_t>(analyses_, 1));
    }
};

/// Creates the analysis context of a variant, or reuses `context` if the circuit is the same, as for the chips of .mc. `brief`: analyses
/// make no tables and no warnings.
Result<void> prepare(std::unique_ptr<AnalysisContext>& context, const Variant& variant, bool brief) {
    if (!context || context->circuit != variant.circuit) context = TRY(AnalysisContext::make(variant.circuit));
    context->is_brief = brief;
    if (variant.sample) context->apply_variation(*variant.sample);
    return {};
}

/// Runs one variant, and reports its progress, 0 to 1. `cost_meter` is used with --budget.
Result<VariantResult> run_variant(AnalysisContext& context, Variant variant, const RunArguments& args, const CommonArguments& common,
                                  CurveFiles& files, CostMeter& cost_meter, const std::function<void(double)>& report_progress) {
    VariantProgress progress(*variant.circuit);
    CollectedPlots collected;
    RunOptions options{.keep_points = false, .print_tables = !common.json && !common.quiet};
    if (common.json) options.curve_sink = &collected;
    if (!args.out.empty()) options.curve_sink = &files;
    options.should_stop = [&](std::string_view analysis, double fraction) {
        return report_progress(progress.of(analysis, fraction)), interrupted();
    };
    if (args.budget) TRY(cost_meter.attach(options));
    auto outcome = TRY(circuit::run_directives(context, options));
    auto plots = args.out.empty() ? std::move(collected.plots) : outcome.plots();
    return VariantResult{std::move(variant), std::move(outcome), std::move(plots)};
}

/// Runs all variants. A variant that does not converge is passed to the printer, unless it is the only one; any other error ends the run.
Result<void> run_all(NetlistVariants& variants, const RunArguments& args, const CommonArguments& common, VariantPrinter& printer,
                     CurveFiles& files) {
    const auto count = variants.count();
    Progress progress(common.quiet);
    std::unique_ptr<AnalysisContext> context;
    for (std::size_t k = 0; k < count; ++k) {
        const auto report = [&](double fraction) { progress.update((static_cast<double>(k) + fraction) / static_cast<double>(count)); };
        const auto variant = TRY(variants.at(k));
        TRY(prepare(context, variant, /* brief = */ k > 0 || variants.has_chips()));
        if (!args.out.empty()) TRY(files.begin_variant(variant));
        CostMeter cost_meter(*context);
        auto result = run_variant(*context, variant, args, common, files, cost_meter, report);
        if (interrupted()) return Error{ErrorCode::interrupted, "interrupted"};
        report(1);
        if (result) {
            if (args.budget) result->cost = TRY(cost_meter.cost());
            printer.add(*result);
        } else if (result.error().code == ErrorCode::not_converged && count > 1) {
            printer.fail(variant.label, result.error());
        } else {
            auto error = result.error();
            if (!variant.label.empty()) error.message = fmt::format("{}: {}", variant.label, error.message);
            return error;
        }
    }
    return {};
}

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
    auto overrides = args.netlists.overrides;
    for (const auto& text : args.settings) overrides.push_back(TRY(parse_netlist_override(args.netlist, text, "--set")));
    const auto applied = TRY(apply_overrides(args.netlist, overrides));  // all overrides are for this netlist, so none is unused
    const auto& netlist = applied.result;
    if (args.netlists.probes.empty()) return netlist;
    const auto circuit = TRY(netlist.elaborate());
    auto changes = netlist.overrides();
    for (const auto& probe : args.netlists.probes) {
        const auto found = TRY(resolve_probe(circuit, probe));
        if (!found)
            return bad_input(
                fmt::format("--probe {}: {} has no such node or device{}", probe, args.netlist, suggest_probe(circuit, probe)));
        changes.saved.push_back(*found);
    }
    return netlist.with_overrides(std::move(changes));
}

Result<void> run_netlist(const RunArguments& args, const CommonArguments& common) {
    const auto netlist = TRY(netlist_of(args));
    auto variants = TRY(NetlistVariants::create(netlist));
    const bool has_steps = variants.count() > 1;
    VariantPrinter printer(common, has_steps, variants.has_chips());
    CurveFiles files(args.out, args.ascii, has_steps, common.overwrite);
    const auto done = run_all(variants, args, common, printer, files);
    printer.finish();
    if (!done) return keep_partial_files(files), done;
    TRY(files.finish());
    if (!printer.failures.empty()) {
        auto error = printer.failures[0];
        error.message = fmt::format("{} of {} did not converge; the first: {}", printer.failures.size(), variants.count(), error.message);
        return error;
    }
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
                           "set a .param, an array (summer.N3B=8x4), a device value (cco.cu=4pF) or a device parameter (N3B.w=1.2um)"},
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
