// The equations of the receptors, which are those above their step functions. A high-pass x of an input is the input minus its low-pass y,
// so that the slope of the input is not needed.

#include "model/equations/afferent_equations.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view filters = "Corpuscle takes the input of each filter, and the current, as straight lines between samples.";

const ReceptorEquations sa1a{.name = "sa1a",
                             .states = {},
                             .definitions = {{"I_s", "A", "k_s*F"}, {"I_d", "A", "k_d*abs(dF)"}, {"I", "A", "beta + I_s + I_d"}},
                             .currents = {"I"}};

const ReceptorEquations sa1b{.name = "sa1b",
                             .states = {{"y_B", "N", "2*pi*f_B*(F - y_B)", "F"}, {"y_C", "N", "2*pi*f_C*(F - y_C)", "F"}},
                             .definitions = {{"I_A", "A", "k_A*F"},
                                             {"I_B", "A", "K_B*(F - y_B)"},
                                             {"I_C", "A", "K_C*(F - y_C)"},
                                             {"I", "A", "I_A + max(I_B, 0) + max(I_C, 0)"}},
                             .currents = {"I"},
                             .smoothing = "Corpuscle takes the current as a straight line between samples."};

const ReceptorEquations fa1a{.name = "fa1a",
                             .states = {},
                             .definitions = {{"I_plus", "A", "k*max(dF, 0)"}, {"I_minus", "A", "k*max(-dF, 0)"}},
                             .currents = {"I_plus", "I_minus"}};

const ReceptorEquations fa1b{
    .name = "fa1b",
    .states = {{"y", "N", "2*pi*f*(F - y)", "F"}},
    .definitions = {{"x", "N", "F - y"}, {"I_A", "A", "k_A*max(x, 0)"}, {"I_B", "A", "k_B*max(-x, 0)"}, {"I", "A", "I_A + I_B"}},
    .currents = {"I"},
    .smoothing = "Corpuscle takes the current as a straight line between samples."};

const ReceptorEquations vibration{.name = "vibration",
                                  .states = {{"y_1", "N", "2*pi*f_hp*(F - y_1)", "F"},
                                             {"y_2", "N", "2*pi*f_hp*(F - y_1 - y_2)", "0"},
                                             {"x", "N", "2*pi*f_lp*(F - y_1 - y_2 - x)", "0"}},
                                  .definitions = {{"I", "A", "k*max(x, 0)"}},
                                  .currents = {"I"},
                                  .smoothing = filters};

const ReceptorEquations fast_adapting{.name = "fast-adapting",
                                      .states = {{"y_1", "N", "2*pi*f_hp*(F - y_1)", "F"},
                                                 {"y_2", "N", "2*pi*f_hp*(F - y_1 - y_2)", "0"},
                                                 {"z", "N", "2*pi*f_lp*(F - y_1 - y_2 - z)", "0"},
                                                 {"x", "N", "2*pi*f_lp*(z - x)", "0"}},
                                      .definitions = {{"I", "A", "I_0*asinh((k_A*max(x, 0) + k_B*max(-x, 0))/F_0)"}},
                                      .currents = {"I"},
                                      .smoothing = filters};

const ReceptorEquations slowly_adapting{
    .name = "slowly-adapting",
    .states = {{"y_1", "N", "(F - y_1)/tau_1", "F"},
               {"y_2", "N", "(F - y_2)/tau_2", "F"},
               {"y_3", "N", "(F - y_3)/tau_3", "F"},
               {"y", "N", "2*pi*f_hp*(F - y)", "F"},
               {"z_r", "N", "2*pi*f_lp*(F - g_1*y_1 - g_2*y_2 - g_3*y_3 - z_r)", "F*(1 - g_1 - g_2 - g_3)"},
               {"r", "N", "2*pi*f_lp*(z_r - r)", "F*(1 - g_1 - g_2 - g_3)"},
               {"z_x", "N", "2*pi*f_lp*(F - y - z_x)", "0"},
               {"x", "N", "2*pi*f_lp*(z_x - x)", "0"}},
    .definitions = {{"I", "A", "I_0*asinh(max(r + k_A*max(x, 0) + k_B*max(-x, 0), 0)/F_0)"}},
    .currents = {"I"},
    .smoothing = filters};

}  // namespace

std::span<const ReceptorEquations> all_receptor_equations() {
    static const std::vector<ReceptorEquations> all = {sa1a, sa1b, fa1a, fa1b, vibration, fast_adapting, slowly_adapting};
    return all;
}

}  // namespace corpuscle
