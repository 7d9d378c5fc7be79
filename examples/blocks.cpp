// Simulates an afferent block by block, as the force arrives. The caller owns the state between blocks, and may copy, save and resume it.

#include <cstdio>

#include "model/catalog.hpp"

int main() {
    using namespace corpuscle;
    const auto plan = plan_afferent("fa1");
    if (!plan) return std::puts(plan.error().text().c_str()), 1;
    const double T = 1e-3;  // sampling period, s
    const auto afferent = make_afferent(*plan, {T});

    auto state = afferent->start();
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    for (int block = 0; block < 20; ++block) {
        std::vector<double> force(50, block < 10 ? 0.2 : 3.0);  // N: 50 samples; the force steps after half a second
        if (auto ok = afferent->respond(force, state, response); !ok) return std::puts(ok.error().text().c_str()), 1;
        state = *unpack(pack(state));  // optional: save the state to disk and read it back
    }
    for (const auto& s : spikes) std::printf("%.4f s\n", Clock{1000, 1}.time(s.step, s.offset));
    return spikes.empty();
}
