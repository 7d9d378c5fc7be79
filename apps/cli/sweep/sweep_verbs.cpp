#include "cli/sweep/sweep_verbs.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/arguments/option_groups.hpp"
#include "cli/program.hpp"

namespace corpuscle {
namespace {

constexpr const char* sweep_examples =
    R"(FILE is a sweep file (TOML) with the varied parameters, the number of samples, the measures and the
pass limits; or a netlist with .mc and .step lines. Results go into one SQLite file with one row per
work item (a grid point and a random sample). Its default name is NAME.sqlite for NAME.toml. A sweep
may be interrupted or killed at any time: the same command continues with the missing items. Results
do not depend on threads, lanes, shards or MPI ranks.

  afferent = "sa1-circuit"             # chips.toml
  force = "press"
  samples = 1000
  [[vary]]
  what = "mismatch"

Examples:
  corpuscle sweep chips.toml                                        on all cores of this machine
  corpuscle sweep chips.toml --status                               progress, also while it runs
  corpuscle sweep show chips.sqlite --report chips.html             means, yields, most influential devices
  corpuscle sweep dump chips.sqlite > chips.csv                     all rows, in order
  corpuscle sweep chips.toml --seed 2 --samples 100 -o again.sqlite other random chips, fewer of them
  corpuscle sweep chips.toml --shard 1/3                            one third, on one of three machines (chips-1of3.sqlite)
  corpuscle sweep merge chips.sqlite chips-?of3.sqlite              combine the three parts
  mpirun --enable-recovery -n 64 corpuscle sweep chips.toml         64 MPI processes; if one dies, only its block is repeated
  sqlite3 chips.sqlite "SELECT ended, count(*) FROM items GROUP BY ended"

Exit status: 0 all items have ended (truncated and diverged ones are reported), 1 bad input, 2 bad
usage, 3 no item converged, 130 interrupted.)";

constexpr const char* sweep_show_examples =
    R"(All estimates have 95 % confidence intervals: yields by Clopper and Pearson, means by Student,
standard deviations by Bonett (without assuming a distribution), quantiles between two order
statistics. doc/sweeps.md explains how to read them.

Examples:
  corpuscle sweep show chips.sqlite
  corpuscle sweep show chips.sqlite --by temp --measure spikes --quantile 0.01 --quantile 0.99
  corpuscle sweep show chips.sqlite --report chips.html
  corpuscle sweep show chips.sqlite --json)";

CLI::App& add_sweep(CLI::App& app, SweepArguments& args, SweepMergeArguments& merge_args, std::string& dumped, CommonArguments& common) {
    auto& verb = *app.add_subcommand("sweep", "run Monte Carlo, corner and grid sweeps -> one results file");
    verb.footer(sweep_examples);
    verb.require_subcommand(0, 1);
    verb.add_option("FILE", args.file, "a sweep file (TOML), or a netlist with .mc and .step lines");
    verb.add_option("--out,-o", args.out, "results file (default: the name of FILE with .sqlite, in the current directory)")
        ->type_name("RESULTS");
    verb.add_option("--threads,-j", args.threads,
                    "number of threads (0: one per core, under mpirun one per rank); results do not depend on it")
        ->check(CLI::Range(0U, 1024U))
        ->capture_default_str()
        ->type_name("N");
    verb.add_option("--lanes", args.lanes, "number of chips simulated at once per thread (SIMD); results do not depend on it")
        ->check(CLI::IsMember({1, 4, 8}))
        ->capture_default_str()
        ->type_name("1|4|8");
    verb.add_option("--shard", args.shard, "run only part K of N, for several machines without MPI")->type_name("K/N");
    verb.add_option("--seed", args.seed, "random seed (replaces the seed of the file)")->type_name("N");
    verb.add_option("--samples", args.samples, "number of random samples at each point (replaces the number in the file)")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
    verb.add_flag("--status", args.status, "print progress: finished items, missing items, speed");
    add_common(verb, common);

    auto& merge = *verb.add_subcommand("merge", "combine results files of one sweep, such as its shards");
    merge.footer(
        "Items that are already in OUT are not added twice. If an item differs, merge stops with an error that names it.\n\n"
        "Example:\n  corpuscle sweep merge chips.sqlite chips-1of3.sqlite chips-2of3.sqlite chips-3of3.sqlite");
    merge.add_option("OUT", merge_args.out, "the combined results file, created if it does not exist")->required();
    merge.add_option("IN", merge_args.in, "results files")->required();
    add_common(merge, common);

    auto& dump = *verb.add_subcommand("dump", "print all rows of a results file as CSV, in order, with spikes");
    dump.footer(
        "The output does not depend on how the sweep was run, so two dumps can be compared with 'cmp' or 'sha256sum'.\n\n"
        "Example:\n  corpuscle sweep dump chips.sqlite > chips.csv");
    dump.add_option("RESULTS", dumped, "a results file")->required();
    verb.callback([&verb, &args] {
        if (args.file.empty() && verb.get_subcommands().empty())
            throw CLI::RequiredError("corpuscle sweep: needs FILE, or one of merge, show, dump, calibrate");
    });
    return verb;
}

void add_sweep_show(CLI::App& sweep, SweepShowArguments& args, CommonArguments& common) {
    auto& verb = *sweep.add_subcommand("show", "analyse a results file: yields, distributions, most influential devices");
    verb.footer(sweep_show_examples);
    verb.add_option("RESULTS", args.results, "a results file; the sweep may still be running")->required();
    verb.add_option("--by", args.by, "group the results by these axes (default: all listed axes); random axes are divided into five bands")
        ->allow_extra_args(false)
        ->type_name("AXIS");
    verb.add_option("--measure,-m", args.measures, "analyse only these measures; limits of other measures are ignored")
        ->allow_extra_args(false)
        ->type_name("NAME");
    verb.add_option("--quantile", args.quantiles, "print this quantile with its confidence interval, such as 0.01")
        ->allow_extra_args(false)
        ->type_name("FRACTION");
    verb.add_option("--report", args.report_file, "write a report page")->type_name("FILE.html")->group("Output");
    verb.callback([&args] {
        if (!args.report_file.empty() && !args.report_file.ends_with(".html"))
            throw CLI::ValidationError(page_name_error(args.report_file));
    });
    add_common(verb, common);
    add_overwrite(verb, common);
}

void add_sweep_calibrate(CLI::App& sweep, SweepCalibrateArguments& args, CommonArguments& common) {
    auto& verb = *sweep.add_subcommand("calibrate", "trim simulated chips to match a model -> yield for each number of trim bits");
    verb.footer(
        "Each chip is simulated with the stimulus. It passes if the spike count of each phase differs from\n"
        "the model's by at most a quarter (or one spike), if no spike precedes the force, and if the first\n"
        "spike is within 10 ms of the model's. A chip that fails is trimmed, coarse steps first, and\n"
        "simulated again.\n\n"
        "Examples:\n  corpuscle sweep calibrate sa1-circuit\n  corpuscle sweep calibrate fa1-circuit --samples 200 --bits 6 --separately\n"
        "  corpuscle sweep calibrate own.cir --like sa1 --trim i_leak=50% --trim x1.m3.m+x1.m4.m=25%");
    verb.add_option("NETLIST", args.netlist, "sa1-circuit, fa1-circuit, or a netlist with a force input and a spike output")->required();
    verb.add_option("--like", args.like, "the model to match (default: sa1 for sa1-circuit, fa1 for fa1-circuit)")->type_name("AFFERENT");
    verb.add_option("--trim", args.trims,
                    "a trimmed .param or device parameter (several are joined by +) and its range: the increase at the highest code. The "
                    "multiplier .m is trimmed in integer steps (default: I_LEAK, I_BIASB and one gain)")
        ->type_name("NAME=RANGE");
    verb.add_option("--bits", args.bits, "maximum number of bits of each trim")
        ->check(CLI::Range(1, 12))
        ->capture_default_str()
        ->type_name("N");
    verb.add_option("--samples", args.samples, "number of chips")->check(CLI::PositiveNumber)->capture_default_str()->type_name("N");
    verb.add_option("--seed", args.seed, "random seed of process and mismatch")->capture_default_str()->type_name("N");
    verb.add_option("--corner", args.corner, "process corner; mc includes process variation")->capture_default_str();
    verb.add_option("--force", args.force, "the stimulus")->capture_default_str()->type_name("STIMULUS");
    verb.add_flag("--separately", args.separately, "also evaluate each trim alone");
    verb.add_option("--threads,-j", args.threads, "number of threads (0: one per core); results do not depend on it")
        ->check(CLI::Range(0U, 1024U))
        ->capture_default_str()
        ->type_name("N");
    add_common(verb, common);
}

}  // namespace

void SweepVerbs::add_to(CLI::App& app, CommonArguments& common) {
    verb_ = &add_sweep(app, sweep_, merge_, dump_path_, common);
    add_sweep_show(*verb_, show_, common);
    add_sweep_calibrate(*verb_, calibrate_, common);
}

int SweepVerbs::run(const CommonArguments& common) const {
    return verb_->got_subcommand("merge")       ? sweep_merge(merge_, common)
           : verb_->got_subcommand("dump")      ? sweep_dump(dump_path_, common)
           : verb_->got_subcommand("show")      ? sweep_show(show_, common)
           : verb_->got_subcommand("calibrate") ? sweep_calibrate(calibrate_, common)
                                                : sweep(sweep_, common);
}

}  // namespace corpuscle
