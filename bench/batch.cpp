// How long does one chip of a batched simulation take, and does it give the same result as a scalar run?
//
//     bench-batch NETLIST|NAME [CHIPS] [LANES] [alone]           default: 100 chips, 8 lanes
//
// Method: the netlist's afferent responds to the press of 1.0 s (10 kHz); each chip has its own sample of process and mismatch. run_chips
// simulates all chips on one thread. Output: wall time per chip, time steps, Newton iterations and the time of one, chips whose lane failed
// and that were simulated again by the scalar code, and the spike counts, each with its number of chips. With `alone`, the scalar code also
// simulates each chip, with its own pivots (KLU) and every transistor evaluated in every iteration. Then the output compares this run with
// that on lanes: chips with another spike count, the largest shift of a spike in each of the other chips, and the differences in steps.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "core/stimulus/stimuli.hpp"

namespace {

using namespace corpuscle;
using namespace corpuscle::circuit;

constexpr double T = 1e-4;  // s

/// Wall time, s.
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

using Responses = std::map<std::int64_t, ChipResponse>;  // by index of the chip

/// `seconds`: wall time of all chips.
void print_responses(const Responses& responses, double seconds) {
    long steps = 0, rejected = 0, iterations = 0, max_iterations = 0, left = 0, diverged = 0;
    std::map<std::size_t, int> counts;  // number of chips by spike count
    for (const auto& [number, a] : responses) {
        steps += a.stats.steps, rejected += a.stats.rejected, iterations += a.stats.iterations;
        max_iterations = std::max(max_iterations, a.stats.iterations);
        left += a.is_scalar, diverged += a.error.has_value(), ++counts[a.spikes.size()];
    }
    const auto chips = static_cast<double>(responses.size());
    std::printf(
        "%.0f chips: %.2f s, %.1f ms a chip; %.0f steps, %.0f rejected, %.0f iterations a chip (at most %ld), %.2f us an iteration; "
        "%ld left their lane, %ld did not converge\nspikes:",
        chips, seconds, seconds / chips * 1e3, static_cast<double>(steps) / chips, static_cast<double>(rejected) / chips,
        static_cast<double>(iterations) / chips, max_iterations, seconds / static_cast<double>(iterations) * 1e6, left, diverged);
    for (const auto& [count, chip_count] : counts) std::printf(" %zu (%d)", count, chip_count);
    std::printf("\n");
}

void compare(const Responses& lanes, const Responses& alone) {
    int chips_with_other_counts = 0, chips_with_other_steps = 0;
    long step_difference = 0, total_steps = 0;
    std::vector<double> shifts;  // largest shift of a spike in each chip with the same spike count, s
    for (const auto& [number, a] : lanes) {
        const auto& b = alone.at(number);
        chips_with_other_steps += a.stats.steps != b.stats.steps || a.stats.rejected != b.stats.rejected;
        step_difference += std::labs(a.stats.steps - b.stats.steps) + std::labs(a.stats.rejected - b.stats.rejected);
        total_steps += b.stats.steps;
        if (a.spikes.size() != b.spikes.size()) {
            ++chips_with_other_counts;
            continue;
        }
        double largest = 0;
        for (std::size_t k = 0; k < a.spikes.size(); ++k) largest = std::max(largest, std::abs(a.spikes[k] - b.spikes[k]));
        shifts.push_back(largest);
    }
    std::sort(shifts.begin(), shifts.end());
    const auto quantile = [&](double fraction) {
        return shifts.empty() ? 0 : shifts[static_cast<std::size_t>(fraction * static_cast<double>(shifts.size() - 1))];
    };
    std::printf(
        "%d chips have another spike count; %d chips have other steps, which differ by %ld of %ld\n"
        "largest shift of a spike in a chip: median of the chips %.1f us, 99 %% of the chips below %.1f us, maximum %.1f us\n",
        chips_with_other_counts, chips_with_other_steps, step_difference, total_steps, quantile(0.5) * 1e6, quantile(0.99) * 1e6,
        quantile(1) * 1e6);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return std::fputs("bench-batch NETLIST|NAME [CHIPS] [LANES] [alone]\n", stderr), 2;
    const std::int64_t count = argc > 2 ? std::atol(argv[2]) : 100;
    BatchOptions options;
    if (argc > 3) options.lanes = static_cast<std::size_t>(std::atol(argv[3]));
    const auto netlist = open_netlist(argv[1]);
    if (!netlist) return std::fprintf(stderr, "%s\n", netlist.error().text().c_str()), 1;
    const auto design = CircuitAfferentFactory::create(*netlist);
    if (!design) return std::fprintf(stderr, "%s\n", design.error().text().c_str()), 1;
    const auto press = make_stimulus("press", 1 / T, 0);
    Frames frames(1, 20000);
    if (!press || !(*press)->read(frames)) return std::fputs("cannot create the press stimulus\n", stderr), 1;
    const auto force = std::span<const double>(frames.force[0]).first(frames.count);
    const ChipSpec chips{static_cast<double>(count), 1};
    const auto chip = [&](std::int64_t k) { return Chip{k, *design, chips.sample(static_cast<std::uint64_t>(k)), force, T}; };

    Responses lanes, alone;
    std::int64_t next = 0;
    double start = now();
    const auto done = run_chips(
        *design, [&]() -> std::optional<Chip> { return next < count ? std::optional(chip(next++)) : std::nullopt; },
        [&](const Chip& c, ChipResponse&& a) { lanes.emplace(c.id, std::move(a)); }, options);
    if (!done) return std::fprintf(stderr, "%s\n", done.error().text().c_str()), 1;
    std::printf("on lanes, ");
    print_responses(lanes, now() - start);
    if (argc < 5) return 0;
    start = now();
    for (std::int64_t k = 0; k < count; ++k) alone.emplace(k, run_chip_scalar(chip(k), options));
    std::printf("alone, ");
    print_responses(alone, now() - start);
    compare(lanes, alone);
}
