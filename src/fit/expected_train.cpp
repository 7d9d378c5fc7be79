#include "fit/expected_train.hpp"

#include <algorithm>

#include "run/simulate.hpp"

namespace corpuscle {

Result<std::vector<double>> simulated_train(const AfferentPlan& plan, const SpikeRecording& r, SimulationOptions options, double noise,
                                            std::uint64_t seed) {
    options.dt = r.clock.T(), options.noise = noise, options.seed = seed;
    const auto response = TRY(simulate(*make_afferent(plan, options), r.force));
    return spike_times(response.spikes, r.clock);
}

Result<ExpectedTrain> expected_train(const AfferentPlan& plan, const SpikeRecording& r, const SimulationOptions& options,
                                     std::size_t realisations, std::uint64_t seed) {
    ExpectedTrain out{{}, static_cast<double>(realisations)};
    for (std::size_t k = 0; k < realisations; ++k) {
        const auto train = TRY(simulated_train(plan, r, options, 0, seed + k));
        out.times.insert(out.times.end(), train.begin(), train.end());
    }
    std::sort(out.times.begin(), out.times.end());
    return out;
}

}  // namespace corpuscle
