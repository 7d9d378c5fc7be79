// Transients of a thousand random oscillators and filters: each must pass its check, or fail with a correct error.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <regex>

#include "circuit/random_circuits.hpp"

namespace corpuscle::circuit {
namespace {

bool has_time_and_unknown(const std::string& message) {
    static const std::regex both(R"(at [0-9.]+ .*s: .*[vi]\(.+\))");
    return std::regex_search(message, both);
}

/// Describes the fault of a run; empty if there is none. An error must name a time and an unknown.
std::string fault_of(const RandomCircuit& random) {
    try {
        const auto circuit = TransientRunner::from_text(random.text);
        const auto points = circuit.run(random.plan);
        // A trigger's edge takes nanoseconds. After days of simulated time, a double cannot resolve it.
        if (!points.error.empty() && points.t.back() > 1e5 && has_time_and_unknown(points.error)) return "";
        if (!points.error.empty())
            return (has_time_and_unknown(points.error) ? "gave up: " : "gave up without naming a time and an unknown: ") + points.error;
        if (std::abs(points.t.back() - circuit.stop_time()) > 1e-9 * circuit.stop_time())
            return fmt::format("ended at {:g} s", points.t.back());
        for (std::size_t k = 0; k < points.t.size(); ++k)
            for (int n = 0; n < circuit.system().size(); ++n) {
                const double v = points.x[k][static_cast<std::size_t>(n)];
                const bool node = n < circuit.system().nodes();
                if (!std::isfinite(v) || (node && (v < random.min_voltage || v > random.max_voltage)))
                    return fmt::format("{} is {:g} at {:g} s, outside [{:g}, {:g}]", circuit.system().names()[static_cast<std::size_t>(n)],
                                       v, points.t[k], random.min_voltage, random.max_voltage);
            }
        return random.find_fault(circuit, points);
    } catch (const std::exception& e) {
        return std::string("did not start: ") + e.what();
    }
}

struct KindCount {
    const RandomKind* kind;
    int count;
};

class RandomTransient : public testing::TestWithParam<KindCount> {};

/// If CORPUSCLE_FAILURES names a folder, netlists that fail are written there.
TEST_P(RandomTransient, RunsAndPassesItsCheck) {
    const auto [kind, count] = GetParam();
    const char* folder = std::getenv("CORPUSCLE_FAILURES");
    for (int k = 0; k < count; ++k) {
        RandomSource dice(static_cast<std::uint64_t>(k + 1));
        const auto random = kind->make(dice);
        const auto fault = fault_of(random);
        if (fault.empty()) continue;
        ADD_FAILURE() << kind->name << " " << k << ": " << fault << "\n" << (folder ? "" : random.text);
        if (folder)
            std::ofstream(fmt::format("{}/{}_{}.cir", folder, kind->name, k))
                << fmt::format("{} {}: {}\n", kind->name, k, fault.substr(0, fault.find('\n'))) << "* " << random.text << ".end\n";
    }
}

std::vector<KindCount> kind_counts(int divisor) {
    std::vector<KindCount> out;
    for (const auto& kind : random_kinds()) out.push_back({&kind, (kind.count_per_thousand + divisor - 1) / divisor});
    return out;
}

const auto kind_name = [](const auto& info) { return std::string(info.param.kind->name); };

INSTANTIATE_TEST_SUITE_P(Few, RandomTransient, testing::ValuesIn(kind_counts(20)), kind_name);
INSTANTIATE_TEST_SUITE_P(Thousand, RandomTransient, testing::ValuesIn(kind_counts(1)), kind_name);

TEST(RandomKinds, AreAThousandCircuits) {
    int sum = 0;
    for (const auto& entry : kind_counts(1)) sum += entry.count;
    EXPECT_EQ(sum, 1000);
}

}  // namespace
}  // namespace corpuscle::circuit
