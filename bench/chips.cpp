// How long does one chip of a Monte Carlo analysis take: the operating point of a circuit with mismatch in each transistor?
//
//     bench-chips NETLIST [CHIPS]
//
// Method: the netlist is read once. Each chip has its own sample of mismatch and process, and is solved from the nominal operating point to
// the tolerances of its .options. Output: median, minimum and maximum wall time per chip of 9 rounds over the same chips, Newton steps,
// chips that needed another method than Newton's or failed, and mean and standard deviation of each node's voltage. `bench/peers/chips.py`
// compares it with ngspice.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/device/uicm_card.hpp"

namespace {

using namespace corpuscle;
using namespace corpuscle::circuit;

/// The work of one round, summed over all chips.
struct Work {
    long steps = 0, other_methods = 0, failed = 0;  // Newton steps; chips solved by another method; chips not solved
    std::vector<double> sum, squares;               // of each node's voltage and of its square
};

Work run_round(AnalysisContext& bench, std::uint64_t chips) {
    Work work;
    const auto nodes = static_cast<std::size_t>(bench.system.nodes());
    work.sum.resize(nodes), work.squares.resize(nodes);
    for (std::uint64_t chip = 0; chip < chips; ++chip) {
        ChipSample sample{1, chip, true, {}};
        sample.process = sample_process(sample.seed, chip);
        bench.apply_variation(sample);
        const auto found = bench.operating_point();
        if (!found) {
            ++work.failed;
            continue;
        }
        work.steps += found->iterations, work.other_methods += found->method != "newton";
        for (std::size_t n = 0; n < nodes; ++n) work.sum[n] += found->x[n], work.squares[n] += found->x[n] * found->x[n];
    }
    return work;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return std::fputs("bench-chips NETLIST [CHIPS]\n", stderr), 2;
    const auto chips = static_cast<std::uint64_t>(argc > 2 ? std::atol(argv[2]) : 5000);
    const auto netlist = Netlist::read(argv[1]);
    if (!netlist) return std::fprintf(stderr, "%s\n", netlist.error().text().c_str()), 1;
    auto circuit = netlist->elaborate();
    if (!circuit) return std::fprintf(stderr, "%s\n", circuit.error().text().c_str()), 1;
    auto bench = AnalysisContext::make(std::make_shared<const Circuit>(std::move(*circuit)));
    if (!bench) return std::fprintf(stderr, "%s\n", bench.error().text().c_str()), 1;
    std::vector<double> us;
    Work work;
    for (int round = 0; round < 9; ++round) {
        const auto start = std::chrono::steady_clock::now();
        work = run_round(**bench, chips);
        us.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * 1e6 / static_cast<double>(chips));
    }
    std::sort(us.begin(), us.end());
    std::printf(
        "%llu chips: %.2f us each (%.2f ... %.2f), %.2f Newton steps each, %ld by another method, %ld failed; in all rounds, %ld matrices "
        "not eliminated along the list\n",
        static_cast<unsigned long long>(chips), us[us.size() / 2], us.front(), us.back(),
        static_cast<double>(work.steps) / static_cast<double>(chips), work.other_methods, work.failed,
        (*bench)->newton.linear_solver.fallback_count());
    const double count = static_cast<double>(chips) - static_cast<double>(work.failed);
    for (std::size_t n = 0; n < work.sum.size(); ++n) {
        const double mean = work.sum[n] / count;
        std::printf("  %-12s mean %.6f V  deviation %.6f V\n", (*bench)->system.names()[n].c_str(), mean,
                    std::sqrt(std::max(0.0, work.squares[n] / count - mean * mean)));
    }
}
