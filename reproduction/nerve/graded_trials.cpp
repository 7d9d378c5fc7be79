#include "reproduction/nerve/graded_trials.hpp"

#include <algorithm>
#include <cmath>

#include "model/lane_population.hpp"

namespace corpuscle {

Result<std::vector<std::vector<double>>> simulate_factors(const TrialSpec& spec, std::span<const double> factors) {
    constexpr std::size_t block = 1000;  // samples
    const auto trial = TRY(trial_force(spec));
    const auto overrides = TRY(parse_overrides(spec.settings));
    const auto planned = TRY(plan_afferent(spec.afferent, overrides));
    const auto set = TRY(instruction_set());
    const AfferentPlan* const plans[] = {&planned.result};
    const auto population = TRY(make_lane_population({.plans = plans, .size = factors.size()}, {trial.clock.T(), spec.method, spec.sampled}, set));
    ThreadPool one_thread(1);
    std::vector<std::vector<double>> out(factors.size());
    std::vector<Spike> spikes;
    for (std::size_t k = 0; k < trial.force.size(); k += block, spikes.clear()) {
        const auto steps = std::min(block, trial.force.size() - k);
        PopulationResponse response{&spikes};
        TRY(population->respond(ForceProfile{std::span(trial.force).subspan(k, steps), factors}, steps, response, one_thread));
        for (const auto& s : spikes) out[s.afferent_index].push_back(trial.clock.time(s.step, s.offset));
    }
    return out;
}

std::vector<double> geometric_series(double low, double high, double step) {
    const auto count = static_cast<int>(std::ceil(std::log(high / low) / std::log(step) - 1e-9)) + 1;
    std::vector<double> out;
    for (int k = 0; k < count; ++k) out.push_back(low * std::pow(step, k));
    return out;
}

}  // namespace corpuscle
