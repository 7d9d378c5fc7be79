// How well do trims correct chips? Each chip has mismatch and process variation and responds to a press. Its trims (parameters that can be
// set on a finished chip) are set until it fires like the model.
//
//     bench-calibrate sa1|fa1 [CHIPS] [BITS] [SEED] [TRIM ...]
//
// Default: 64 chips, 4 bits, seed 1. TRIM: i_leak, i_biasb or gain; default: the three together, then each alone.
//
// Method: sweep/calibrate/calibrate.hpp. The limits enclose the model's spikes (FiringLimits::around). Output: the limits, then for each
// set of trims the number of chips within the limits without trims and with at most 1, 2 ... bits, and the number of presses. For sets of
// three trims, also a line for each chip.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "circuit/variant/netlist_variants.hpp"
#include "corpuscle.hpp"
#include "sweep/calibrate/calibrate.hpp"

namespace {

using namespace corpuscle;

struct CalibrationCase {
    const char* model;
    std::vector<std::string> gain;  ///< parameters that the gain trim sets
};
const CalibrationCase cases[] = {{"sa1", {"summer.n3b.m"}}, {"fa1", {"rect.p1b.m", "rect.n2b.m"}}};

int fail(const Error& error) { return std::fprintf(stderr, "%s\n", error.text().c_str()), 1; }

}  // namespace

int main(int argc, char** argv) {
    const CalibrationCase* chosen_case = nullptr;
    for (const auto& k : cases)
        if (argc > 1 && std::strcmp(argv[1], k.model) == 0) chosen_case = &k;
    if (chosen_case == nullptr) return std::fputs("bench-calibrate sa1|fa1 [CHIPS] [BITS] [SEED] [TRIM ...]\n", stderr), 2;
    const int count = argc > 2 ? std::atoi(argv[2]) : 64, bits = argc > 3 ? std::atoi(argv[3]) : 4;
    const circuit::ChipSpec spec{static_cast<double>(count), argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1};
    std::vector<circuit::ChipSample> chips;
    for (int k = 0; k < count; ++k) chips.push_back(spec.sample(static_cast<std::uint64_t>(k)));

    ChipCalibration calibration;
    calibration.netlist = std::string(chosen_case->model) + "-circuit", calibration.bits = bits;
    calibration.overrides = {{"", "corner", "mc", "corner=mc"}};
    calibration.batch.max_iterations = 60'000;
    const auto press = stimulus("press");
    calibration.force = press.samples[0], calibration.T = 1 / press.rate;
    const TimeWindow phases[] = {{0, 0.25}, {0.25, 0.375}, {0.375, 0.625}, {0.625, 0.75}, {0.75, 1}};  // of the press, s
    calibration.limits = FiringLimits::around(respond(chosen_case->model, press).times, phases, 10e-3);
    calibration.on_progress = [](std::size_t left, std::size_t presses) {
        std::fprintf(stderr, "%zu chips left, %zu presses\n", left, presses);
    };
    fmt::print("{}, {} chips: {}\n", calibration.netlist, count, calibration.limits.text());

    const std::vector<std::string> trims[] = {{"i_leak"}, {"i_biasb"}, chosen_case->gain};
    std::vector<std::vector<int>> sets = {{0, 1, 2}, {0}, {1}, {2}};  // of indexes in `trims`
    if (argc > 5) {
        sets = {{}};
        for (int a = 5; a < argc; ++a)
            sets[0].push_back(std::strcmp(argv[a], "gain") == 0 ? 2 : std::strcmp(argv[a], "i_biasb") == 0 ? 1 : 0);
    }
    for (const auto& set : sets) {
        calibration.trims.clear();
        std::string names;
        for (const int k : set) {
            const auto& name = trims[k];
            // Ranges: i_leak 100 %, i_biasb 25 %, the gain 50 % of a number of columns.
            auto trim = trim_of(calibration.netlist, calibration.overrides, name, k == 0 ? 1.0 : k == 1 ? 0.25 : 0.5, k == 2);
            if (!trim) return fail(trim.error());
            names += (names.empty() ? "" : ", ") + name[0];
            calibration.trims.push_back(*trim);
        }
        const auto all = calibrate(calibration, chips);
        if (!all) return fail(all.error());
        std::vector<int> within(static_cast<std::size_t>(bits) + 1);  // number of chips within the limits, by number of bits
        int total = 0, max_presses = 0, diverged = 0;
        for (const auto& c : *all) {
            total += c.presses, max_presses = std::max(max_presses, c.presses), diverged += c.diverged;
            for (int b = 0; b <= bits; ++b) within[static_cast<std::size_t>(b)] += c.bits >= 0 && c.bits <= b;
        }
        fmt::print("{}: within limits untrimmed {}", names, within[0]);
        for (int b = 1; b <= bits; ++b) fmt::print(", {} bits {}", b, within[static_cast<std::size_t>(b)]);
        fmt::print("; {} presses, at most {} per chip, {} did not converge\n", total, max_presses, diverged);
        std::fflush(stdout);
        if (set.size() == 3)
            for (std::size_t k = 0; k < all->size(); ++k) {
                const auto& c = (*all)[k];
                fmt::print("  chip {:4} {} spikes -> {} with {} bits, codes {}, distance {:.2f} -> {:.2f}, {} presses\n", k,
                           c.spikes_before.size(), c.spikes.size(), c.bits, fmt::join(c.codes.back(), " "), c.distance.front(),
                           c.distance.back(), c.presses);
            }
    }
}
