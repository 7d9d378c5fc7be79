// The analog-to-digital converter: its codes, its table of the force of each code, and the conversion times.

#include <cmath>

#include "model/components.hpp"
#include "model/sensor/digital_afferent.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(Converter, RoundsToTheNearestLevelAndSaturatesAtBothEnds) {
    const Converter adc(FrontEnd({}, 1), {{"bits", 3}, {"F_low", 0}, {"F_high", 7}});
    for (const double F : {0.0, 0.49, 0.5, 3.49, 3.5, 6.9, 7.0, 7.49}) {
        EXPECT_EQ(adc.convert(F).code, static_cast<std::int64_t>(F + 0.5)) << F;
        EXPECT_FALSE(adc.convert(F).saturated) << F;
    }
    EXPECT_EQ(adc.convert(7.5).code, 7);
    EXPECT_TRUE(adc.convert(7.5).saturated);
    EXPECT_EQ(adc.convert(-0.51).code, 0);
    EXPECT_TRUE(adc.convert(-0.51).saturated);
}

TEST(Converter, TheTableInvertsTheCurveToWithinOneCode) {
    const FrontEnd front({Fsr::stage({}), F2v::stage({})}, 4);
    const Converter adc(front, {{"bits", 10}});
    for (double F = 0; F < 5; F += 0.0137) {
        const auto [code, clipped] = adc.convert(F);
        EXPECT_FALSE(clipped);
        EXPECT_GE(F, adc.force(std::max<std::int64_t>(code - 1, 0)));
        EXPECT_LE(F, adc.force(std::min(code + 1, adc.max_code())));
        EXPECT_EQ(adc.convert(adc.force(code)).code, code);
    }
    EXPECT_EQ(adc.force(0), 0);
    EXPECT_EQ(adc.force(adc.max_code()), 5);
}

TEST(Converter, WithoutTheTableItUsesTheCalibrationLine) {
    const FrontEnd front({Fsr::stage({}), F2v::stage({})}, 4);
    const Converter line(front, {{"bits", 16}, {"linearise", 0}});
    for (const double F : {0.0, 0.5, 1.0, 3.0, 4.0, 4.5})
        EXPECT_NEAR(line.force(line.convert(F).code), front.calibrated_force(front.read(F).value), 1e-4) << F;
}

TEST(ConversionTimes, AreExactFractions) {
    EXPECT_TRUE(rc::check("any two rates, any channel slot", [] {
        const auto source = *rc::gen::inRange<std::int64_t>(1, 50000), adc = *rc::gen::inRange<std::int64_t>(1, 50000);
        const auto slots = *rc::gen::inRange<std::uint32_t>(1, 100), channel = *rc::gen::inRange<std::uint32_t>(0, slots);
        const ConversionTimes instants(static_cast<double>(source), static_cast<double>(adc), slots);
        auto at = instants.first(channel);
        for (std::int64_t j = 0; j < 200; ++j, instants.advance(at)) {
            const std::int64_t numerator = (j * slots + channel) * source,
                               denominator = adc * slots;  // of the exact time of conversion j, in samples of the source
            RC_ASSERT(at.step == numerator / denominator);
            RC_ASSERT(at.remainder * denominator == (numerator % denominator) * instants.parts_per_sample());
        }
    }));
}

TEST(DigitalAfferent, SpikesOccurAtConversionTimesForAnySourceRate) {
    const auto fine = test::train("adc+sa1", "press", {.rate = 10e3}), coarse = test::train("adc+sa1", "press", {.rate = 4e3});
    EXPECT_EQ(fine, coarse) << "both rates have samples at the conversion times";
    for (const double t : fine) EXPECT_NEAR(t * 1e3, std::round(t * 1e3), 1e-9);
    for (const double t : test::train("adc+sa1", "press", {.settings = {"adc+sa1.f_s=700Hz"}, .rate = 3e3}))
        EXPECT_NEAR(t * 700, std::round(t * 700), 1e-9) << "between samples";
}

TEST(DigitalAfferent, ASharedConverterSamplesTheChannelsInTurn) {
    std::vector<double> ramp;
    for (int k = 0; k < 4000; ++k) ramp.push_back(1e-3 * k);
    const auto ramp_spikes = [&](const char* shared, ChannelSlot slot) {
        const auto a = test::afferent("adc+sa1", {.settings = {std::string("adc+sa1.shared=") + shared}, .rate = 1e3});
        std::vector<Spike> out;
        ResponseBlock response{out};
        auto state = a->start(slot);
        EXPECT_TRUE(a->respond(ramp, state, response));
        return out;
    };
    const auto separate = ramp_spikes("0", {3, 4}), first = ramp_spikes("1", {0, 4}), last = ramp_spikes("1", {3, 4});
    ASSERT_FALSE(separate.empty());
    EXPECT_EQ(separate, first) << "with one converter per channel there is no delay";
    for (const auto& s : separate) EXPECT_EQ(s.offset, 1);
    for (const auto& s : last) EXPECT_EQ(s.offset, 0.75) << "channel 3 of 4 waits three quarters of a conversion";
}

TEST(DigitalAfferent, SaturatedConversionsAreCounted) {
    std::vector<Spike> out;
    ResponseBlock response{out};
    const auto a = test::afferent("adc+sa1", {.rate = 10e3});
    auto state = a->start();
    std::vector<double> f(10000, 1.0);
    std::fill(f.begin() + 1001, f.begin() + 2001, 6.0);
    EXPECT_TRUE(a->respond(f, state, response));
    EXPECT_EQ(response.saturated, 100) << "at 1 kHz, a tenth of the samples";
}

TEST(DigitalAfferent, DamagedStatesAreRefused) {
    const auto a = test::afferent("fa1-lee");
    const std::vector<double> f(10, 1.0);
    const auto fresh = a->start();
    for (std::size_t v = 0; v < fresh.values.size(); ++v)
        for (const double bad : {0.5, -3.0, 1e300, std::nan("")}) {
            if (v == 4 || v == 5) continue;  // these values are forces, for which any number is valid
            auto state = fresh;
            state.values[v] = bad;
            if (v >= 7 && bad == -3) continue;  // these values are words, for which -3 is valid
            std::vector<Spike> out;
            ResponseBlock response{out};
            EXPECT_FALSE(a->respond(f, state, response)) << v << ' ' << bad;
        }
}

}  // namespace
}  // namespace corpuscle
