// corpuscle sweep: runs the work items of a sweep into one results file, or prints its status.

#include <fmt/format.h>
#include <chrono>

#include "cli/output/terminal.hpp"
#include "cli/sweep/sweep_output.hpp"
#include "cli/verbs.hpp"
#include "sweep/parallel/run_sweep.hpp"
#include "sweep/parallel/shard_text.hpp"
#include "sweep/store/writer_lock.hpp"

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
  mpirun -n 64 corpuscle sweep chips.toml                           64 MPI processes, into one file
  sqlite3 chips.sqlite "SELECT ended, count(*) FROM items GROUP BY ended"

Exit status: 0 all items have ended (truncated and diverged ones are reported), 1 bad input, 2 bad
usage, 3 no item converged, 130 interrupted.)";

struct SweepArguments {
    std::string file, out, shard;
    std::optional<std::uint64_t> seed;
    std::optional<std::int64_t> samples;
    std::size_t lanes = 8;      // number of chips that one thread simulates at once: 1, 4 or 8
    std::uint32_t threads = 0;  // 0: one per core, or one per MPI rank
    bool status = false;        // only print the status of the sweep
};

SweepRunOptions run_options_of(const SweepArguments& args, const Shard& shard, const Ranks* ranks) {
    return {.threads = ranks ? std::max(1U, args.threads) : args.threads, .shard = shard, .should_stop = interrupted};
}

/// The error of a run; if it was interrupted, the message says how to resume it.
Error with_advice(const Error& error, const SweepResults& results) {
    if (error.code != ErrorCode::interrupted) return error;
    return {error.code, fmt::format("interrupted; {} of {} items have ended and are saved in {}; the same command resumes the sweep",
                                    results.finished_count(), results.item_count, results.path())};
}

/// Opens the results file, runs the missing items and prints the status. `ranks`: null for a single process; the others for rank 0.
Result<void> run_and_report(Ranks* ranks, const Sweep& sweep, const SweepArguments& args, const CommonArguments& common,
                            const Shard& shard) {
    auto results = TRY(SweepResults::open(results_path(args.file, args.out, shard), sweep));
    const auto finished_before = results.finished_count();
    auto run_options = run_options_of(args, shard, ranks);
    auto done = [&] {
        Progress progress(common.quiet);
        run_options.on_progress = [&](const SweepProgress& c) {
            progress.update(static_cast<double>(c.finished()) / static_cast<double>(std::max<std::int64_t>(1, c.planned)));
        };
        SweepProgress counts;
        return run_sweep(sweep, results, run_options, counts, ranks);
    }();
    if (const auto checkpointed = results.checkpoint(); !checkpointed && !common.quiet)
        print_warning(fmt::format("the results are complete only if {} is kept together with {}-wal: {}", results.path(), results.path(),
                                  checkpointed.error().message));
    if (!done) return with_advice(done.error(), results);
    auto state = TRY(read_sweep_status(results, shard));
    state.finished_now = results.finished_count() - finished_before, state.sweep = args.file;
    print_sweep_status(common, state);
    return check_any_converged(state);
}

Result<void> show_sweep_status(const SweepArguments& args, const CommonArguments& common) {
    const auto shard = TRY(parse_shard(args.shard));
    const auto results = TRY(SweepResults::open_read_only(results_path(args.file, args.out, shard)));
    auto state = TRY(read_sweep_status(results, shard));
    state.sweep = args.file;
    if (const auto writer = WriterLock::holder(results.path())) {
        const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
        state.writer = *writer, state.running_for = now - writer->since;
    }
    print_sweep_status(common, state);
    return {};
}

/// Runs the sweep, in this process or as one of the ranks of mpirun. Returns the exit status.
int run_in_process(const SweepArguments& args, const CommonArguments& common) {
    const auto shard = parse_shard(args.shard);
    if (!shard) return report_error_once(shard.error());
    const auto joined = Ranks::join();
    if (!joined) return report_error_once(joined.error());
    auto* const ranks = joined->get();
    const auto sweep = read_sweep(args.file, {args.seed, args.samples});
    if (sweep) (*sweep)->set_lanes(args.lanes);
    if (ranks && ranks->rank() > 0) return run_worker(*ranks, sweep, run_options_of(args, *shard, ranks)), 0;
    const auto run = [&] { return sweep ? run_and_report(ranks, **sweep, args, common, *shard) : sweep.error(); };
    const auto done = ranks ? without_exceptions(run) : run();
    if (done) return 0;
    const int code = report_error(done.error());
    if (ranks) ranks->abort(code);
    return code;
}

}  // namespace

Verb make_sweep_verb() {
    const auto args = std::make_shared<SweepArguments>();
    return {
        .name = "sweep",
        .description = "run Monte Carlo, corner and grid sweeps -> one results file",
        .examples = sweep_examples,
        .options = {{"",
                     {{"FILE", &args->file, "", "a sweep file (TOML), or a netlist with .mc and .step lines"},
                      {"--out,-o", &args->out, "RESULTS",
                       "results file (default: the name of FILE with .sqlite, in the current directory)"},
                      {"--threads,-j", &args->threads, "N",
                       "number of threads (0: one per core, under mpirun one per rank); results do not depend on it", std::pair(0U, 1024U)},
                      {"--lanes", &args->lanes, "1|4|8", "number of chips simulated at once per thread (SIMD); results do not depend on it",
                       one_of("1", "4", "8")},
                      {"--shard", &args->shard, "K/N", "run only part K of N, for several machines without MPI"},
                      {"--seed", &args->seed, "N", "random seed (replaces the seed of the file)"},
                      {"--samples", &args->samples, "N", "number of random samples at each point (replaces the number in the file)",
                       OptionSign::positive},
                      {"--status", &args->status, "", "print progress: finished items, missing items, speed"}}}},
        .reports = true,
        .check = [args](const CommonArguments&) -> Result<void> {
            if (!args->file.empty()) return {};
            return bad_usage("corpuscle sweep: FILE is required, or one of merge, show, dump and calibrate");
        },
        .run =
            [args](const CommonArguments& common) {
                catch_interrupt();
                return args->status ? exit_status(show_sweep_status(*args, common)) : run_in_process(*args, common);
            },
        .sub_verbs = {make_sweep_merge_verb(), make_sweep_dump_verb(), make_sweep_show_verb(), make_sweep_calibrate_verb()}};
}

}  // namespace corpuscle
