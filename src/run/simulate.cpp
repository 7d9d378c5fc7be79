#include "run/simulate.hpp"

#include <algorithm>
#include <utility>

namespace corpuscle {
namespace {

constexpr std::size_t simulated_block = 4096;  // samples

}  // namespace

std::vector<double> padded_block(std::span<const double> force, std::size_t first, std::size_t count, std::size_t delay) {
    const auto available = force.subspan(first, std::min(count + delay, force.size() - first));
    std::vector<double> out(available.begin(), available.end());
    out.resize(count + delay, force.back());
    return out;
}

Result<void> AfferentSimulation::respond(std::span<const double> force, ResponseBlock& response) {
    // The response to the first delay_ samples would lie before the force, so nothing of it is recorded.
    if (delay_ > 0 && !std::exchange(has_started_, true)) {
        const auto probes = std::exchange(response.probes, {});
        const auto range_violations = std::exchange(response.range_violations, {});
        TRY(afferent_.respond(force.first(delay_), state_, response));
        response.probes = probes, response.range_violations = range_violations;
    }
    return afferent_.respond(force.subspan(delay_), state_, response);
}

Result<AfferentResponse> simulate(const Afferent& afferent, std::span<const double> force, const SimulateOptions& options) {
    const auto delay = static_cast<std::size_t>(afferent.delay());
    std::vector<std::vector<double>> values(options.probes.empty() ? 0 : afferent.probes().size(), std::vector<double>(simulated_block));
    std::vector<double*> arrays;
    for (auto& v : values) arrays.push_back(v.data());
    AfferentResponse out{
        {}, std::vector<std::vector<double>>(options.probes.size()), std::vector<RangeViolation>(afferent.ranges().size())};
    ResponseBlock response{out.spikes, 0, arrays, out.range_violations};
    response.should_stop = options.stop;
    AfferentSimulation simulation(afferent);
    for (std::size_t first = 0; first < force.size(); first += simulated_block) {
        if (options.stop && options.stop()) return interrupted_error();
        const auto count = std::min(simulated_block, force.size() - first);
        TRY(simulation.respond(padded_block(force, first, count, delay), response));
        for (std::size_t p = 0; p < options.probes.size(); ++p)
            for (std::size_t k = (options.every - first % options.every) % options.every; k < count; k += options.every)
                out.probes[p].push_back(values[options.probes[p]][k]);
    }
    return out;
}

}  // namespace corpuscle
