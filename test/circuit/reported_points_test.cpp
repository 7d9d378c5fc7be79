// Transients of random circuits: every reported point, and the straight line to the next point, agrees with a run at a thousandth of the
// tolerances.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "circuit/random_circuits.hpp"

namespace corpuscle::circuit {
namespace {

struct NetlistKind {
    const char* name;
    int count;
    std::string (*make)(RandomSource&);
};

constexpr double stop_time = 3e-3;  // s

/// fmt::format() with arguments evaluated from left to right by every compiler, like an initializer list. This keeps the circuits the same.
struct Text {
    std::string text;
    template <class... A>
    explicit Text(std::string_view format, const A&... values) : text(fmt::format(fmt::runtime(format), values...)) {}
};

std::string waveform(RandomSource& dice, double low, double high) {
    const double middle = (low + high) / 2, swing = (high - low) / 2;
    switch (dice.index_below(4)) {
        case 0:
            return Text{"sin({:g} {:g} {:g})", middle, swing, dice.log_uniform(300, 5e3)}.text;
        case 1:
            return Text{"pulse({:g} {:g} {:g} {:g} {:g} {:g} {:g})",
                        low,
                        high,
                        dice.uniform_between(0, 3e-4),
                        dice.log_uniform(1e-7, 1e-4),
                        dice.log_uniform(1e-7, 1e-4),
                        dice.uniform_between(2e-4, 5e-4),
                        dice.uniform_between(8e-4, 2e-3)}
                .text;
        case 2:
            return Text{"pwl(0 {:g} {:g} {:g} {:g} {:g} {:g} {:g})",
                        low,
                        dice.uniform_between(1e-4, 5e-4),
                        high,
                        dice.uniform_between(6e-4, 1e-3),
                        dice.uniform_between(low, high),
                        dice.uniform_between(1.2e-3, 2e-3),
                        low}
                .text;
        default:
            return Text{"exp({:g} {:g} {:g} {:g} {:g} {:g})",
                        low,
                        high,
                        dice.uniform_between(1e-4, 5e-4),
                        dice.log_uniform(1e-5, 1e-3),
                        dice.uniform_between(1e-3, 2e-3),
                        dice.log_uniform(1e-5, 1e-3)}
                .text;
    }
}

/// A resistor or a diode connects each node to an earlier one; clamps, capacitors and loads are optional.
std::string diodes(RandomSource& dice) {
    const int nodes = 3 + dice.index_below(4);
    const double volts = dice.log_uniform(0.3, 10);
    std::string out = Text{"random diodes\nv1 n1 0 {}\n", waveform(dice, dice.index_below(2) ? -volts : 0, volts)}.text;
    for (int k = 2; k <= nodes; ++k) {
        const int from = 1 + dice.index_below(k - 1), direction = dice.index_below(3);
        if (direction == 0)
            out += Text{"r{} n{} n{} {:g}\n", k, from, k, dice.log_uniform(1e3, 1e6)}.text;
        else
            out += Text{"d{} n{} n{} d\nr{} n{} n{} {:g}\n", k, direction == 1 ? from : k, direction == 1 ? k : from, k, from, k,
                        dice.log_uniform(1e6, 1e8)}
                       .text;
        if (dice.index_below(2)) out += Text{"rl{} n{} 0 {:g}\n", k, k, dice.log_uniform(1e3, 1e7)}.text;
        if (dice.index_below(2)) out += Text{"c{} n{} 0 {:g}\n", k, k, dice.log_uniform(1e-14, 1e-7)}.text;
        if (dice.index_below(4) == 0)
            out += Text{"cx{} n{} n{} {:g}\n", k, k, 1 + dice.index_below(k - 1), dice.log_uniform(1e-13, 1e-8)}.text;
        if (dice.index_below(4) == 0) out += Text{"dc{} n{} 0 d\n", k, k}.text;
        if (dice.index_below(4) == 0) out += Text{"dg{} 0 n{} d\n", k, k}.text;
    }
    return out + Text{".model d d(is={:g} n={:g} cjo={:g})\n", dice.log_uniform(1e-16, 1e-10), dice.uniform_between(1, 2),
                      dice.index_below(2) ? 0 : dice.log_uniform(1e-14, 1e-11)}
                     .text;
}

/// A chain of inverters, loaded stages, followers and pass transistors at a supply of 0.7 V. Most charges are the transistors' own.
std::string transistors(RandomSource& dice) {
    const int nodes = 3 + dice.index_below(3);
    std::string out = Text{"random transistors\n.lib 'tsmc180.lib' tt\nvdd vdd 0 0.7\nv1 n1 0 {}\n", waveform(dice, 0, 0.7)}.text;
    const auto size = [&] { return Text{"w={:.3g}u l={:.3g}u", dice.uniform_between(0.4, 6), dice.uniform_between(0.4, 2)}.text; };
    for (int k = 2; k <= nodes; ++k) {
        const int from = 1 + dice.index_below(k - 1), other = 1 + dice.index_below(k - 1);
        switch (dice.index_below(5)) {
            case 0:
            case 1:
                out += Text{"mp{0} n{0} n{1} vdd vdd pch {2}\nmn{0} n{0} n{1} 0 0 nch {3}\n", k, from, size(), size()}.text;
                break;
            case 2:
                out += Text{"mn{0} n{0} n{1} 0 0 nch {2}\nr{0} vdd n{0} {3:g}\n", k, from, size(), dice.log_uniform(1e5, 1e8)}.text;
                break;
            case 3:
                out += Text{"mn{0} vdd n{1} n{0} 0 nch {2}\nr{0} n{0} 0 {3:g}\n", k, from, size(), dice.log_uniform(1e5, 1e8)}.text;
                break;
            default:
                out += Text{"mn{0} n{1} n{2} n{0} 0 nch {3}\nr{0} n{0} 0 {4:g}\n", k, from, other, size(), dice.log_uniform(1e6, 1e9)}.text;
        }
        if (dice.index_below(3) == 0) out += Text{"c{} n{} 0 {:g}\n", k, k, dice.log_uniform(1e-16, 1e-11)}.text;
    }
    return out;
}

/// A run as a polyline, with the range of each unknown in a time window.
class Polyline {
    const TransientPoints& points_;

public:
    explicit Polyline(const TransientPoints& points) : points_(points) {}
    double at(double t, std::size_t n) const {
        const auto& all = points_.t;
        const auto after = static_cast<std::size_t>(std::upper_bound(all.begin(), all.end(), t) - all.begin());
        if (after == 0) return points_.x.front()[n];
        if (after == all.size()) return points_.x.back()[n];
        const double fraction = (t - all[after - 1]) / (all[after] - all[after - 1]);
        return points_.x[after - 1][n] + fraction * (points_.x[after][n] - points_.x[after - 1][n]);
    }
    /// Distance of x from the range of unknown n within +-slack (s) of t.
    double distance(double t, std::size_t n, double x, double slack) const {
        double low = at(t - slack, n), high = low;
        const auto extend = [&](double y) { low = std::min(low, y), high = std::max(high, y); };
        extend(at(t + slack, n)), extend(at(t, n));
        const auto& all = points_.t;
        for (auto k = std::lower_bound(all.begin(), all.end(), t - slack); k != all.end() && *k <= t + slack; ++k)
            extend(points_.x[static_cast<std::size_t>(k - all.begin())][n]);
        return std::max({low - x, x - high, 0.0});
    }
};

/// Largest error of all points, relative to 10 reltol times the range of the unknown, plus a floor. `where` describes that point.
double worst_point(const TransientRunner& circuit, const TransientPoints& run, const TransientPoints& fine, const TransientPlan& plan,
                   std::string& where) {
    const double slack = plan.reltol * stop_time / 50;  // s; a jump may be a line of this duration
    const Polyline reference(fine);
    const auto count = static_cast<std::size_t>(circuit.system().size());
    std::vector<double> low = fine.x[0], high = fine.x[0];
    for (const auto& x : fine.x)
        for (std::size_t n = 0; n < count; ++n) low[n] = std::min(low[n], x[n]), high[n] = std::max(high[n], x[n]);
    double largest = 0;
    for (std::size_t n = 0; n < count; ++n)
        if (!circuit.system().is_voltage(static_cast<int>(n))) largest = std::max({largest, std::abs(low[n]), std::abs(high[n])});
    double worst = 0;
    for (std::size_t k = 1; k < run.t.size(); ++k)
        for (const double fraction : {0.5, 1.0})
            for (std::size_t n = 0; n < count; ++n) {
                const double t = run.t[k - 1] + fraction * (run.t[k] - run.t[k - 1]);
                const double x = run.x[k - 1][n] + fraction * (run.x[k][n] - run.x[k - 1][n]);
                const bool voltage = circuit.system().is_voltage(static_cast<int>(n));
                const double floor = 10 * (voltage ? plan.vntol : plan.abstol + 1e-9 * largest);
                const double error = reference.distance(t, n, x, slack) / (10 * plan.reltol * (high[n] - low[n]) + floor);
                if (error > worst)
                    worst = error,
                    where = fmt::format("{} is {:.9g} at {:.9g} s{}, and {:.9g} by the finer run", circuit.system().names()[n], x, t,
                                        fraction < 1 ? " (between points)" : "", reference.at(t, n));
            }
    return worst;
}

class ReportedPoints : public testing::TestWithParam<NetlistKind> {};

TEST_P(ReportedPoints, AgreeWithAFinerRun) {
    const auto kind = GetParam();
    for (int k = 0; k < kind.count; ++k) {
        RandomSource dice(static_cast<std::uint64_t>(1000 + k));
        const auto text = kind.make(dice) + fmt::format(".tran 1u {:g}\n", stop_time);
        const auto circuit = TransientRunner::from_text(text);
        TransientPlan plan;
        plan.all_reported = true;
        auto finer = plan;
        for (double* tolerance : {&finer.reltol, &finer.vntol, &finer.abstol}) *tolerance /= 1000;
        const auto run = circuit.run(plan), fine = circuit.run(finer);
        ASSERT_EQ(run.error + fine.error, "") << kind.name << " " << k << "\n" << text;
        std::string where;
        const double worst = worst_point(circuit, run, fine, plan, where);
        if (std::getenv("CORPUSCLE_SHOW"))
            std::printf("%s %d: %.2f, %ld steps, %ld rejected, %ld iterations; finer %ld; %s\n", kind.name, k, worst, run.stats.steps,
                        run.stats.rejected, run.stats.iterations, fine.stats.steps, where.c_str());
        EXPECT_LE(worst, 1) << kind.name << " " << k << ": " << where << "\n" << text;
        EXPECT_LT(fine.stats.steps, 100'000) << kind.name << " " << k << ": rounding rejects steps\n" << text;
    }
}

INSTANTIATE_TEST_SUITE_P(RandomDevice, ReportedPoints,
                         testing::Values(NetlistKind{"Diodes", 60, diodes}, NetlistKind{"Transistors", 60, transistors}),
                         [](const auto& one) { return std::string(one.param.name); });

/// The phase of an oscillator drifts, so only its period and amplitude are compared.
TEST(ReportedOscillation, HasThePeriodOfAFinerRun) {
    const auto ring = [](const std::string& options) {
        std::string text = "ring\n.lib 'tsmc180.lib' tt\nvdd vdd 0 0.7\n.options " + options + "\n.ic v(n0)=0\n";
        for (int k = 0; k < 5; ++k)
            text += fmt::format("mp{0} n{1} n{0} vdd vdd pch w=1.5u l=0.5u\nmn{0} n{1} n{0} 0 0 nch w=0.5u l=0.5u\n", k, (k + 1) % 5);
        return run_netlist(text +
                           ".tran 1n 0.3u\n.meas tran period trig v(n0)=0.35 rise=3 targ v(n0)=0.35 rise=13\n"
                           ".meas tran high max v(n0)\n.meas tran low min v(n0)\n");
    };
    const auto standard = ring("accuracy=normal"), fine = ring("reltol=1e-8 vntol=1e-9");
    EXPECT_NEAR(standard.number("period"), fine.number("period"), 1e-3 * fine.number("period"));
    EXPECT_NEAR(standard.number("high"), fine.number("high"), 1e-3);
    EXPECT_NEAR(standard.number("low"), fine.number("low"), 1e-3);
}

}  // namespace
}  // namespace corpuscle::circuit
