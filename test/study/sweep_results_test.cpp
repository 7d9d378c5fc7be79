// A sweep's file of results: rows come back as they went in, whoever wrote them, and nothing is lost.

#include "study/sweep/results.hpp"

#include <filesystem>
#include <random>

#include "study/sweep/run_sweep.hpp"
#include "support/plain_sweep.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::Folder;
using test::PlainSweep;
using test::sure;

/// All that a file says, in order.
std::string all_of(const SweepResults& results) {
    std::string out;
    const auto ok = results.each([&](const SweepResults::Row& row) {
        out += fmt::format("{} {} {} {} {} {}", row.unit, static_cast<int>(row.end), row.steps, row.iterations, row.alone, row.why);
        for (const auto* numbers : {&row.axes, &row.measures})
            for (const double x : *numbers) out += fmt::format(" {}", x);
        for (std::size_t t = 0; t < results.trains().size(); ++t)
            out += fmt::format(" [{}]", fmt::join(sure(results.spikes(row.unit, t)), " "));
        out += fmt::format(" ({})\n", fmt::join(sure(results.trace(row.unit, 0)), " "));
        return true;
    });
    if (!ok) throw std::runtime_error(ok.error().text());
    return out;
}

std::string all_of(const std::string& path) { return all_of(sure(SweepResults::look(path))); }

void run(const Sweep& sweep, const std::string& path, const SweepRun& how) {
    auto results = sure(SweepResults::open(path, sweep));
    SweepCount count;
    const auto ok = run_sweep(sweep, results, how, count);
    if (!ok) throw std::runtime_error(ok.error().text());
    if (const auto folded = results.fold(); !folded) throw std::runtime_error(folded.error().text());
}

TEST(SweepResults, GiveBackWhatWasPutInAndAreOneFileInTheEnd) {
    const Folder folder;
    const PlainSweep sweep(1000);
    run(sweep, folder / "r.sqlite", {.threads = 3});
    EXPECT_EQ(folder.names(), std::vector<std::string>{"r.sqlite"});
    const auto results = sure(SweepResults::look(folder / "r.sqlite"));
    EXPECT_EQ(results.units(), 1000);
    EXPECT_EQ(results.finished(), 1000);
    EXPECT_EQ(results.about("netlist circuits/sa1.cir"), "a\nb\nc\n");
    EXPECT_EQ(results.axes()[1].words, (std::vector<std::string>{"even", "odd"}));
    EXPECT_EQ(results.measures()[2].at_most, 0.75);
    EXPECT_EQ(results.stored(), (std::vector<std::string>{"gain", "kind", "rate", "Rate_2", "why_2"}));
    EXPECT_EQ(results.trace_times(), sweep.trace_times());
    std::int64_t unit = 0;
    const auto ok = results.each([&](const SweepResults::Row& row) {
        const auto o = sweep.outcome(unit);
        EXPECT_EQ(row.unit, unit);
        EXPECT_EQ(row.end, o.end);
        EXPECT_EQ(row.why, o.why);
        EXPECT_EQ(row.steps, o.steps);
        EXPECT_EQ(row.alone, o.alone);
        EXPECT_EQ(row.axes, sweep.values(unit));
        for (std::size_t k = 0; k < row.measures.size(); ++k)
            EXPECT_TRUE(o.measures.empty() || std::isnan(o.measures[k]) ? std::isnan(row.measures[k]) : row.measures[k] == o.measures[k]);
        for (std::size_t t = 0; t < 2; ++t)
            EXPECT_EQ(sure(results.spikes(unit, t)), o.spikes.empty() ? std::vector<double>{} : o.spikes[t]);
        EXPECT_EQ(sure(results.trace(unit, 0)), o.traces.empty() ? std::vector<float>{} : o.traces[0]);
        return ++unit < 400;
    });
    EXPECT_TRUE(ok);
    EXPECT_EQ(unit, 400) << "stopped where it was told to";
    EXPECT_EQ(sure(results.ended(UnitEnd::lost)), 11);
}

}  // namespace
}  // namespace corpuscle
