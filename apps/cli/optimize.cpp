// corpuscle optimize: searches for better values of a netlist's variables; writes the found netlist.

#include <fmt/format.h>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "core/text/input_files.hpp"
#include "io/output/output_check.hpp"
#include "optimize/design_evaluator.hpp"
#include "optimize/found_netlist.hpp"
#include "optimize/optimization_report.hpp"
#include "sweep/parallel/shard_text.hpp"

namespace corpuscle {
namespace {

constexpr const char* optimize_examples =
    R"(FILE (TOML) names a netlist, the variables with their bounds, the conditions and chips in which the
design must work, its limits and its goal. The search begins at the present values. Every
simulation is stored in one SQLite file: the same command continues an interrupted search. The
result does not depend on threads or interruptions. doc/optimize.md explains the keys.

  afferent = "sa1-circuit"             # low-power.toml
  [[variable]]
  what = "i_biasf"                     # a .param, or a device's parameter: "summer.n3b.m"
  from = "200nA"
  to = "1uA"
  log = true
  [[at]]                               # the design must work in all combinations of the conditions
  what = "corner"
  list = ["tt", "ss", "ff", "sf", "fs"]
  [pattern]                            # spikes in each phase as of the model, +- a quarter or one
  like = "sa1"
  [goal]
  minimize = "power"                   # or another measure: area, own_power, distance, yield

Examples:
  corpuscle optimize low-power.toml                       -> low-power.cir, and low-power.sqlite
  corpuscle optimize low-power.toml --seed 2 -o 2.sqlite --netlist 2.cir     other random designs
  corpuscle respond press --afferent low-power.cir        use the result
  corpuscle optimize low-power.toml --json | jq .limits   what keeps the goal from being better
  corpuscle sweep dump low-power.sqlite > all.csv         all designs that were simulated

Exit status: 0 a design within the limits was found, 1 bad input, or no design is within the limits,
2 bad usage, 130 interrupted.)";

struct OptimizeArguments {
    std::string file, out, netlist;
    std::optional<std::uint64_t> seed;
    std::size_t lanes = 8;
    std::uint32_t threads = 0;  // 0: one per core
};

/// The path of the found netlist: in the current directory, with the name of the file, unless --netlist gives another.
std::string netlist_path(const OptimizeArguments& args) {
    if (!args.netlist.empty()) return args.netlist;
    return std::filesystem::path(args.file).filename().replace_extension(".cir").string();
}

/// Registers all files that the problem read, so that no output replaces one.
void remember_inputs(const optimize::OptimizationProblem& problem) {
    const auto& netlist = problem.sweep->netlist();
    if (!problem.sweep->nominal_circuit() || netlist.is_embedded()) return;
    for (const auto& entry : netlist.metadata())
        if (const auto space = entry.name.find(' '); space != std::string::npos)
            remember_input((std::filesystem::path(netlist.folder()) / entry.name.substr(space + 1)).string());
}

Error with_advice(const Error& error, const SweepResults& results) {
    if (error.code != ErrorCode::interrupted) return error;
    return {error.code, fmt::format("interrupted; {} simulations are saved in {}; the same command resumes the search",
                                    results.finished_count(), results.path())};
}

Result<optimize::OptimizationResult> search(optimize::OptimizationProblem& problem, SweepResults& results, const OptimizeArguments& args,
                                            const CommonArguments& common) {
    Progress progress(common.quiet);
    optimize::SearchCallbacks callbacks{args.threads, interrupted, [&](double fraction) { progress.update(fraction); }};
    return optimize_design(problem, &results, callbacks);
}

/// The comment at the head of the found netlist.
std::vector<std::string> comment_of(const optimize::OptimizationProblem& problem, const optimize::OptimizationResult& result) {
    std::vector<std::string> out = {fmt::format("From {}.", std::filesystem::path(problem.file).filename().string())};
    for (auto& line : design_lines(problem, result)) out.push_back(std::move(line));
    return out;
}

Result<void> write_netlist(const std::string& path, const optimize::OptimizationProblem& problem,
                           const optimize::OptimizationResult& result) {
    const auto folder = std::filesystem::path(path).parent_path().string();
    return write_file(path, TRY(found_netlist(problem, result.found.values, folder, comment_of(problem, result))));
}

Result<void> run_optimize(const OptimizeArguments& args, const CommonArguments& common) {
    auto problem = TRY(optimize::read_problem(args.file, {args.seed}));
    problem.sweep->set_lanes(args.lanes);
    remember_inputs(problem);
    const bool has_netlist = problem.sweep->nominal_circuit() != nullptr;
    const auto path = netlist_path(args);
    OutputCheck outputs(common.overwrite);
    if (has_netlist) TRY(outputs.check_file(path, optimize::is_found_netlist));
    problem.sweep->item_count = optimize::DesignEvaluator::item_count(problem);
    auto results = TRY(SweepResults::open(results_path(args.file, args.out, {}), *problem.sweep));
    const auto result = search(problem, results, args, common);
    if (const auto checkpointed = results.checkpoint(); !checkpointed && !common.quiet)
        print_warning(fmt::format("the results are complete only if {} is kept together with {}-wal: {}", results.path(), results.path(),
                                  checkpointed.error().message));
    if (!result) return with_advice(result.error(), results);
    const bool is_within = result->found.score.is_within;
    if (is_within && has_netlist) TRY(write_netlist(path, problem, *result));
    if (common.json)
        fmt::print("{}\n", json_text(document_of(problem, *result)));
    else if (!common.quiet)
        print_text(format_result(problem, *result) + (is_within && has_netlist ? fmt::format("Written: {}, {}\n", path, results.path())
                                                                               : fmt::format("Written: {}\n", results.path())));
    if (is_within) return {};
    return bad_input(fmt::format("no design within the limits was found; the best one fails at {}: {}. Widen the bounds, relax the limits, "
                                 "or search longer ([search] points, evaluations)",
                                 problem.cases[result->found.score.worst_case].text, result->found.score.limit),
                     {args.file});
}

}  // namespace

Verb make_optimize_verb() {
    const auto args = std::make_shared<OptimizeArguments>();
    return {.name = "optimize",
            .description = "search for sizes, currents and capacitors that reduce power or area -> a netlist",
            .examples = optimize_examples,
            .options = {{"",
                         {required({"FILE", &args->file, "", "an optimization file (TOML)"}),
                          {"--netlist", &args->netlist, "FOUND.cir",
                           "the found netlist (default: the name of FILE with .cir, in the current directory)"},
                          {"--out,-o", &args->out, "RESULTS",
                           "results file with all simulations (default: the name of FILE with .sqlite, in the current directory)"},
                          {"--seed", &args->seed, "N", "random seed of chips and first designs (replaces the seed of the file)"},
                          {"--threads,-j", &args->threads, "N", "number of threads (0: one per core); results do not depend on it",
                           std::pair(0U, 1024U)},
                          {"--lanes", &args->lanes, "1|4|8",
                           "number of chips simulated at once per thread (SIMD); results do not depend on it", one_of("1", "4", "8")}}}},
            .reports = true,
            .writes_files = true,
            .run = interruptible(args, run_optimize)};
}

}  // namespace corpuscle
