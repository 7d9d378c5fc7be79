// How long do the operations of rank 0 in a sweep take: to write a row, to pack an outcome, to exchange a message? How large is a results
// file of 1e6 rows, and how fast are queries of it?
//   bench-sweep [ITEMS [FOLDER]]        rows of ITEMS (1e6) work items: 6 axes, 10 measures, a train of 15 spikes; random numbers
//   mpirun -n 2 bench-sweep             messages from rank 1 to rank 0 (-n 2 binds them to different cores)
// Rows are written by SweepResults::add in batches of 8192, each a transaction on disk; then the file is checkpointed and queried. One run.
// Output: wall time and processor time. Processor time limits rank 0, and depends less on other load. Messages: the mean of 20,000 in
// sequence; rank 0's processor time includes its waiting.

#include <fmt/format.h>
#include <sys/resource.h>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "sweep/parallel/run_sweep.hpp"

namespace {

using namespace corpuscle;
using Clock = std::chrono::steady_clock;

/// Wall time since `start`, s.
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }
/// Processor time of this process, s.
double processor() {
    timespec t = {};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
/// Peak memory of this process so far.
double memory_MB() {
    rusage use = {};
    ::getrusage(RUSAGE_SELF, &use);
    return static_cast<double>(use.ru_maxrss) / 1024;
}

/// A sweep without a simulation: its outcomes are random numbers.
class RandomSweep final : public Sweep {
public:
    explicit RandomSweep(std::int64_t items) {
        item_count = items, train_names = {"sa1"}, metadata = {{"title", "bench"}};
        for (int k = 0; k < 6; ++k) axes.push_back({fmt::format("axis{}", k), ""});
        for (int k = 0; k < 10; ++k) measures.push_back({fmt::format("measure{}", k), ""});
    }
    std::vector<double> values(std::int64_t item) const override {
        std::vector<double> out(axes.size());
        for (std::size_t k = 0; k < out.size(); ++k) out[k] = 1 / static_cast<double>(3 + item + static_cast<std::int64_t>(k));
        return out;
    }
    Result<void> run_items(const NextItem&, const OutcomeHandler&, const std::function<bool()>&) const override { return {}; }

    ItemOutcome outcome(std::int64_t item, std::mt19937& random) const {
        std::uniform_real_distribution<> number;
        ItemOutcome o{item};
        for (std::size_t k = 0; k < measures.size(); ++k) o.measures.push_back(number(random));
        o.spikes.resize(1);
        for (int k = 0; k < 15; ++k) o.spikes[0].push_back(number(random));
        return o;
    }
};

void run_query(const SweepResults& results, const char* query) {
    const auto start = Clock::now();
    const auto value = results.file().query_integer(query);
    fmt::print("  {:.3f} s  {}  ({})\n", since(start), query, value ? *value : -1);
}

/// Times rows of the results file. Returns the exit status.
int rows(std::int64_t items, const std::string& folder) {
    const std::string path = folder + "/bench-sweep.sqlite";
    std::filesystem::remove(path);
    const RandomSweep sweep(items);
    auto results = SweepResults::open(path, sweep);
    if (!results) return fmt::print("{}\n", results.error().text()), 1;
    constexpr std::int64_t batch = 8192;
    std::mt19937 random(1);
    double writing = 0, packing = 0, unpacking = 0;  // processor time, s
    double writing_wall = 0;                         // wall time, s
    double at_tenth = 0;                             // memory after a tenth of the items, MB
    for (std::int64_t from = 0; from < items; from += batch) {
        std::vector<ItemOutcome> outcomes, decoded;
        for (std::int64_t k = from; k < std::min(items, from + batch); ++k) outcomes.push_back(sweep.outcome(k, random));
        auto start = processor();
        auto packed = pack_outcomes(outcomes);
        packing += processor() - start, start = processor();
        if (!unpack_outcomes(std::move(packed), decoded)) return 1;
        unpacking += processor() - start, start = processor();
        const auto wall = Clock::now();
        if (auto ok = results->add(sweep, std::move(decoded)); !ok) return fmt::print("{}\n", ok.error().text()), 1;
        writing += processor() - start, writing_wall += since(wall);
        if (at_tenth == 0 && from >= items / 10) at_tenth = memory_MB();
    }
    const auto start = Clock::now();
    const auto checkpoint_result = results->checkpoint();
    const auto n = static_cast<double>(items);
    fmt::print("{} rows: {:.2f} us of processor time per row, {:.2f} us of wall time ({:.0f} rows/s)\n", items, writing / n * 1e6,
               writing_wall / n * 1e6, n / writing_wall);
    fmt::print("packing an outcome {:.2f} us, unpacking it {:.2f} us of processor time\n", packing / n * 1e6, unpacking / n * 1e6);
    fmt::print("checkpoint in {:.2f} s{}: {:.0f} MB, {:.0f} bytes per row; memory {:.0f} MB after a tenth, {:.0f} MB at the end\n",
               since(start), checkpoint_result ? "" : " (failed)", static_cast<double>(std::filesystem::file_size(path)) / 1e6,
               static_cast<double>(std::filesystem::file_size(path)) / n, at_tenth, memory_MB());
    run_query(*results, "SELECT count(*) FROM items");
    run_query(*results, "SELECT avg(measure3) * 1e6 FROM items");
    run_query(*results, "SELECT count(*) FROM items WHERE measure0 < 0.5 AND measure9 > 0.1 AND ended = 'done'");
    run_query(*results, "SELECT length(times) FROM spikes WHERE item = 77777 AND train = 0");
    std::filesystem::remove(path);
    return 0;
}

/// Times messages from rank 1 to rank 0. Returns the exit status.
int messages(Ranks& ranks) {
    for (const std::size_t size : {16UL, 4096UL, 131072UL}) {
        constexpr int count = 20'000;
        const std::string text(size, 'x');
        const auto start = Clock::now();
        const double busy = processor();
        for (int k = 0; k < count; ++k)
            if (ranks.rank() == 1)
                ranks.send(0, text);
            else if (ranks.rank() == 0 && !ranks.receive(1))
                return 1;
        if (ranks.rank() == 0)
            fmt::print("a message of {} bytes: {:.2f} us; {:.2f} us of rank 0's processor\n", size, since(start) / count * 1e6,
                       (processor() - busy) / count * 1e6);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const auto ranks = Ranks::join();
    if (!ranks) return fmt::print("{}\n", ranks.error().text()), 1;
    return *ranks ? messages(**ranks) : rows(argc > 1 ? std::atoll(argv[1]) : 1'000'000, argc > 2 ? argv[2] : ".");
}
