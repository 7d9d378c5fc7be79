// The equations of the neurons, which are those above their step functions.

#include "model/equations/afferent_equations.hpp"

namespace corpuscle {
namespace {

const NeuronEquations lif_a{.name = "lif-a",
                            .states = {{"u", "V", "((E_L - u)/R_m + I)/C_m", "E_L", "", true}},
                            .definitions = {},
                            .value = "u",
                            .threshold = "V_th",
                            .at_spike = {{"u", "V_reset"}},
                            .refractory_time = "t_ref"};

const NeuronEquations lif_b{.name = "lif-b",
                            .states = {{"u", "V", "(I - I_leak0)/C_m", "E_L", "E_L", true}},
                            .definitions = {},
                            .value = "u",
                            .threshold = "V_th",
                            .at_spike = {{"u", "V_reset"}},
                            .refractory_time = "t_ref"};

const NeuronEquations adaptive{.name = "adaptive",
                               .states = {{"u", "V", "I/C_m", "E_L", "E_L", true}, {"a", "V", "-a/tau_th", "0"}},
                               .definitions = {{"theta", "V", "V_th + a"}},
                               .value = "u",
                               .threshold = "theta",
                               .condition = "I",
                               .at_spike = {{"u", "V_reset"}, {"a", "a + dV_th"}},
                               .refractory_time = "t_ref"};

const NeuronEquations izhikevich{
    .name = "izhikevich",
    .states = {{"v", "V", "min(v, V_peak)*(4e4*min(v, V_peak) + 5e3) + 140 - w + gain*I"}, {"w", "V/s", "a*(b*min(v, V_peak) - w)"}},
    .definitions = {},
    .value = "v",
    .threshold = "V_peak",
    .at_spike = {{"v", "c"}, {"w", "w + d"}}};

const NeuronEquations adex{.name = "adex",
                           .states = {{"v", "V", "(g_L*(E_L - v) + g_L*Delta_T*exp((min(v, V_peak) - V_T)/Delta_T) - w + gain*I)/C_m"},
                                      {"w", "A", "(a*(v - E_L) - w)/tau_w"}},
                           .definitions = {},
                           .value = "v",
                           .threshold = "V_peak",
                           .at_spike = {{"v", "V_reset"}, {"w", "w + b"}}};

const NeuronEquations alif{.name = "alif",
                           .states = {{"u", "V", "((E_L - u)/R_m + I)/C_m", "E_L", "", true}, {"a", "V", "-a/tau_th", "0"}},
                           .definitions = {{"theta", "V", "V_th + a"}},
                           .value = "u",
                           .threshold = "theta",
                           .at_spike = {{"u", "V_reset"}, {"a", "a + dV_th"}},
                           .refractory_time = "t_ref"};

}  // namespace

std::span<const NeuronEquations> all_neuron_equations() {
    static const std::vector<NeuronEquations> all = {lif_a, lif_b, adaptive, izhikevich, adex, alif};
    return all;
}

}  // namespace corpuscle
