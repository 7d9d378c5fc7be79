// The lowest sampling rate that a calibrated class names: there its spikes are those of 10 kHz, in the band in which it is most sensitive.

#include <cmath>
#include <numbers>

#include "model/catalog.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

/// The number of spikes in a second of vibration on 0.5 N that grows over 0.2 s, sampled at this rate.
double spikes_of_vibration(const AfferentPlan& plan, double frequency, double amplitude, double rate) {
    std::vector<double> force(static_cast<std::size_t>(rate));
    for (std::size_t k = 0; k < force.size(); ++k) {
        const double t = static_cast<double>(k) / rate;
        force[k] = 0.5 + std::min(1.0, t / 0.2) * amplitude * std::sin(2 * std::numbers::pi * frequency * t + 0.3);
    }
    SimulationOptions options;
    options.dt = 1 / rate;
    const auto afferent = make_afferent(plan, options);
    auto state = afferent->start();
    std::vector<Spike> found;
    ResponseBlock response{found};
    EXPECT_TRUE(afferent->respond(force, state, response));
    return static_cast<double>(found.size());
}

TEST(SamplingRate, AtTheLowestRateOfAClassItFiresAsAtTenKilohertz) {
    struct Case {
        const char* afferent;
        std::vector<double> frequencies;  // Hz
    };
    const Case cases[] = {{"fa1-nerve", {10, 20, 40, 80}}, {"fa2", {100, 200, 250}}};
    for (const auto& c : cases) {
        const auto plan = test::value_or_throw(plan_afferent(c.afferent));
        for (const double f : c.frequencies) {
            // At an amplitude where a second spike in each cycle begins, counts differ at any rate, so the sum over amplitudes is compared.
            double difference = 0, all = 0;
            for (double amplitude = 2e-3; amplitude < 0.5; amplitude *= 1.3) {
                const double fine = spikes_of_vibration(plan, f, amplitude, 10e3);
                difference += std::abs(spikes_of_vibration(plan, f, amplitude, plan.min_rate) - fine), all += fine;
            }
            EXPECT_LE(difference, 0.08 * all) << c.afferent << ' ' << f << " Hz";
        }
    }
}

}  // namespace
}  // namespace corpuscle
