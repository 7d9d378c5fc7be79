// corpuscle run: runs the analyses of a netlist and prints or writes the results.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "circuit/analyses.hpp"
#include "circuit/cost/circuit_cost_document.hpp"
#include "circuit/cost/cost_meter.hpp"
#include "circuit/output/resolve_probe.hpp"
#include "circuit/run_directives.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "circuit/variant/netlist_variants.hpp"
#include "cli/arguments/netlist_arguments.hpp"
#include "cli/output/budget_tables.hpp"
#include "cli/output/curve_files.hpp"
#include "cli/output/printable.hpp"
#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "run/summary/json_number.hpp"

namespace corpuscle {
namespace {

using namespace circuit;
using Json = nlohmann::ordered_json;

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

/// The values of a curve; a complex value is a pair of real and imaginary part.
Json column(const Plot& plot, const Curve& curve) {
    Json out = Json::array();
    for (const auto& x : curve.values)
        out.push_back(plot.is_complex && curve.type != "frequency" ? Json({json_number(x.real()), json_number(x.imag())})
                                                                   : json_number(x.real()));
    return out;
}

/// Collects the saved curves in memory for the JSON document. It is not used with --out.
class CollectedPlots final : public CurveSink {
    PlotRecorder recorder_;

public:
    std::vector<Plot> plots;
    Result<void> add_plots(std::span<const Plot> more) override {
        return plots.insert(plots.end(), more.begin(), more.end()), Result<void>();
    }
    Result<void> begin(const Plot& head) override { return recorder_.begin(head); }
    Result<void> add_point(std::span<const double> row) override { return recorder_.add_point(row); }
    Result<void> end() override { return plots.push_back(std::move(recorder_.plot)), Result<void>(); }
};

/// One variant of the netlist (a step of .step or a chip of .mc) and its results.
struct VariantResult {
    Variant variant;
    RunOutcome outcome;
    std::vector<Plot> plots;        ///< for the JSON document; with --out, without the points of transients, which are only in the file
    std::optional<Cost> cost = {};  ///< with --budget
};

Json document_of(const VariantResult& result) {
    const auto& outcome = result.outcome;
    Json plots = Json::array(), analyses = Json::array(), numbers = Json::object(), expectations = Json::array(), warnings = Json::array();
    for (const auto& plot : result.plots) {
        Json curves = Json::object();
        for (const auto& curve : plot.curves) curves[curve.name] = column(plot, curve);
        plots.push_back({{"plot", plot.name}, {"complex", plot.is_complex}, {"curves", curves}});
    }
    for (const auto& a : outcome.analyses) {
        Json one = {{"analysis", a.directive->name}, {"points", a.point_count}};
        for (const auto& [quantity, count] : a.result.stats) one[quantity] = static_cast<std::int64_t>(count);
        analyses.push_back(one);
    }
    for (const auto& [name, value] : outcome.numbers) numbers[name] = json_number(value);
    for (const auto& e : outcome.expectations)
        expectations.push_back(
            {{"name", e.name}, {"actual", json_number(e.actual)}, {"expected", e.expected}, {"tolerance", e.tolerance}, {"met", e.is_met}});
    for (const auto& r : outcome.warnings) warnings.push_back(r.text());
    Json out = {{"title", result.variant.circuit->title}, {"plots", plots},      {"analyses", analyses}, {"numbers", numbers},
                {"expectations", expectations},           {"warnings", warnings}};
    for (const auto& a : outcome.analyses)
        if (a.result.spikes) out["spikes"].push_back(*a.result.spikes);  // one list per .tran
    if (result.cost) out["budget"] = circuit::document_of(*result.cost);
    return out;
}

/// Prints the measurements and the expectations, in SI units.
void print_numbers(const RunOutcome& outcome) {
    for (const auto& [name, value] : outcome.numbers)
        std::isnan(value) ? fmt::print("{:20} = failed\n", printable(name)) : fmt::print("{:20} = {:.6e}\n", printable(name), value);
    for (const auto& e : outcome.expectations)
        fmt::print("{:20} = {:.6e}, expected {:g} within {:g}: {}\n", printable(e.name), e.actual, e.expected, e.tolerance,
                   e.is_met ? "holds" : "does not hold");
}

/// Prints all results of the only variant.
void print(const VariantResult& result) {
    for (const auto& a : result.outcome.analyses) {
        fmt::print("{}.{}: {} point{}\n", &a == &result.outcome.analyses[0] ? "" : "\n", a.directive->name, a.point_count,
                   a.point_count == 1 ? "" : "s");
        print_text(a.result.table + a.printed_tables);
    }
    if (!result.outcome.numbers.empty() || !result.outcome.expectations.empty()) fmt::print("\n");
    print_numbers(result.outcome);
    if (result.cost) print_text("\n" + budget_tables(*result.cost));
}

/// Prints the numbers of one of several variants in one line, and its .print tables.
void print_line(const VariantResult& result) {
    fmt::print("{}:", printable(result.variant.label));
    for (const auto& [name, value] : result.outcome.numbers) fmt::print("  {} = {:.6e}", printable(name), value);
    fmt::print("{}\n", result.cost ? budget_line(*result.cost) : "");
    for (const auto& a : result.outcome.analyses) print_text(a.printed_tables);
}

/// Statistics of one measurement over the chips of a .mc.
struct MeasurementStats {
    std::string name;
    std::size_t count = 0;
    double mean = 0, squares = 0, min = 0, max = 0;  // squares: sum of squared deviations from the mean (Welford)
    void add(double x) {
        min = count == 0 ? x : std::min(min, x), max = count == 0 ? x : std::max(max, x);
        const double distance = x - mean;
        mean += distance / static_cast<double>(++count);
        squares += distance * (x - mean);
    }
    double deviation() const { return count < 2 ? 0 : std::sqrt(squares / static_cast<double>(count - 1)); }
};

/// Prints each variant when it is finished, and for .mc statistics at the end. With several variants, the JSON document is an array.
class VariantPrinter {
    const CommonArguments& common_;
    bool has_steps_, is_monte_carlo_;      // the netlist has several variants; it has .mc
    std::size_t count_ = 0;                // number of printed JSON documents
    std::vector<MeasurementStats> stats_;  // only for .mc

public:
    std::vector<Error> failures;              ///< errors of the variants that did not converge
    std::optional<Error> failed_expectation;  ///< the first expectation that was not met

    VariantPrinter(const CommonArguments& common, bool has_steps, bool is_monte_carlo)
        : common_(common), has_steps_(has_steps), is_monte_carlo_(is_monte_carlo) {}

    void add(const VariantResult& result) {
        for (const auto& r : result.outcome.warnings) print_warning(r.text());
        for (const auto& e : result.outcome.expectations)
            if (!e.is_met && !failed_expectation)
                failed_expectation = bad_input(
                    fmt::format("{}{} is {:g}, not {:g} within {:g}", result.variant.label.empty() ? "" : result.variant.label + ": ",
                                e.name, e.actual, e.expected, e.tolerance),
                    e.location);
        add_stats(result.outcome.numbers);
        if (common_.json) {
            auto document = document_of(result);
            if (has_steps_) document["step"] = result.variant.label;
            print_document(document);
        } else if (!common_.quiet) {
            has_steps_ ? print_line(result) : print(result);
        }
    }
    /// Prints and counts a variant that did not converge.
    void fail(const std::string& label, const Error& error) {
        failures.push_back(error);
        if (common_.json)
            print_document({{"step", label}, {"error", error.message}});
        else if (!common_.quiet)
            print_text(fmt::format("{}:  {}\n", printable(label), printable(error.message)));
    }
    /// Ends the JSON array, or prints the statistics.
    void finish() {
        if (common_.json) return has_steps_ ? fmt::print("{}]\n", count_ == 0 ? "[" : "\n") : void();
        if (common_.quiet) return;
        for (const auto& s : stats_)
            fmt::print("{:20} mean {:.6e}  sigma {:.3e} ({:.3g} %)  range {:.6e} to {:.6e}  n = {}\n", s.name, s.mean, s.deviation(),
                       s.mean == 0 ? 0 : 100 * s.deviation() / std::abs(s.mean), s.min, s.max, s.count);
    }

private:
    void print_document(const Json& document) {
        fmt::print("{}{}{}", !has_steps_ ? "" : count_ == 0 ? "[\n" : ",\n", json_text(document), has_steps_ ? "" : "\n");
        ++count_;
    }
    void add_stats(const std::vector<std::pair<std::string, double>>& numbers) {
        if (!is_monte_carlo_) return;
        for (const auto& [name, value] : numbers) {
            auto at = std::find_if(stats_.begin(), stats_.end(), [&](const MeasurementStats& s) { return s.name == name; });
            if (at == stats_.end()) at = stats_.insert(at, {name});
            if (std::isfinite(value)) at->add(value);
        }
    }
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

std::size_t analysis_count_of(const Circuit& circuit) {
    return static_cast<std::size_t>(std::count_if(circuit.directives.begin(), circuit.directives.end(),
                                                  [](const Directive& c) { return find_analysis(c.name) != nullptr; }));
}

/// Creates the analysis context of a variant, or reuses `context` if the circuit is the same, as for the chips of .mc. `brief`: analyses
/// make no tables and no warnings.
Result<void> prepare(std::unique_ptr<AnalysisContext>& context, const Variant& variant, bool brief) {
    if (!context || context->circuit != variant.circuit) {
        auto made = AnalysisContext::make(variant.circuit);
        if (!made) return made.error();
        context = std::move(*made);
    }
    context->is_brief = brief;
    if (variant.sample) context->apply_variation(*variant.sample);
    return {};
}

/// Runs all variants. A variant that does not converge is passed to the printer, unless it is the only one; any other error ends the run.
Result<void> run_all(NetlistVariants& variants, const RunArguments& args, const CommonArguments& common, VariantPrinter& printer,
                     CurveFiles& files) {
    const auto count = variants.count();
    Progress progress(common.quiet);
    std::unique_ptr<AnalysisContext> context;
    for (std::size_t k = 0; k < count; ++k) {
        auto variant = variants.at(k);
        if (!variant) return variant.error();
        if (auto ok = prepare(context, *variant, /* brief = */ k > 0 || variants.has_chips()); !ok) return ok;
        if (k == 0)
            if (auto ok = files.check(analysis_count_of(*variant->circuit)); !ok) return ok;
        VariantProgress variant_progress(*variant->circuit);
        CollectedPlots collected;
        RunOptions options;
        options.keep_points = false, options.print_tables = !common.json && !common.quiet;
        if (common.json) options.curve_sink = &collected;
        if (!args.out.empty()) options.curve_sink = &files, files.begin_variant(*variant);
        options.should_stop = [&](std::string_view analysis, double fraction) {
            progress.update((static_cast<double>(k) + variant_progress.of(analysis, fraction)) / static_cast<double>(count));
            return interrupted();
        };
        CostMeter cost_meter(*context);
        const auto attached = args.budget ? cost_meter.attach(options) : Result<void>();
        auto outcome = attached ? circuit::run_directives(*context, options) : attached.error();
        if (interrupted()) return Error{ErrorCode::interrupted, "interrupted"};
        progress.update(static_cast<double>(k + 1) / static_cast<double>(count));
        if (!outcome && outcome.error().code == ErrorCode::not_converged && count > 1) {
            printer.fail(variant->label, outcome.error());
            continue;
        }
        if (!outcome) {
            auto error = outcome.error();
            if (!variant->label.empty()) error.message = fmt::format("{}: {}", variant->label, error.message);
            return error;
        }
        auto plots = args.out.empty() ? std::move(collected.plots) : outcome->plots();
        VariantResult result{std::move(*variant), std::move(*outcome), std::move(plots)};
        if (args.budget) {
            auto cost = cost_meter.cost();
            if (!cost) return cost.error();
            result.cost = std::move(*cost);
        }
        printer.add(result);
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
    for (const auto& text : args.settings) {
        auto parsed = parse_netlist_override(args.netlist, text, "--set");
        if (!parsed) return parsed.error();
        overrides.push_back(std::move(*parsed));
    }
    const auto applied = apply_overrides(args.netlist, overrides);  // all overrides are for this netlist, so none is unused
    if (!applied) return applied.error();
    const auto& netlist = applied->result;
    if (args.netlists.probes.empty()) return netlist;
    const auto circuit = netlist.elaborate();
    if (!circuit) return circuit.error();
    auto changes = netlist.overrides();
    for (const auto& probe : args.netlists.probes) {
        const auto found = resolve_probe(*circuit, probe);
        if (!found) return found.error();
        if (!*found)
            return bad_input(
                fmt::format("--probe {}: {} has no such node or device{}", probe, args.netlist, suggest_probe(*circuit, probe)));
        changes.saved.push_back(**found);
    }
    return netlist.with_overrides(std::move(changes));
}

Result<void> run_netlist(const RunArguments& args, const CommonArguments& common) {
    const auto netlist = netlist_of(args);
    if (!netlist) return netlist.error();
    auto variants = NetlistVariants::create(*netlist);
    if (!variants) return variants.error();
    const bool has_steps = variants->count() > 1;
    VariantPrinter printer(common, has_steps, variants->has_chips());
    CurveFiles files({args.out, args.ascii}, has_steps, common.overwrite);
    const auto done = run_all(*variants, args, common, printer, files);
    printer.finish();
    if (!done) return keep_partial_files(files), done;
    if (auto ok = files.finish(); !ok) return ok;
    if (!printer.failures.empty()) {
        auto error = printer.failures[0];
        error.message = fmt::format("{} of {} did not converge; the first: {}", printer.failures.size(), variants->count(), error.message);
        return error;
    }
    if (printer.failed_expectation) return *printer.failed_expectation;
    return {};
}

/// The examples of --help, after the analyses that a netlist may contain.
std::string run_help() {
    std::string known;
    for (const auto& a : circuit::analyses) known += fmt::format("\n  {}\n      {}", a.usage, a.description);
    return "A netlist is SPICE: a title, elements (R C L V I E F G H B D M X), .model, .subckt, .param, .include,\n"
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
                         {required({"NETLIST", &args->netlist, "", "a SPICE netlist, or a built-in one: sa1-circuit, fa1-circuit"}),
                          {"--set,-s", &args->settings, "NAME=VALUE",
                           "set a .param, an array (summer.N3B=8x4), a device value (cco.cu=4pF) or a device parameter (N3B.w=1.2um)"},
                          {"--budget", &args->budget, "", "also print power, area and leakage of each block"}}},
                        netlist_options(args->netlists),
                        {"Output",
                         {{"--out,-o", &args->out, "FILE", "write the curves: x.raw (the format of ngspice, binary) or x.csv"},
                          {"--ascii", &args->ascii, "", "write the .raw file as text"}}}},
            .reports = true,
            .writes_files = true,
            .run = [args](const CommonArguments& common) {
                catch_interrupt();
                return exit_status(run_netlist(*args, common));
            }};
}

}  // namespace corpuscle
