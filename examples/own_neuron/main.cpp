// Your own neuron: its interval between spikes is compared with a closed form, then it is simulated behind a receptor under a press.

#include <cmath>
#include <cstdio>

#include "core/stimulus/stimuli.hpp"
#include "model/chain.hpp"
#include "model/receptor/sa1b.hpp"
#include "qif.hpp"

using namespace corpuscle;

/// The interval (s) between spikes under a constant current (A): C_m du/dt is a parabola in u, and the integral of its reciprocal is an arc
/// tangent.
double closed_form_interval(const ParameterValues<Qif<double>>& p, double current) {
    const double a = p("g") / (p("V_T") - p("E_L")) / p("C_m"), middle = (p("E_L") + p("V_T")) / 2;
    const double b = current / p("C_m") - a * (p("V_T") - p("E_L")) * (p("V_T") - p("E_L")) / 4;
    const auto angle = [&](double u) { return std::atan((u - middle) * std::sqrt(a / b)); };
    return (angle(p("V_peak")) - angle(p("V_reset"))) / std::sqrt(a * b);
}

/// The last interval (s) between spikes in a simulation of 2 s under a constant current (A), in steps of dt (s).
double interval(const ParameterValues<Qif<double>>& p, double current, double dt) {
    const Qif<double> neuron(p, dt, Method::exact);
    auto state = neuron.start();
    double last = 0, between = 0;
    for (int k = 1; k * dt < 2; ++k)
        neuron.step(state, Current<double>{current, current}, [&](bool, double offset) {
            const double t = (k - 1 + offset) * dt;
            between = t - last, last = t;
        });
    return between;
}

int main() {
    const ParameterValues<Qif<double>> params;
    const double found = interval(params, 1e-6, 1e-4), expected = closed_form_interval(params, 1e-6);
    std::printf("interval at 1 uA: %.6f s, closed form %.6f s\n", found, expected);
    if (!(std::abs(found - expected) < 1e-6)) return 1;

    const Chain<Sa1b, Qif> afferent({}, params, {.dt = 1e-4});
    const auto press = make_stimulus("press", 10e3, 0);
    auto state = afferent.start({});
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    for (Frames block(1, 4096); (*press)->read(block) && block.count > 0;)
        if (auto ok = afferent.respond({block.force[0].data(), block.count}, state, response); !ok)
            return std::puts(ok.error().text().c_str()), 1;
    std::printf("sa1b+qif under a press: %zu spikes, the first at %.1f ms\n", spikes.size(),
                spikes.empty() ? 0.0 : 1e3 * (*press)->clock().time(spikes[0].step, spikes[0].offset));
    return spikes.empty();
}
