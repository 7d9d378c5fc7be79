// Ten thousand slowly adapting afferents under one press. The force on each is multiplied by its own gain, from 0 to 1. For each 50 ms,
// prints the force at its end and the number of spikes of all afferents.

#include <cstdio>

#include "core/stimulus/stimuli.hpp"
#include "model/catalog.hpp"
#include "model/lane_population.hpp"

int main() {
    using namespace corpuscle;
    const auto plan = plan_afferent("sa1");
    const auto press = make_stimulus("press", 10e3, 0);
    const AfferentPlan* const plans[] = {&*plan};
    const auto population = make_lane_population({plans, 10'000}, {.dt = 1e-4}, *instruction_set());
    if (!population) return std::puts(population.error().text().c_str()), 1;

    std::vector<double> gains;
    for (int afferent = 0; afferent < 10'000; ++afferent) gains.push_back(afferent / 10'000.0);
    ThreadPool threads;
    Frames force(1, 500);  // 50 ms
    for (std::vector<Spike> spikes; (*press)->read(force) && force.count > 0; spikes.clear()) {
        PopulationResponse response{&spikes};
        const auto done = (*population)->respond(ForceProfile{{force.force[0].data(), force.count}, gains}, force.count, response, threads);
        if (!done) return std::puts(done.error().text().c_str()), 1;
        std::printf("at %.2f N: %5zu spikes\n", force.force[0][force.count - 1], spikes.size());
    }
}
