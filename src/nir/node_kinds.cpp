#include "nir/node_kinds.hpp"

#include <algorithm>

namespace corpuscle::nir {
namespace {

using Form = NodeKind::Form;

constexpr NodeParameter shape[] = {{"shape"}};
constexpr NodeParameter affine[] = {{"weight"}, {"bias"}};
constexpr NodeParameter linear[] = {{"weight"}};
constexpr NodeParameter scale[] = {{"scale"}};
constexpr NodeParameter threshold[] = {{"threshold"}};
constexpr NodeParameter integrator[] = {{"r"}};
constexpr NodeParameter integrate_and_fire[] = {{"r"}, {"v_threshold"}, {"v_reset", false, 0.0}};
constexpr NodeParameter leaky[] = {{"tau", true}, {"r"}, {"v_leak"}};
constexpr NodeParameter leaky_fire[] = {{"tau", true}, {"r"}, {"v_leak"}, {"v_threshold"}, {"v_reset", false, 0.0}};
constexpr NodeParameter synapse[] = {{"tau_syn", true}, {"tau_mem", true}, {"r"}, {"v_leak"}, {"w_in", false, 1.0}};
constexpr NodeParameter synapse_fire[] = {{"tau_syn", true}, {"tau_mem", true},      {"r"},
                                          {"v_leak"},        {"w_in", false, 1.0}, {"v_threshold"},
                                          {"v_reset", false, 0.0}};

constexpr NodeKind kinds[] = {
    {"Input", Form::port, shape},
    {"Output", Form::port, shape},
    {"Affine", Form::matrix, affine},
    {"Linear", Form::matrix, linear},
    {"Scale", Form::scale, scale},
    {"Threshold", Form::threshold, threshold},
    {"I", Form::membrane, integrator},
    {"IF", Form::membrane, integrate_and_fire, false, false, true},
    {"LI", Form::membrane, leaky, false, true},
    {"LIF", Form::membrane, leaky_fire, false, true, true},
    {"CubaLI", Form::membrane, synapse, true, true},
    {"CubaLIF", Form::membrane, synapse_fire, true, true, true},
};

}  // namespace

std::span<const NodeKind> node_kinds() { return kinds; }

const NodeKind* find_node_kind(std::string_view type) {
    const auto found = std::find_if(std::begin(kinds), std::end(kinds), [&](const NodeKind& k) { return k.type == type; });
    return found == std::end(kinds) ? nullptr : found;
}

bool is_other_nir_type(std::string_view type) {
    constexpr std::string_view others[] = {"Conv1d", "Conv2d", "Delay", "Flatten", "SumPool2d", "AvgPool2d"};
    return std::find(std::begin(others), std::end(others), type) != std::end(others);
}

}  // namespace corpuscle::nir
