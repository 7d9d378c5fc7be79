// corpuscle sweep: many units, what they gave in one file; status, merging and dumping.

#include <fmt/format.h>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "printable.hpp"
#include "study/sweep/dump.hpp"
#include "study/sweep/rank_run.hpp"
#include "study/sweep/writer_lock.hpp"
#include "sweep_state.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

Result<Shard> shard_of(const std::string& text) {
    if (text.empty()) return Shard{};
    long long k = 0, n = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%lld/%lld%c", &k, &n, &rest) != 2 || n < 1 || k < 1 || k > n)
        return bad_usage(fmt::format("--shard {}: say which part of how many, such as 1/4, 2/4, 3/4 and 4/4", text));
    return Shard{k - 1, n};
}

/// "mc.sqlite" of some/where/mc.toml, "mc-1of4.sqlite" of a part of it: where the command is given.
std::string results_path(const SweepWords& words, const Shard& shard) {
    if (!words.out.empty()) return words.out;
    const auto stem = fs::path(words.file).stem().string();
    return shard.of == 1 ? stem + ".sqlite" : fmt::format("{}-{}of{}.sqlite", stem, shard.index + 1, shard.of);
}

void tell(const Common& common, const SweepState& state) {
    if (common.json)
        fmt::print("{}\n", json_text(document_of(state)));
    else if (!common.quiet)
        show(text_of(state));
}

/// One of the processes that mpirun started, or all there is.
struct Self {
    std::unique_ptr<Ranks> ranks;  ///< none: alone
    bool leads() const { return !ranks || ranks->rank() == 0; }
};

Result<void> run_units(const Self& self, const Sweep& sweep, SweepResults& results, const SweepRun& run, const Common& common) {
    SweepCount count;
    if (!self.ranks) return run_sweep(sweep, results, run, count);
    if (!self.ranks->outlive_one() && !common.quiet)
        fmt::print(stderr,
                   "corpuscle: remark: if one rank dies mpirun will end them all (the same command goes on then); "
                   "'mpirun --enable-recovery ...' lets the others finish\n");
    RanksLost lost;
    auto ok = lead(*self.ranks, sweep, results, run, count, lost);
    if (lost.dead > 0)
        fmt::print(stderr, "corpuscle: warning: {} rank{} died or fell silent; the {} units that were there went to others\n", lost.dead,
                   lost.dead == 1 ? "" : "s", lost.units);
    return ok;
}

/// What to add to an error of a run, so that the next step is plain.
Error with_advice(const Error& error, const SweepResults& results) {
    if (error.code != Code::interrupted) return error;
    return {error.code, fmt::format("interrupted; {} of {} units have ended and are in {}: the same command goes on from there",
                                    results.finished(), results.units(), results.path())};
}

Result<void> lead_run(const Self& self, const Sweep& sweep, const SweepWords& words, const Common& common, const Shard& shard) {
    auto results = SweepResults::open(results_path(words, shard), sweep);
    if (!results) {
        if (self.ranks) dismiss(*self.ranks);
        return results.error();
    }
    const auto before = results->finished();
    SweepRun run{.threads = self.ranks ? std::max(1U, words.threads) : words.threads, .shard = shard, .stop = interrupted};
    auto done = [&] {
        Progress progress(common.quiet);
        run.seen = [&](const SweepCount& c) {
            progress.at(static_cast<double>(c.ended()) / static_cast<double>(std::max<std::int64_t>(1, c.to_do)));
        };
        return run_units(self, sweep, *results, run, common);
    }();
    if (const auto folded = results->fold(); !folded && !common.quiet)
        tell_warning(fmt::format("{} is whole, but only together with the file {}-wal beside it: {}", results->path(), results->path(),
                                 folded.error().sentence));
    if (!done) return with_advice(done.error(), *results);
    const auto state = state_of(*results, shard);
    if (!state) return state.error();
    auto told = *state;
    told.now = results->finished() - before, told.sweep = words.file;
    tell(common, told);
    if (results->finished() > 0 && told.lost == results->finished())
        return Error{Code::not_converged, fmt::format("not one of {} units converged: {}", told.lost, told.reasons.front().first)};
    return {};
}

Result<void> run(const SweepWords& words, const Common& common, Self& self) {
    const auto shard = shard_of(words.shard);
    if (!shard) return shard.error();
    if (Ranks::are_started()) {
        auto ranks = Ranks::join();
        if (!ranks) return ranks.error();
        if ((*ranks)->size() > 1) self.ranks = std::move(*ranks);
    }
    auto sweep = read_sweep(words.file, {words.seed, words.units});
    if (sweep) (*sweep)->set_lanes(words.lanes);
    if (!self.leads()) return follow(*self.ranks, sweep, {.threads = words.threads, .stop = interrupted});
    if (!sweep) {
        if (self.ranks) dismiss(*self.ranks);
        return sweep.error();
    }
    return lead_run(self, **sweep, words, common, *shard);
}

Result<void> status(const SweepWords& words, const Common& common) {
    const auto shard = shard_of(words.shard);
    if (!shard) return shard.error();
    const auto results = SweepResults::look(results_path(words, *shard));
    if (!results) return results.error();
    auto state = state_of(*results, *shard);
    if (!state) return state.error();
    state->sweep = words.file;
    if (const auto writer = WriterLock::holder(results->path())) {
        const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
        state->writer = *writer, state->written_for = now - writer->since;
    }
    tell(common, *state);
    return {};
}

Result<void> take_all(SweepResults& out, const std::vector<SweepResults>& in, const Common& common) {
    for (const auto& from : in) {
        if (interrupted()) return Error{Code::interrupted, "interrupted; the same command goes on"};
        const auto added = out.take(from);
        if (!added) return added.error();
        if (!common.json && !common.quiet) show(fmt::format("{}: {} units, {} of them new\n", from.path(), from.finished(), *added));
    }
    return {};
}

Result<void> merge(const SweepMergeWords& words, const Common& common) {
    std::vector<SweepResults> in;
    for (const auto& path : words.in) {
        auto results = SweepResults::look(path);
        if (!results) return results.error();
        in.push_back(std::move(*results));
        if (auto ok = in.back().same_sweep(in.front()); !ok) return ok;
    }
    auto out = SweepResults::open(words.out, in.front());
    if (!out) return out.error();
    auto ok = take_all(*out, in, common);
    if (auto folded = out->fold(); ok) ok = folded;
    if (!ok) return ok;
    const auto state = state_of(*out, {});
    if (!state) return state.error();
    tell(common, *state);
    return {};
}

Result<void> dump(const std::string& path) {
    const auto results = SweepResults::look(path);
    if (!results) return results.error();
    bool written = true;
    auto ok = dump_results(*results, [&](const std::string& text) {
        written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
        return written && !interrupted();
    });
    if (ok && (!written || std::fflush(stdout) != 0)) return bad_input("standard output cannot be written");
    if (ok && interrupted()) return Error{Code::interrupted, "interrupted"};
    return ok;
}

int status_of(const Result<void>& done) { return done ? 0 : fail(done.error()); }

}  // namespace

int sweep(const SweepWords& words, const Common& common) {
    catch_interrupt();
    if (words.status) return status_of(status(words, common));
    Self self;
    const auto done = run(words, common, self);
    // Of several ranks the first speaks; what others have to say they have told it, unless it is gone.
    const bool speaks = self.ranks ? self.leads() || !done : Ranks::speaks();
    const int code = done ? 0 : speaks ? fail(done.error()) : static_cast<int>(done.error().code);
    if (self.ranks && !self.ranks->left_together()) {
        std::fflush(nullptr);
        std::_Exit(code);  // MPI's own end would wait for the dead
    }
    return code;
}

int sweep_merge(const SweepMergeWords& words, const Common& common) {
    catch_interrupt();
    return status_of(merge(words, common));
}

int sweep_dump(const std::string& results, const Common&) {
    catch_interrupt();
    return status_of(dump(results));
}

}  // namespace corpuscle
