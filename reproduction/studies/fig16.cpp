// Thesis fig. 16: the smallest currents that make LIF-A and LIF-B fire.

#include <fmt/format.h>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/threshold_search.hpp"

namespace corpuscle::studies::fig16 {

/// The smallest current (A) that makes the neuron fire within 100 s. The receptor SA-IA without its dynamic component turns a step of force
/// into a step of current, 1 uA/N.
Result<double> rheobase(const std::string& neuron, double u_rest) {
    const std::string afferent = "sa1a+" + neuron;
    const auto set = [&](const char* parameter) { return fmt::format("{}.{}", afferent, parameter); };
    return find_threshold(
        0, 2.03e-6, 14, SearchScale::linear,
        [&](double current) {
            return TrialSpec{
                .afferent = afferent,
                .stimulus = "step",
                .settings = {set("k_d=0"), set("C_m=1e-6"), set("V_th=1"), set("V_reset=0.5"), fmt::format("{}.E_L={}", afferent, u_rest),
                             neuron == "lif-a" ? set("R_m=1e6") : set("I_leak0=500e-9"), fmt::format("step.F_max={}", current / 1e-6),
                             "step.t_rest=0.5", "step.t_hold=100", "step.t_post=2"},
                .rate = 100};
        },
        [](const std::vector<double>& spikes) { return !spikes.empty(); });
}

/// rheobase_A, rheobase_B, and rheobase_raised, that of LIF-A with u_rest = 0.2 V.
Result<StudyValues> compute_values(const StudyOptions& options) {
    StudyValues out;
    for (const auto& [name, neuron, u_rest] :
         {std::tuple{"rheobase_A", "lif-a", 0.0}, {"rheobase_B", "lif-b", 0.0}, {"rheobase_raised", "lif-a", 0.2}}) {
        const auto current = TRY(rheobase(neuron, u_rest));
        out.emplace(name, current);
        TRY(options.report_progress(0));
    }
    return out;
}

}  // namespace corpuscle::studies::fig16
