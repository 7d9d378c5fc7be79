#pragma once
// The kinds of nodes of NIR graphs that are simulated. NIR (Neuromorphic Intermediate Representation) describes spiking networks for
// exchange between simulators and neuromorphic chips: J. E. Pedersen et al., Nature Communications 15:8122, 2024.

#include <optional>
#include <span>
#include <string_view>

namespace corpuscle::nir {

/// A parameter of a kind of node: a dataset of the node.
struct NodeParameter {
    std::string_view name;
    bool is_positive = false;                   ///< it must be greater than 0
    std::optional<double> default_value = {};  ///< of a parameter that files may leave out
};

/// A kind of node. The equations of those with a membrane v, where x is the sum of the inputs:
///   tau_syn dI/dt = -I + w_in x             if it has a synapse; otherwise I = x
///   tau dv/dt = v_leak - v + r I            if it is leaky; otherwise dv/dt = r I
///   v > v_threshold: output 1, v = v_reset  if it fires; otherwise the output is v.
struct NodeKind {
    enum class Form { port, matrix, scale, threshold, membrane };

    std::string_view type;  ///< the text in files: "LIF"
    Form form;              ///< port: passes x on; matrix: weight x + bias
    std::span<const NodeParameter> parameters;
    bool has_synapse = false, is_leaky = false, fires = false;

    /// The parameter that is the time constant of the membrane.
    std::string_view membrane_constant() const { return has_synapse ? "tau_mem" : "tau"; }
};

std::span<const NodeKind> node_kinds();
/// The kind of this type; null if it is not simulated.
const NodeKind* find_node_kind(std::string_view type);
/// True for types that NIR has, but that are not simulated.
bool is_other_nir_type(std::string_view type);

}  // namespace corpuscle::nir
