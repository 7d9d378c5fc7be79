// corpuscle sweep: runs the work items of a sweep into one results file; prints status, merges and dumps results.

#include <fmt/format.h>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/output/printable.hpp"
#include "cli/output/sweep_status.hpp"
#include "cli/output/terminal.hpp"
#include "cli/verbs.hpp"
#include "sweep/parallel/rank_run.hpp"
#include "sweep/store/dump.hpp"
#include "sweep/store/writer_lock.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

/// Parses "K/N", where K counts from 1; Shard::index counts from 0. "" is the complete sweep.
Result<Shard> shard_of(const std::string& text) {
    if (text.empty()) return Shard{};
    long long k = 0, n = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%lld/%lld%c", &k, &n, &rest) != 2 || n < 1 || k < 1 || k > n)
        return bad_usage(fmt::format("--shard {}: write K/N, part K of N, such as 1/4", text));
    return Shard{k - 1, n};
}

/// The results file of --out. The default is in the current directory: "mc.sqlite" for some/where/mc.toml, "mc-1of4.sqlite" for shard 1/4.
std::string results_path(const SweepArguments& args, const Shard& shard) {
    if (!args.out.empty()) return args.out;
    const auto stem = fs::path(args.file).stem().string();
    return shard.shard_count == 1 ? stem + ".sqlite" : fmt::format("{}-{}of{}.sqlite", stem, shard.index + 1, shard.shard_count);
}

void print_state(const CommonArguments& common, const SweepStatus& state) {
    if (common.json)
        fmt::print("{}\n", json_text(document_of(state)));
    else if (!common.quiet)
        print_text(sweep_status_text(state));
}

/// This process among the MPI ranks.
struct SweepProcess {
    std::unique_ptr<Ranks> ranks;  ///< null: a single process
    bool is_coordinator() const { return !ranks || ranks->rank() == 0; }
};

/// Runs the missing items, in a single process or as the coordinator of the ranks.
Result<void> run_items(const SweepProcess& self, const Sweep& sweep, SweepResults& results, const SweepRunOptions& run_options,
                       const CommonArguments& common) {
    SweepProgress progress;
    if (!self.ranks) return run_sweep(sweep, results, run_options, progress);
    if (!self.ranks->survive_death_of_one() && !common.quiet)
        fmt::print(stderr,
                   "corpuscle: note: if one rank dies, mpirun ends all of them, and the same command resumes the sweep. "
                   "With 'mpirun --enable-recovery ...' the other ranks finish\n");
    DeadRanks dead_ranks;
    auto ok = run_coordinator(*self.ranks, sweep, results, run_options, progress, dead_ranks);
    if (dead_ranks.ranks > 0)
        fmt::print(stderr, "corpuscle: warning: {} rank{} died or stopped responding, and other ranks repeat {} items\n", dead_ranks.ranks,
                   dead_ranks.ranks == 1 ? "" : "s", dead_ranks.redistributed_items);
    return ok;
}

/// The error of a run; if it was interrupted, the message says how to resume it.
Error with_advice(const Error& error, const SweepResults& results) {
    if (error.code != ErrorCode::interrupted) return error;
    return {error.code, fmt::format("interrupted; {} of {} items have ended and are saved in {}; the same command resumes the sweep",
                                    results.finished_count(), results.item_count(), results.path())};
}

/// Opens the results file, runs the missing items and prints the status.
Result<void> coordinate_run(const SweepProcess& self, const Sweep& sweep, const SweepArguments& args, const CommonArguments& common,
                            const Shard& shard) {
    auto results = SweepResults::open(results_path(args, shard), sweep);
    if (!results) {
        if (self.ranks) shut_down_workers(*self.ranks);
        return results.error();
    }
    const auto finished_before = results->finished_count();
    SweepRunOptions run_options{
        .threads = self.ranks ? std::max(1U, args.threads) : args.threads, .shard = shard, .should_stop = interrupted};
    auto done = [&] {
        Progress progress(common.quiet);
        run_options.on_progress = [&](const SweepProgress& c) {
            progress.update(static_cast<double>(c.finished()) / static_cast<double>(std::max<std::int64_t>(1, c.planned)));
        };
        return run_items(self, sweep, *results, run_options, common);
    }();
    if (const auto checkpointed = results->checkpoint(); !checkpointed && !common.quiet)
        print_warning(fmt::format("the results are complete only if {} is kept together with {}-wal: {}", results->path(), results->path(),
                                  checkpointed.error().message));
    if (!done) return with_advice(done.error(), *results);
    const auto state = read_sweep_status(*results, shard);
    if (!state) return state.error();
    auto final_state = *state;
    final_state.finished_now = results->finished_count() - finished_before, final_state.sweep = args.file;
    print_state(common, final_state);
    if (results->finished_count() > 0 && final_state.diverged == results->finished_count())
        return Error{ErrorCode::not_converged,
                     fmt::format("none of {} items converged: {}", final_state.diverged, final_state.reasons.front().first)};
    return {};
}

Result<void> run(const SweepArguments& args, const CommonArguments& common, SweepProcess& self) {
    const auto shard = shard_of(args.shard);
    if (!shard) return shard.error();
    if (Ranks::are_started()) {
        auto ranks = Ranks::join();
        if (!ranks) return ranks.error();
        if ((*ranks)->size() > 1) self.ranks = std::move(*ranks);
    }
    auto sweep = read_sweep(args.file, {args.seed, args.samples});
    if (sweep) (*sweep)->set_lanes(args.lanes);
    if (!self.is_coordinator()) return run_worker(*self.ranks, sweep, {.threads = args.threads, .should_stop = interrupted});
    if (!sweep) {
        if (self.ranks) shut_down_workers(*self.ranks);
        return sweep.error();
    }
    return coordinate_run(self, **sweep, args, common, *shard);
}

Result<void> show_sweep_status(const SweepArguments& args, const CommonArguments& common) {
    const auto shard = shard_of(args.shard);
    if (!shard) return shard.error();
    const auto results = SweepResults::open_read_only(results_path(args, *shard));
    if (!results) return results.error();
    auto state = read_sweep_status(*results, *shard);
    if (!state) return state.error();
    state->sweep = args.file;
    if (const auto writer = WriterLock::holder(results->path())) {
        const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
        state->writer = *writer, state->running_for = now - writer->since;
    }
    print_state(common, *state);
    return {};
}

Result<void> merge_all(SweepResults& out, const std::vector<SweepResults>& in, const CommonArguments& common) {
    for (const auto& from : in) {
        if (interrupted()) return Error{ErrorCode::interrupted, "interrupted; the same command resumes"};
        const auto added = out.merge(from);
        if (!added) return added.error();
        if (!common.json && !common.quiet)
            print_text(fmt::format("{}: {} items, {} of them new\n", from.path(), from.finished_count(), *added));
    }
    return {};
}

Result<void> merge(const SweepMergeArguments& args, const CommonArguments& common) {
    std::vector<SweepResults> in;
    for (const auto& path : args.in) {
        auto results = SweepResults::open_read_only(path);
        if (!results) return results.error();
        in.push_back(std::move(*results));
        if (auto ok = in.back().check_same_sweep(in.front()); !ok) return ok;
    }
    auto out = SweepResults::open(args.out, in.front());
    if (!out) return out.error();
    auto ok = merge_all(*out, in, common);
    // A checkpoint also after an error, so that the items merged so far are in the file; the first error is returned.
    if (auto checkpointed = out->checkpoint(); ok) ok = checkpointed;
    if (!ok) return ok;
    const auto state = read_sweep_status(*out, {});
    if (!state) return state.error();
    print_state(common, *state);
    return {};
}

Result<void> dump(const std::string& path) {
    const auto results = SweepResults::open_read_only(path);
    if (!results) return results.error();
    bool written = true;
    auto ok = dump_results(*results, [&](const std::string& text) {
        written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
        return written && !interrupted();
    });
    if (ok && (!written || std::fflush(stdout) != 0)) return bad_input("cannot write to standard output");
    if (ok && interrupted()) return Error{ErrorCode::interrupted, "interrupted"};
    return ok;
}

int status_of(const Result<void>& done) { return done ? 0 : report_error(done.error()); }

}  // namespace

int sweep(const SweepArguments& args, const CommonArguments& common) {
    catch_interrupt();
    if (args.status) return status_of(show_sweep_status(args, common));
    SweepProcess self;
    const auto done = run(args, common, self);
    // With several ranks the coordinator prints all errors. A worker returns an error only if the coordinator has died.
    const bool prints_errors = self.ranks ? self.is_coordinator() || !done : Ranks::reports_errors();
    const int code = done ? 0 : prints_errors ? report_error(done.error()) : static_cast<int>(done.error().code);
    if (self.ranks && !self.ranks->left_together()) {
        std::fflush(nullptr);
        std::_Exit(code);  // MPI_Finalize would wait for dead ranks
    }
    return code;
}

int sweep_merge(const SweepMergeArguments& args, const CommonArguments& common) {
    catch_interrupt();
    return status_of(merge(args, common));
}

int sweep_dump(const std::string& results, const CommonArguments&) {
    catch_interrupt();
    return status_of(dump(results));
}

}  // namespace corpuscle
