// A results file of a sweep: rows are read back as written, by any process, and no row is lost.

#include "sweep/store/sweep_results.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <csignal>
#include <filesystem>
#include <random>
#include <thread>

#include "support/child_process.hpp"
#include "support/plain_sweep.hpp"
#include "support/support.hpp"
#include "sweep/parallel/run_sweep.hpp"
#include "sweep/store/sqlite.hpp"

namespace corpuscle {
namespace {

using test::PlainSweep;
using test::TemporaryFolder;
using test::value_or_throw;

/// The text of all results, in order of the items.
std::string dump_of(const SweepResults& results) {
    std::string out;
    const auto ok = dump_results(results, [&](const std::string& text) { return out += text, true; });
    return ok ? out : throw std::runtime_error(ok.error().text());
}

std::string dump_of(const std::string& path) { return dump_of(value_or_throw(SweepResults::open_read_only(path))); }

void run_sweep_of(const Sweep& sweep, const std::string& path, const SweepRunOptions& options) {
    auto results = value_or_throw(SweepResults::open(path, sweep));
    SweepProgress count;
    const auto ok = run_sweep(sweep, results, options, count);
    if (!ok) throw std::runtime_error(ok.error().text());
    if (const auto written = results.checkpoint(); !written) throw std::runtime_error(written.error().text());
}

TEST(SweepResults, AreReadBackAsWrittenAndEndAsOneFile) {
    const TemporaryFolder folder;
    const PlainSweep sweep(1000);
    run_sweep_of(sweep, folder / "r.sqlite", {.threads = 3});
    EXPECT_EQ(folder.file_names(), std::vector<std::string>{"r.sqlite"});
    const auto results = value_or_throw(SweepResults::open_read_only(folder / "r.sqlite"));
    auto mode = value_or_throw(results.file().prepare("PRAGMA journal_mode"));
    EXPECT_TRUE(value_or_throw(mode.step()));
    EXPECT_EQ(mode.text(0), "delete") << "other programs can read the file in a read-only folder";
    EXPECT_EQ(results.item_count, 1000);
    EXPECT_EQ(results.finished_count(), 1000);
    EXPECT_EQ(results.about("netlist circuits/sa1.cir"), "a\nb\nc\n");
    EXPECT_EQ(results.axes[1].labels, (std::vector<std::string>{"even", "odd"}));
    EXPECT_EQ(results.measures[2].max, 0.75);
    EXPECT_EQ(results.stored_column_names, (std::vector<std::string>{"gain", "kind", "rate", "Rate_2", "why_2"}));
    EXPECT_EQ(results.probe_times, sweep.probe_times);
    std::int64_t item = 0;
    const auto ok = results.for_each_row([&](const std::vector<double>& axes, const ItemOutcome& row) {
        const auto o = sweep.outcome(item);
        EXPECT_EQ(row.item, item);
        EXPECT_EQ(row.end, o.end);
        EXPECT_EQ(row.reason, o.reason);
        EXPECT_EQ(row.steps, o.steps);
        EXPECT_EQ(row.ran_alone, o.ran_alone);
        EXPECT_EQ(axes, sweep.values(item));
        for (std::size_t k = 0; k < row.measures.size(); ++k) {
            const double expected = o.measures.empty() ? std::nan("") : o.measures[k];
            EXPECT_TRUE(std::isnan(expected) ? std::isnan(row.measures[k]) : row.measures[k] == expected);
        }
        for (std::size_t t = 0; t < 2; ++t)
            EXPECT_EQ(value_or_throw(results.spikes(item, t)), o.spikes.empty() ? std::vector<double>{} : o.spikes[t]);
        EXPECT_EQ(value_or_throw(results.probe_samples(item, 0)), o.probes.empty() ? std::vector<float>{} : o.probes[0]);
        return ++item < 400;
    });
    EXPECT_TRUE(ok);
    EXPECT_EQ(item, 400) << "stopped where requested";
    EXPECT_EQ(value_or_throw(results.file().query_integer("SELECT count(*) FROM items WHERE ended = 'diverged'")), 11);
}

namespace fs = std::filesystem;

constexpr double write_interval = 1e-4, item_time = 1e-4;  // s; item_time: how long an item takes

/// Starts a child process that calls `work` and exits.
pid_t child(const std::function<void()>& work) {
    const auto id = test::fork_child();
    if (id > 0) return id;
    try {
        work();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        ::_exit(1);
    }
    ::_exit(0);
}

int wait_status_of(pid_t id) {
    int status = 0;
    ::waitpid(id, &status, 0);
    return status;
}

void copy(const std::string& from, const std::string& to) {
    std::error_code none;  // the file may have been removed, or be replaced while it is copied
    fs::copy_file(from, to, fs::copy_options::overwrite_existing, none);
}

/// Checks that the rows are those of the first items, and returns their number. For a sweep on one thread.
std::int64_t check_prefix(const std::string& path, const std::string& complete) {
    const auto results = value_or_throw(SweepResults::open_read_only(path));
    const auto text = dump_of(results);
    EXPECT_EQ(text, complete.substr(0, text.size()));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), results.finished_count() + 1);
    return results.finished_count();
}

TEST(SweepResults, OfARunKilledAtAnyMomentKeepFinishedItemsAndAreCompletedByTheSameCommand) {
    const TemporaryFolder folder;
    const PlainSweep sweep(300, "x", item_time);
    const SweepRunOptions options{.threads = 2, .write_interval = write_interval};
    const auto start = std::chrono::steady_clock::now();
    run_sweep_of(sweep, folder / "whole.sqlite", options);
    const std::chrono::duration<double> length = std::chrono::steady_clock::now() - start;
    const auto complete = dump_of(folder / "whole.sqlite");
    std::mt19937 random(1);
    std::uniform_real_distribution<> moment(0, 1.2);
    const auto path = folder / "r.sqlite";
    int killed_midway = 0;
    for (int k = 0; k < 50 || (killed_midway <= 5 && k < 500); ++k) {  // on a busy machine the moments may miss the rows
        const auto id = child([&] { run_sweep_of(sweep, path, options); });
        std::this_thread::sleep_for(moment(random) * length);
        test::signal_child(id, SIGKILL);
        wait_status_of(id);
        if (!fs::exists(path)) continue;
        std::int64_t rows = 0;
        {
            const auto results = value_or_throw(SweepResults::open_read_only(path));
            rows = results.finished_count();
            std::int64_t before = -1;
            const auto ok = results.for_each_row([&](const std::vector<double>&, const ItemOutcome& row) {
                EXPECT_GT(row.item, before);
                before = row.item;
                const auto o = sweep.outcome(row.item);
                EXPECT_EQ(row.steps, o.steps);
                EXPECT_EQ(row.end, o.end);
                EXPECT_EQ(value_or_throw(results.spikes(row.item, 0)), o.spikes.empty() ? std::vector<double>{} : o.spikes[0]);
                return true;
            });
            EXPECT_TRUE(ok);
        }
        killed_midway += rows > 0 && rows < 300;
        if (k % 3 == 0) continue;  // the next one resumes the sweep
        run_sweep_of(sweep, path, {.threads = 2});
        EXPECT_EQ(dump_of(path), complete) << "killed after " << rows << " rows";
        EXPECT_FALSE(fs::exists(path + "-wal"));
        fs::remove(path);
    }
    EXPECT_GT(killed_midway, 5) << "some runs must have been killed between the first and the last row";
}

TEST(SweepResults, CopiesTakenAtAnyMomentHoldAllRowsUpToSomeItem) {
    const TemporaryFolder folder;
    const PlainSweep sweep(800, "x", item_time);
    run_sweep_of(PlainSweep(800, "x"), folder / "whole.sqlite", {.threads = 1});
    const auto complete = dump_of(folder / "whole.sqlite");
    const auto path = folder / "r.sqlite";
    const auto id = child([&] { run_sweep_of(sweep, path, {.threads = 1, .write_interval = write_interval}); });
    while (!fs::exists(path)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::mt19937 random(2);
    std::vector<std::string> copies;  // every second one with its -wal
    for (int k = 0; ::waitpid(id, nullptr, WNOHANG) == 0; ++k) {
        copies.push_back(folder / fmt::format("copy{}.sqlite", k));
        copy(path, copies.back());
        if (k % 2 == 0) copy(path + "-wal", copies.back() + "-wal");
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 8000));
    }
    ASSERT_GT(copies.size(), 10u);
    std::int64_t max_rows = 0;
    for (const auto& copied : copies) max_rows = std::max(max_rows, check_prefix(copied, complete));
    EXPECT_GT(max_rows, 200);
    EXPECT_EQ(dump_of(path), complete);
}

// A checkpoint first replaces the file by a new one, then removes the -wal of the old one.
TEST(SweepResults, OfARunKilledDuringACheckpointHaveAllRows) {
    const TemporaryFolder folder;
    const PlainSweep sweep(300);
    const auto path = folder / "r.sqlite";
    auto results = value_or_throw(SweepResults::open(path, sweep));
    SweepProgress count;
    ASSERT_TRUE(run_sweep(sweep, results, {.shard = {0, 2}}, count));
    ASSERT_TRUE(results.checkpoint());
    EXPECT_FALSE(fs::exists(path + "-wal"));
    const auto half = dump_of(path);
    ASSERT_TRUE(run_sweep(sweep, results, {}, count));
    EXPECT_EQ(count.planned, 150);
    copy(path, folder / "old.sqlite");
    copy(path + "-wal", folder / "new.sqlite-wal");
    ASSERT_TRUE(results.checkpoint());
    copy(path, folder / "new.sqlite");
    EXPECT_EQ(dump_of(folder / "old.sqlite"), half) << "the old file without its wal";
    EXPECT_EQ(dump_of(folder / "new.sqlite"), dump_of(path)) << "the state after a kill between the two steps of a checkpoint";
    EXPECT_EQ(value_or_throw(SweepResults::open_read_only(folder / "new.sqlite")).finished_count(), 300);
}

TEST(SweepResults, AtTheFileSizeLimitKeepTheirRowsAndNameTheRemedy) {
    const TemporaryFolder folder;
    const PlainSweep sweep(20'000);
    const auto path = folder / "r.sqlite";
    const auto id = child([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{400'000, 400'000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        auto results = value_or_throw(SweepResults::open(path, sweep));
        Result<void> ok;
        for (std::int64_t item = 0; ok && item < sweep.item_count; item += 100) {
            std::vector<ItemOutcome> some;
            for (std::int64_t k = item; k < item + 100; ++k) some.push_back(sweep.outcome(k));
            ok = results.add(sweep, std::move(some));
        }
        if (ok || ok.error().text().find("has reached the limit on file sizes ('ulimit -f'); everything written before is kept") ==
                      std::string::npos)
            throw std::runtime_error(ok ? "the limit was not reached" : ok.error().text());
        const rlimit less{40'000, 40'000};
        ::setrlimit(RLIMIT_FSIZE, &less);
        if (results.checkpoint()) throw std::runtime_error("a file larger than the limit was made");
    });
    ASSERT_EQ(wait_status_of(id), 0);
    EXPECT_GT(value_or_throw(SweepResults::open_read_only(path)).finished_count(), 0);
    EXPECT_FALSE(fs::exists(path + "-fold"));
    run_sweep_of(sweep, path, {});
    run_sweep_of(sweep, folder / "whole.sqlite", {.threads = 1});
    EXPECT_EQ(dump_of(path), dump_of(folder / "whole.sqlite"));
}

TEST(SweepResults, InAReadOnlyFolderAreReadButNotWritten) {
    const TemporaryFolder folder;
    const PlainSweep sweep(50);
    const auto odd_path = folder / "50% of #1, 100%41?.sqlite";  // SQLite's URIs give these characters a meaning
    for (const auto& path : {folder / "r.sqlite", odd_path}) run_sweep_of(sweep, path, {});
    fs::permissions(folder.path(), fs::perms(0555));
    const auto id = child([&] {
        if (::geteuid() == 0 && ::seteuid(65534) != 0) throw std::runtime_error("root writes everywhere");
        for (const auto& path : {folder / "r.sqlite", odd_path})
            if (value_or_throw(SweepResults::open_read_only(path)).finished_count() != 50) throw std::runtime_error("rows are missing");
        for (const char* name : {"r.sqlite", "new.sqlite"}) {
            const auto results = SweepResults::open(folder / name, sweep);
            if (results || results.error().text().find("give a writable path with --out") == std::string::npos)
                throw std::runtime_error(results ? "opened" : results.error().text());
        }
    });
    EXPECT_EQ(wait_status_of(id), 0);
    fs::permissions(folder.path(), fs::perms(0755));
}

std::string refusal(const std::string& path, const Sweep& sweep) {
    const auto results = SweepResults::open(path, sweep);
    return results ? "" : results.error().text();
}

TEST(SweepResults, RefuseTheFileOfAnotherSweepAndNameTheDifference) {
    const TemporaryFolder folder;
    const auto path = folder / "r.sqlite";
    run_sweep_of(PlainSweep(20), path, {});
    EXPECT_EQ(refusal(path, PlainSweep(20)), "");
    EXPECT_EQ(refusal(path, PlainSweep(20, "a\nB\nc\n")),
              path +
                  ": holds results of another sweep: netlist circuits/sa1.cir has changed since, in line 2. Give another file with --out, "
                  "undo the change, or remove this file");
    EXPECT_NE(refusal(path, PlainSweep(30)).find("the number of items was 20 and is 30 now"), std::string::npos);
    PlainSweep more(20);
    more.metadata.insert(more.metadata.begin(), {"card process/x.lib", "y"});
    EXPECT_NE(refusal(path, more).find("it has no entry 'card process/x.lib'"), std::string::npos);
}

TEST(SweepResults, RefuseOtherFiles) {
    const TemporaryFolder folder;
    EXPECT_NE(refusal(folder.write("text", std::string(5000, 'x')), PlainSweep(2)).find("is not an SQLite file"), std::string::npos);
    EXPECT_NE(refusal(folder.write("empty", ""), PlainSweep(2)).find("holds no results of a sweep"), std::string::npos);
    EXPECT_NE(SweepResults::open_read_only(folder / "none").error().text().find("does not exist"), std::string::npos);
    run_sweep_of(PlainSweep(2), folder / "r.sqlite", {});
    const int file = ::open((folder / "r.sqlite").c_str(), O_RDWR);
    ASSERT_EQ(::pwrite(file, "\0\0\0\7", 4, 60), 4) << "SQLite's user version";
    ::close(file);
    EXPECT_NE(refusal(folder / "r.sqlite", PlainSweep(2)).find("was written by a later corpuscle (its format is 7"), std::string::npos);
}

TEST(SweepResults, HaveOneWriterAtATimeAndCanBeReadMeanwhile) {
    const TemporaryFolder folder;
    const PlainSweep sweep(20);
    const auto path = folder / "r.sqlite";
    {
        auto first = value_or_throw(SweepResults::open(path, sweep));
        ASSERT_TRUE(first.add(sweep, {sweep.outcome(3)}));
        EXPECT_NE(refusal(path, sweep).find(fmt::format("is being written by process {} on ", ::getpid())), std::string::npos);
        ASSERT_TRUE(first.add(sweep, {sweep.outcome(4), sweep.outcome(3)}));
        EXPECT_EQ(value_or_throw(SweepResults::open_read_only(path)).finished_count(), 2) << "an item has only one row";
        EXPECT_EQ(first.finished_count(), 2);
    }
    EXPECT_EQ(refusal(path, sweep), "") << "the lock is released with its owner";
    EXPECT_FALSE(fs::exists(path + "-writer"));
}

/// A sweep that differs in one item.
struct SweepWithOneChange : PlainSweep {
    using PlainSweep::PlainSweep;
    ItemOutcome outcome(std::int64_t item) const override {
        auto o = PlainSweep::outcome(item);
        if (item == 7) o.spikes[0].back() += 1e-9;
        return o;
    }
};

TEST(SweepResults, ShardsMergeIntoAllItemsWithoutDuplicates) {
    const TemporaryFolder folder;
    const PlainSweep sweep(1001);
    run_sweep_of(sweep, folder / "whole.sqlite", {.threads = 1});
    for (std::int64_t k = 0; k < 3; ++k) run_sweep_of(sweep, folder / fmt::format("{}", k), {.threads = 2, .shard = {k, 3}});
    auto all = value_or_throw(SweepResults::open(folder / "all.sqlite", sweep));
    for (const auto& [shard, rows] : {std::pair{"2", 333}, {"0", 334}, {"2", 0}, {"1", 334}})
        EXPECT_EQ(value_or_throw(all.merge(value_or_throw(SweepResults::open_read_only(folder / shard)))), rows);
    EXPECT_EQ(dump_of(all), dump_of(folder / "whole.sqlite"));
    run_sweep_of(SweepWithOneChange(1001), folder / "changed", {.shard = {1, 3}});
    const auto merged = all.merge(value_or_throw(SweepResults::open_read_only(folder / "changed")));
    ASSERT_FALSE(merged);
    EXPECT_NE(merged.error().text().find("changed: the results of item 7 differ from those in"), std::string::npos)
        << merged.error().text();
    run_sweep_of(PlainSweep(1001, "other"), folder / "other", {});
    EXPECT_NE(
        all.merge(value_or_throw(SweepResults::open_read_only(folder / "other"))).error().text().find("belongs to another sweep than"),
        std::string::npos);
    EXPECT_EQ(dump_of(all), dump_of(folder / "whole.sqlite"));
}

TEST(SweepResults, AStoppedRunKeepsTheFinishedItems) {
    const TemporaryFolder folder;
    const PlainSweep sweep(100'000, "x", item_time);
    auto results = value_or_throw(SweepResults::open(folder / "r.sqlite", sweep));
    SweepProgress count;
    const auto ok = run_sweep(sweep, results,
                              {.threads = 2, .write_interval = 0.01, .should_stop = [&] { return results.finished_count() > 100; }}, count);
    ASSERT_FALSE(ok);
    EXPECT_EQ(ok.error().code, ErrorCode::interrupted);
    EXPECT_EQ(count.finished(), results.finished_count());
    EXPECT_LT(results.finished_count(), 5000);
}

}  // namespace
}  // namespace corpuscle
