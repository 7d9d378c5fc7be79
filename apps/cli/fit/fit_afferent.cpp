// corpuscle fit afferent: parameters of an afferent from recorded spikes.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/fit/fit_arguments.hpp"
#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/verbs.hpp"
#include "fit/fit_document.hpp"
#include "fit/fit_plan.hpp"
#include "fit/targets/target_problem.hpp"
#include "io/output/output_check.hpp"

namespace corpuscle {
namespace {

constexpr const char* fit_examples =
    R"(Force and the spikes that a nerve (or another model) fired under it -> the parameters with which an
afferent fires alike. --free names the parameters; all others keep their values (--set).

Examples:
  corpuscle fit afferent touch.csv --spikes nerve.csv --afferent sa1 --free k_A,K_B,f_B
  corpuscle fit afferent a.csv b.csv --spikes a_spikes.csv --spikes b_spikes.csv --free K_B,f_B --hold-out 0.3
  corpuscle fit afferent touch.csv --spikes nerve.csv --train 11 --delay 12ms --free k_A --bounds f_B=5Hz:50Hz -o fitted.toml
  corpuscle fit afferent --targets published.csv --afferent fa1 --free k_A,k_B,V_th --hold-out 0.2

Spike files are those of 'corpuscle compare'. One file belongs to each FORCE, in their order. If a file
has several trains, --train chooses those of one afferent; several are repetitions.

A table of targets is a CSV file with a row for each published number:
  stimulus,settings,measure,value,low,high,set,source
  ramp-hold,F_max=4N; t_up=100ms,peak_rate,100,60,130,train,a publication
  ramp-hold,F_max=4N,mean_rate@plateau,30,20,40,test,a publication
  sine,f=30Hz; F_mean=0.5N,least_amplitude,20mN,10mN,40mN,train,a publication
A measure is that of a phase (@plateau), a window (@0.4s..0.6s) or the whole stimulus. low to high is
a 95 % range. Measures: those of 'corpuscle respond --json', and min_interval, least_force (least F_max
or F_amp with a spike), least_amplitude (with a spike a cycle), largest_amplitude (with at most one),
plateau_ratio (largest over least amplitude).

Both trains are smoothed by a Gaussian of --tau, and the squared difference is minimised: first with a
wide Gaussian, which compares rates, then with --tau, which compares times. The search begins at the
present values and at the best of --points random points within the bounds (by default a twentieth to
twenty times the present value), and runs --starts local searches. Same data, options and --seed: the
same result, with any number of threads. After Ctrl-C the best values so far are printed.

The times of irregular spikes (afferents with a jitter above 0) have no counterpart in a simulation. For
them the recorded rate, smoothed over 8 tau, is compared with the mean rate of 32 simulations, which takes
longer, and jitter itself can only be fitted to the measure isi_cv of a table of targets.

The 95 % intervals follow from simulated repetitions, and from leaving out stretches of the data. 'not
identified' is printed where the data do not determine a parameter: it could be twice or half as large.
Parameters that trade against each other are named; fix one of them by leaving it out of --free.)";

/// Splits "k_A,K_B" into a list.
OptionReader names_reader(std::vector<std::string>& to) {
    return list_reader(to, [](const std::string& name) { return Result<std::string>(name); });
}

bool is_own_settings(std::string_view beginning) { return beginning.starts_with("# Written by 'corpuscle fit "); }

Result<FitResult> search(const FitArguments& args, const FitProblem& problem, const AfferentPlan& plan,
                         std::span<const FreeParameter> parameters, bool quiet) {
    ThreadPool pool(args.threads);
    Progress progress(quiet);
    SearchOptions options{.points = args.points, .starts = args.starts, .evaluations = args.evaluations, .seed = args.seed};
    options.should_continue = [&](double fraction) { return progress.update(fraction), !interrupted(); };
    return fit(problem, plan, parameters, pool, options);
}

Result<std::unique_ptr<FitProblem>> read_problem(const FitArguments& args, const AfferentPlan& plan,
                                                 std::vector<ParameterOverride>& unused) {
    if (args.targets.empty()) return read_spike_problem(args, plan, unused);
    const double rate = args.recording.rate.value_or(std::max(FitArguments::default_rate, plan.min_rate));
    return make_target_problem(TRY(read_targets(args.targets)), {.rate = rate, .seed = args.seed, .hold_out = args.hold_out});
}

Result<void> check_arguments(const FitArguments& args, const CommonArguments& common) {
    if (args.free.empty() && args.bounds.empty())
        return bad_usage(
            "fit afferent: --free is required: the parameters to fit, such as --free k_A,f_B; 'corpuscle list' prints them all");
    if (!args.targets.empty()) {
        if (args.forces.empty() && args.spike_files.empty()) return {};
        return bad_usage("fit afferent: give either a FORCE with --spikes, or --targets");
    }
    if (args.spike_files.empty() || args.forces.empty())
        return bad_usage(
            "fit afferent: no data; give a force and its spikes, such as touch.csv --spikes nerve.csv, or a table: --targets nerve.csv");
    return check_recording_arguments(common, args.forces);
}

Result<void> fit_afferent(const FitArguments& args, const CommonArguments& common) {
    TRY(check_arguments(args, common));
    auto unused = args.settings;
    const auto planned = TRY(plan_to_fit(args.afferent, args.settings));
    keep_unused(unused, planned.unused);
    const auto& plan = planned.result;
    const auto parameters = TRY(free_parameters(plan, args.free, args.bounds));
    const auto problem = TRY(read_problem(args, plan, unused));
    TRY(check_all_used(unused, std::array{std::string_view(plan.name)}));
    if (!args.out.empty()) {
        OutputCheck check(common.overwrite);
        TRY(check.check_file(args.out, is_own_settings));
    }
    const auto result = TRY(search(args, *problem, plan, parameters, common.quiet));
    for (const auto& warning : result.warnings) print_warning(warning);
    if (!args.out.empty()) TRY(write_file(args.out, settings_file(result, common.complete_command)));
    if (common.json)
        fmt::print("{}\n", json_text(document_of(result, problem->score_meaning())));
    else if (!common.quiet)
        print_text(fit_tables(result, *problem));
    if (result.is_interrupted) return Error{ErrorCode::interrupted, "interrupted: these are the best values so far"};
    return {};
}

OptionGroup data_options(FitArguments& args) {
    return {
        "",
        {suggesting(force_names, repeatable({"FORCE", list_reader(args.forces, read_force), "FORCE", "recordings and stimuli"})),
         {"--targets", &args.targets, "FILE", "instead: a table of published numbers (see below, and doc/fit.md)"},
         {"--spikes", &args.spike_files, "FILE", "spikes recorded under a FORCE; one for each, in their order"},
         split_at_commas({"--train", names_reader(args.trains), "NAME", "the trains of the afferent, if a file has several (repeatable)"}),
         {"--delay", quantity_reader(args.delay, "s"), "TIME", "conduction delay, which is subtracted from the recorded times"},
         suggesting(afferent_names, {"--afferent,-a", &args.afferent, "NAME", "the afferent to fit"}),
         suggesting(setting_names,
                    repeatable({"--set,-s", override_reader(args.settings, "--set"), "NAME.PARAMETER=VALUE",
                                "set a parameter of the afferent, which is kept or is the start of the search, or of a stimulus"})),
         split_at_commas(
             {"--free,-f", names_reader(args.free), "NAME", "the parameters to fit (repeat the option, or separate by commas)"}),
         split_at_commas({"--bounds,-b", names_reader(args.bounds), "NAME=LOW:HIGH", "fit this parameter within bounds: f_B=5Hz:50Hz"})}};
}

OptionGroup search_options(FitArguments& args) {
    return {
        "",
        {with_default("10ms", {"--tau", above_zero_reader(args.tau, "s"), "TIME", "width of the Gaussian that smooths the spikes"}),
         {"--hold-out", quantity_reader(args.hold_out, ""), "FRACTION",
          "do not fit this fraction of the data, but score it: of three or more recordings the last ones, otherwise the end of each"},
         {"--starts", &args.starts, "N", "number of local searches", std::pair(1U, 10'000U)},
         {"--points", &args.points, "N", "number of random points, of which the best are starts", std::pair(0U, 1'000'000U)},
         {"--evaluations", &args.evaluations, "N", "most simulations of a local search in each of its stages", std::pair(1U, 1'000'000U)},
         {"--seed", &args.seed, "N", "seed of the random points"},
         {"--threads,-j", &args.threads, "N", "number of threads (0: one per core); results do not depend on it", std::pair(0U, 1024U)},
         {"--rate", quantity_reader(args.recording.rate, "Hz"), "FREQUENCY",
          "sampling rate of a stimulus (default 10 kHz). For a recording: assume even sampling at this rate"},
         {"--out,-o", &args.out, "FILE", "write the fitted values into this file: a sweep file with [set]"}}};
}

}  // namespace

Verb make_fit_afferent_verb() {
    const auto args = std::make_shared<FitArguments>();
    return {.name = "afferent",
            .description = "fit parameters of an afferent: force and recorded spikes -> values, intervals, held-out score",
            .examples = fit_examples,
            .options = {data_options(*args), search_options(*args), recording_option_group(args->recording)},
            .reports = true,
            .writes_files = true,
            .check = [args](const CommonArguments&) -> Result<void> {
                if (args->hold_out >= 0 && args->hold_out <= 0.9) return {};
                return bad_usage(fmt::format("--hold-out {}: must be from 0 to 0.9", args->hold_out));
            },
            .run = interruptible(args, fit_afferent)};
}

Verb make_fit_verb() {
    return {.name = "fit",
            .description = "find parameters from data: fit afferent, fit transistor",
            .examples =
                "Examples:\n  corpuscle fit afferent touch.csv --spikes nerve.csv --free k_A,K_B,f_B\n"
                "  corpuscle fit transistor curves.csv --width 1.5um --length 0.5um --card nch.lib",
            .check = [](const CommonArguments&) -> Result<void> {
                return bad_usage("corpuscle fit: name what to fit: corpuscle fit afferent, corpuscle fit transistor");
            },
            .run = [](const CommonArguments&) { return 0; },
            .sub_verbs = {make_fit_afferent_verb(), make_fit_transistor_verb()}};
}

}  // namespace corpuscle
