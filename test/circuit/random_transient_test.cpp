// A thousand drawn oscillators and filters, in time: each must run and be right, or say truly why not.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <regex>

#include "circuit/random_circuits.hpp"

namespace corpuscle::circuit {
namespace {

bool says_when_and_where(const std::string& sentence) {
    static const std::regex both(R"(at [0-9.]+ .*s .*[vi]\(.+\))");
    return std::regex_search(sentence, both);
}

/// What is wrong with a run; empty: nothing. An error must name a time and an unknown.
std::string complaint(const RandomCircuit& drawn) {
    try {
        const auto circuit = TransientRunner::from_text(drawn.text);
        const auto points = circuit.run(drawn.plan);
        // A trigger's edge is a matter of nanoseconds: after days, a double's digits of time are too few for it.
        if (!points.error.empty() && points.t.back() > 1e5 && says_when_and_where(points.error)) return "";
        if (!points.error.empty())
            return (says_when_and_where(points.error) ? "gave up: " : "gave up and does not say when and where: ") + points.error;
        if (std::abs(points.t.back() - circuit.stop_time()) > 1e-9 * circuit.stop_time()) return fmt::format("ended at {:g} s", points.t.back());
        for (std::size_t k = 0; k < points.t.size(); ++k)
            for (int n = 0; n < circuit.system().size(); ++n) {
                const double v = points.x[k][static_cast<std::size_t>(n)];
                const bool node = n < circuit.system().nodes();
                if (!std::isfinite(v) || (node && (v < drawn.min_voltage || v > drawn.max_voltage)))
                    return fmt::format("{} is {:g} at {:g} s, outside [{:g}, {:g}]", circuit.system().names()[static_cast<std::size_t>(n)],
                                       v, points.t[k], drawn.min_voltage, drawn.max_voltage);
            }
        return drawn.find_fault(circuit, points);
    } catch (const std::exception& e) {
        return std::string("did not begin: ") + e.what();
    }
}

struct Share {
    const RandomKind* kind;
    int count;
};

class RandomInTime : public testing::TestWithParam<Share> {};

/// CORPUSCLE_FAILURES names a folder for the netlists of those that fail.
TEST_P(RandomInTime, RunsAndIsRight) {
    const auto [kind, count] = GetParam();
    const char* folder = std::getenv("CORPUSCLE_FAILURES");
    for (int k = 0; k < count; ++k) {
        RandomSource dice(static_cast<std::uint64_t>(k + 1));
        const auto drawn = kind->make(dice);
        const auto wrong = complaint(drawn);
        if (wrong.empty()) continue;
        ADD_FAILURE() << kind->name << " " << k << ": " << wrong << "\n" << (folder ? "" : drawn.text);
        if (folder)
            std::ofstream(fmt::format("{}/{}_{}.cir", folder, kind->name, k))
                << fmt::format("{} {}: {}\n", kind->name, k, wrong.substr(0, wrong.find('\n'))) << "* " << drawn.text << ".end\n";
    }
}

std::vector<Share> shares(int divisor) {
    std::vector<Share> out;
    for (const auto& kind : random_kinds()) out.push_back({&kind, (kind.count_per_thousand + divisor - 1) / divisor});
    return out;
}

const auto named = [](const auto& one) { return std::string(one.param.kind->name); };

INSTANTIATE_TEST_SUITE_P(Few, RandomInTime, testing::ValuesIn(shares(20)), named);
INSTANTIATE_TEST_SUITE_P(Thousand, RandomInTime, testing::ValuesIn(shares(1)), named);

TEST(RandomKinds, AreAThousandCircuits) {
    int sum = 0;
    for (const auto& share : shares(1)) sum += share.count;
    EXPECT_EQ(sum, 1000);
}

}  // namespace
}  // namespace corpuscle::circuit
