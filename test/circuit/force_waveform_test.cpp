// The force waveform of a circuit: its values, and the samples that become breakpoints.

#include "circuit/afferent/force_waveform.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <functional>

#include "support/property.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double T = 1e-3;  // sample period, s

std::vector<double> sampled(std::size_t count, const std::function<double(double)>& force) {
    std::vector<double> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(force(static_cast<double>(k) * T));
    return out;
}

ForceWaveform force_waveform_of(std::span<const double> force) {
    ForceWaveform out(T);
    out.append(force);
    return out;
}

/// Sample indices of the breakpoints.
std::vector<long> breakpoints(const ForceWaveform& waveform) {
    std::vector<long> out;
    for (double t = waveform.next_breakpoint(-1); std::isfinite(t); t = waveform.next_breakpoint(t)) out.push_back(std::lround(t / T));
    return out;
}

TEST(ForceWaveform, IsLinearBetweenSamplesAndConstantBeforeAndAfterThem) {
    const auto waveform = force_waveform_of(std::vector<double>{1, 2, 4});
    for (const auto& [t, force] : {std::pair{-1.0, 1.0}, {0.0, 1.0}, {0.5, 1.5}, {1.0, 2.0}, {1.75, 3.5}, {2.0, 4.0}, {9.0, 4.0}})
        EXPECT_DOUBLE_EQ(waveform.at(t * T), force) << t;
    EXPECT_EQ(ForceWaveform(T).at(0.5), 0);
}

TEST(ForceWaveform, AConstantForceAndARampHaveNoBreakpoint) {
    EXPECT_EQ(breakpoints(force_waveform_of(sampled(1000, [](double) { return 2.5; }))), std::vector<long>{});
    EXPECT_EQ(breakpoints(force_waveform_of(sampled(1000, [](double t) { return 1 + 3 * t; }))), std::vector<long>{});
}

TEST(ForceWaveform, JumpsAndStartsOfRampsAreBreakpoints) {
    EXPECT_EQ(breakpoints(force_waveform_of(sampled(300, [](double t) { return t < 0.0995 ? 0.0 : 1.0; }))), (std::vector<long>{99, 100}));
    EXPECT_EQ(breakpoints(force_waveform_of(sampled(300, [](double t) { return t < 0.1    ? 0.0
                                                                               : t < 0.15 ? (t - 0.1) / 0.05
                                                                                          : 1.0; }))),
              (std::vector<long>{100, 150}));
    EXPECT_EQ(breakpoints(force_waveform_of(sampled(300, [](double t) { return std::abs(t - 0.1) < 0.0005 ? 1.0 : 0.0; }))),
              (std::vector<long>{99, 100, 101}));
}

TEST(ForceWaveform, ASmoothForceHasFarFewerBreakpointsThanSamplesAndIsResolved) {
    constexpr double pi = 3.141592653589793;
    const auto sine = force_waveform_of(sampled(1000, [](double t) { return 1 - std::cos(2 * pi * 20 * t); }));
    const auto at = breakpoints(sine);
    EXPECT_GT(at.size(), 20 * 4U);   // each cycle is resolved ...
    EXPECT_LT(at.size(), 20 * 30U);  // ... in fewer than its 50 samples
    const auto bump = force_waveform_of(sampled(1000, [](double t) { return std::exp(-std::pow((t - 0.5) / 0.01, 2)); }));
    EXPECT_LT(bump.next_breakpoint(0.45), 0.49);  // its start is detected
}

TEST(ForceWaveform, DoesNotDependOnTheSizeOfItsBlocks) {
    EXPECT_TRUE(rc::check([] {
        const auto steps = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-3, 4));
        std::vector<double> force = {1};
        for (const int s : steps) force.push_back(s == 3 ? force.back() * 2 - 1 : force.back() + 0.01 * s);
        const auto complete = force_waveform_of(force);
        ForceWaveform parts(T);
        std::vector<double> numbers;
        for (std::size_t from = 0; from < force.size();) {
            const auto count = std::min(force.size() - from, *rc::gen::inRange<std::size_t>(1, 9));
            parts.append(std::span(force).subspan(from, count));
            from += count;
            RC_ASSERT(parts.known_until() >= (static_cast<double>(from) - 1 - ForceWaveform::lookahead) * T);
            numbers.clear();
            StateArchive writer(numbers);
            parts.archive(writer);
            parts = ForceWaveform(T);
            StateArchive reader(std::span<const double>{numbers});
            parts.archive(reader);
            RC_ASSERT(reader.is_valid && reader.rest() == 0);
        }
        RC_ASSERT(breakpoints(parts) == breakpoints(complete));
        parts.discard_before(parts.known_until() / 2);
        for (double t = parts.known_until() / 2; t < parts.known_until(); t += 0.3 * T) {
            RC_ASSERT(parts.at(t) == complete.at(t));
            RC_ASSERT(parts.next_breakpoint(t) == complete.next_breakpoint(t));
        }
    }));
}

TEST(ForceWaveform, AcceptsAnyTime) {
    ForceWaveform waveform(1e-4);
    waveform.append(std::vector<double>{1, 2, 3});
    for (const double t : {1e303, -1e303, 1e20, std::nan("")}) {
        (void)waveform.at(t);
        waveform.discard_before(t);
    }
    EXPECT_EQ(waveform.at(2e-4), 3);
}

}  // namespace
}  // namespace corpuscle::circuit
