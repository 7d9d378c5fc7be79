// Which transistors' mismatch determines the spike count of a chip? Checks the result by enlarging them.
//
//     bench-worst sa1|fa1 [CHIPS] [SEED]      default: 200 chips, seed 1
//
// Method: chips with mismatch but without process variation, each under the press. The ranks of their spike counts are correlated with the
// two normal deviates of each transistor (threshold, current), which are computed again as for the chip. A transistor's contribution is the
// sum of the squares of both correlations. The three transistors with the largest contributions get four times the area (W and L doubled),
// and the same chips run again. Output: mean and standard deviation of the spike count before and after, for each of the three transistors
// alone and for all together; and the number of chips that meet the limits around the model's response (FiringLimits::around).

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <numeric>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/device/uicm_card.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "core/thread_pool.hpp"
#include "corpuscle.hpp"
#include "sweep/subject/firing_limits.hpp"

namespace {

using namespace corpuscle;
using namespace corpuscle::circuit;
using Trains = std::vector<std::vector<double>>;  // [chip][spike], s

std::shared_ptr<const CircuitAfferentFactory> factory_of(const std::string& name, const std::vector<ParameterOverride>& overrides) {
    const auto netlist = apply_overrides(name, overrides);
    if (!netlist) std::fprintf(stderr, "%s\n", netlist.error().text().c_str()), std::exit(1);
    auto factory = CircuitAfferentFactory::create(netlist->result);
    if (!factory) std::fprintf(stderr, "%s\n", factory.error().text().c_str()), std::exit(1);
    return *factory;
}

/// Simulates all chips of this design under the press.
Trains press_chips(const std::shared_ptr<const CircuitAfferentFactory>& factory, const ChipSpec& chips, const Force& press) {
    Trains out(static_cast<std::size_t>(chips.count));
    std::mutex guard;
    std::size_t next = 0;
    BatchOptions options;
    options.max_iterations = 200'000;
    ThreadPool pool;
    pool.for_each(pool.threads(), [&](std::size_t, unsigned) {
        const auto done = run_chips(
            factory,
            [&]() -> std::optional<Chip> {
                const std::lock_guard lock(guard);
                if (next == out.size()) return {};
                const auto k = next++;
                return Chip{static_cast<std::int64_t>(k), factory, chips.sample(k), press.samples[0], 1 / press.rate};
            },
            [&](const Chip& chip, ChipResponse&& response) {
                if (response.error)
                    std::fprintf(stderr, "chip %lld: %s\n", static_cast<long long>(chip.id), response.error->text().c_str());
                out[static_cast<std::size_t>(chip.id)] = std::move(response.spikes);
            },
            options);
        if (!done) std::fprintf(stderr, "%s\n", done.error().text().c_str());
    });
    return out;
}

/// Ranks of the numbers, minus the mean of all ranks; equal numbers share their mean rank.
std::vector<double> ranks(const std::vector<double>& x) {
    std::vector<double> out;
    for (const double v : x) {
        double rank = -0.5 * static_cast<double>(x.size());
        for (const double w : x) rank += w < v ? 1 : w == v ? 0.5 : 0;
        out.push_back(rank);
    }
    return out;
}

/// Correlation of numbers with mean 0.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto product = [](const auto& u, const auto& v) { return std::inner_product(u.begin(), u.end(), v.begin(), 0.0); };
    return product(a, b) / std::sqrt(product(a, a) * product(b, b));
}

void print_statistics(const char* label, const Trains& trains, const FiringLimits& limits) {
    double sum = 0, squares = 0;
    long within = 0;
    for (const auto& t : trains) {
        const auto n = static_cast<double>(t.size());
        sum += n, squares += n * n, within += limits.are_met(t);
    }
    const auto count = static_cast<double>(trains.size());
    fmt::print("{:40} {:6.2f} spikes, standard deviation {:6.3f}; {} of {} chips are within the limits\n", label, sum / count,
               std::sqrt(squares / count - sum * sum / count / count), within, trains.size());
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || (std::strcmp(argv[1], "sa1") != 0 && std::strcmp(argv[1], "fa1") != 0))
        return std::fputs("bench-worst sa1|fa1 [CHIPS] [SEED]\n", stderr), 2;
    const std::string model = argv[1], netlist = model + "-circuit";
    const ChipSpec chips{argc > 2 ? std::atof(argv[2]) : 200, argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1, false, true};
    const auto press = stimulus("press");
    const TimeWindow phases[] = {{0, 0.25}, {0.25, 0.375}, {0.375, 0.625}, {0.625, 0.75}, {0.75, 1}};
    const auto limits = FiringLimits::around(respond(model, press).times, phases, 10e-3);
    fmt::print("{}: {}\n", netlist, limits.text());

    const auto designed = factory_of(netlist, {});
    const auto before = press_chips(designed, chips, press);
    print_statistics("as designed", before, limits);
    std::vector<double> counts;
    for (const auto& t : before) counts.push_back(static_cast<double>(t.size()));
    const auto count_ranks = ranks(counts);

    struct Contribution {
        const Element* device;
        double by_threshold, by_current;  // correlations
        double all() const { return by_threshold * by_threshold + by_current * by_current; }
    };
    std::vector<Contribution> contributions;
    UicmCard card;  // with A_VT = A_IS = 1 and an area of 1 m^2, the mismatch is the deviate itself
    card.A_VT = card.A_IS = 1;
    UicmInstance square;
    square.W = square.L = 1;
    std::uint32_t number = 0;  // index among the transistors, as in the sampling of mismatch
    for (const auto& e : designed->circuit->elements) {
        if (e.letter != 'm') continue;
        std::vector<double> threshold, current;
        for (std::size_t k = 0; k < before.size(); ++k) {
            const auto deviates = sample_mismatch(card, square, chips.seed, number, k);
            threshold.push_back(deviates.V_T), current.push_back(std::log(deviates.factor));
        }
        contributions.push_back({&e, correlation(count_ranks, threshold), correlation(count_ranks, current)});
        ++number;
    }
    std::sort(contributions.begin(), contributions.end(),
              [](const Contribution& a, const Contribution& b) { return std::pair(-a.all(), a.device) < std::pair(-b.all(), b.device); });
    std::vector<ParameterOverride> all;  // of the three
    for (std::size_t k = 0; k < 8; ++k)
        fmt::print("  {:20} threshold {:+.2f}, current {:+.2f}\n", contributions[k].device->name, contributions[k].by_threshold,
                   contributions[k].by_current);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& e = *contributions[k].device;
        std::vector<ParameterOverride> overrides;
        for (const char* dimension : {"w", "l"})
            overrides.push_back({netlist, e.name + "." + dimension, fmt::format("{:.17g}", 2 * e.values.at(dimension)), e.name});
        all.insert(all.end(), overrides.begin(), overrides.end());
        print_statistics(fmt::format("{} with four times the area", e.name).c_str(),
                         press_chips(factory_of(netlist, overrides), chips, press), limits);
    }
    const auto larger = factory_of(netlist, all);
    print_statistics("all three", press_chips(larger, chips, press), limits);
    const auto spikes_without_mismatch = [&](const std::shared_ptr<const CircuitAfferentFactory>& factory) {
        return run_chip_scalar({0, factory, {}, press.samples[0], 1 / press.rate}, {}).spikes.size();
    };
    fmt::print("without mismatch: {} spikes as designed, {} with all three\n", spikes_without_mismatch(designed),
               spikes_without_mismatch(larger));
}
