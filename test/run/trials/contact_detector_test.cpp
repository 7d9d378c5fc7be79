// Contact onsets: closed forms on ramps, with and without noise.

#include "run/trials/contact_detector.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

const Clock clock_1kHz{1000, 1, 0};

/// A press: a ramp of `slope` N/s from `onset` s to `force` N, held until `release` s, then a step to 0.
double press_at(double t, double onset, double slope, double force, double release) {
    return t < onset || t >= release ? 0 : std::min(slope * (t - onset), force);
}

std::vector<double> sampled(double seconds, const std::function<double(double)>& force) {
    std::vector<double> out;
    for (int k = 0; k < seconds * 1000; ++k) out.push_back(force(k / 1000.0));
    return out;
}

TEST(ContactDetector, FindsWhereARampCrossesAGivenThreshold) {
    EXPECT_TRUE(rc::check("onset + threshold / slope", [] {
        const double onset = 0.001 * *rc::gen::inRange(50, 400) + 0.0003, slope = *rc::gen::inRange(1, 40);
        const auto found = find_contacts(sampled(1, [&](double t) { return press_at(t, onset, slope, 2, 0.9); }), clock_1kHz, 0.25);
        RC_ASSERT(found.contacts.size() == 1U);
        RC_ASSERT(std::abs(found.contacts[0].onset - (onset + 0.25 / slope)) < 1e-3);  // the corner of the ramp is between two samples
        if (0.25 / slope > 2e-3) RC_ASSERT(std::abs(found.contacts[0].onset - (onset + 0.25 / slope)) < 1e-9);
        RC_ASSERT(std::abs(found.contacts[0].release - 0.9) < 1e-9);
    }));
}

TEST(ContactDetector, TakesItsThresholdFromTheNoiseAtRest) {
    const double deviation = 0.02, slope = 10;
    std::uint32_t k = 0;
    const auto force = sampled(20, [&](double t) {
        const double cycle = std::fmod(t, 2);
        return press_at(cycle, 1, slope, 3, 1.6) + 0.4 + deviation * normal_pair(7, k++, 0, 0).first;
    });
    const auto found = find_contacts(force, clock_1kHz);
    EXPECT_NEAR(found.level, 0.4, 0.002);
    EXPECT_NEAR(found.noise, deviation, 0.1 * deviation) << "some samples of the ramps count as rest";
    EXPECT_NEAR(found.threshold, found.level + 5 * found.noise, 1e-12);
    EXPECT_NEAR(found.release, found.level + 2.5 * found.noise, 1e-12);
    ASSERT_EQ(found.contacts.size(), 10U) << "noise alone neither begins nor ends a contact";
    for (std::size_t n = 0; n < 10; ++n) {
        const double crossing = 2.0 * static_cast<double>(n) + 1 + (found.threshold - 0.4) / slope;
        EXPECT_NEAR(found.contacts[n].onset, crossing, 3 * deviation / slope + 1e-3);
        EXPECT_NEAR(found.contacts[n].release, 2.0 * static_cast<double>(n) + 1.6, 2e-3);
    }
}

TEST(ContactDetector, UsesAFractionOfTheRiseWithoutNoise) {
    const auto found = find_contacts(sampled(1, [](double t) { return press_at(t, 0.4, 10, 2, 0.8); }), clock_1kHz);
    EXPECT_EQ(found.noise, 0);
    EXPECT_NEAR(found.threshold, min_rise_of_contact * 2, 1e-12);
    EXPECT_EQ(found.contacts.size(), 1U);
}

TEST(ContactDetector, JoinsShortPausesAndDropsShortContacts) {
    const auto pulse = [](double t, double from, double to) { return t >= from && t < to ? 1.0 : 0.0; };
    const auto joined = find_contacts(sampled(1, [&](double t) { return pulse(t, 0.2, 0.3) + pulse(t, 0.34, 0.5); }), clock_1kHz, 0.5);
    ASSERT_EQ(joined.contacts.size(), 1U);
    EXPECT_NEAR(joined.contacts[0].release, 0.5, 1e-9);
    const auto apart = find_contacts(sampled(1, [&](double t) { return pulse(t, 0.2, 0.3) + pulse(t, 0.36, 0.5); }), clock_1kHz, 0.5);
    EXPECT_EQ(apart.contacts.size(), 2U);
    const auto brief = find_contacts(sampled(1, [&](double t) { return pulse(t, 0.2, 0.21) + pulse(t, 0.5, 0.53); }), clock_1kHz, 0.5);
    ASSERT_EQ(brief.contacts.size(), 1U);
    EXPECT_NEAR(brief.contacts[0].onset, 0.4995, 1e-9) << "half way between two samples";
}

TEST(ContactDetector, LeavesOutAContactThatBeganBeforeTheRecording) {
    const auto found = find_contacts(sampled(1, [](double t) { return t < 0.2 || t >= 0.7 ? 1.0 : 0.0; }), clock_1kHz, 0.5);
    ASSERT_EQ(found.contacts.size(), 1U);
    EXPECT_NEAR(found.contacts[0].onset, 0.6995, 1e-9);
    EXPECT_TRUE(std::isinf(found.contacts[0].release)) << "it lasts to the end";
}

TEST(ContactDetector, FindsNothingInAConstantForceAndInNoForce) {
    EXPECT_TRUE(find_contacts(std::vector<double>(100, 1.5), clock_1kHz).contacts.empty());
    EXPECT_TRUE(find_contacts({}, clock_1kHz).contacts.empty());
}

}  // namespace
}  // namespace corpuscle
