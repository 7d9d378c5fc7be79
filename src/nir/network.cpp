#include "nir/network.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "nir/loops.hpp"

namespace corpuscle::nir {
namespace {

/// x after a step of tau dx/dt = y - x with a constant y: keep x + gain y.
struct Decay {
    double keep, gain;
};

Decay decay_of(double tau, double dt, Update update) {
    const double a = dt / tau;
    if (update == Update::exact) return {std::exp(-a), -std::expm1(-a)};
    return update == Update::euler ? Decay{1 - a, a} : Decay{1 / (1 + a), a / (1 + a)};
}

/// v after a time dt, from 0, of tau_mem dv/dt = exp(-t/tau_syn) - v: (exp(-dt/tau_syn) - exp(-dt/tau_mem)) / (1 - tau_mem/tau_syn).
double membrane_under_decay(double tau_syn, double tau_mem, double dt) {
    const double synapse = dt / tau_syn, membrane = dt / tau_mem, difference = membrane - synapse;
    if (std::abs(difference) > 1) return membrane * (std::exp(-synapse) - std::exp(-membrane)) / difference;
    const double quotient = difference == 0 ? 1 : std::expm1(difference) / difference;  // without cancellation
    return membrane * std::exp(-membrane) * quotient;
}

Result<void> check_step(const Node& node, std::string_view parameter, double dt) {
    for (const double tau : node.value(parameter))
        if (dt >= 2 * tau)
            return bad_input(fmt::format("node '{}' ({}): {} = {} s is too short for forward Euler with steps of {} s, which then diverges; "
                                         "use a higher sampling rate or the method exact",
                                         node.name, node.kind->type, parameter, tau, dt));
    return {};
}

void add(std::span<double> to, const double* from) {
    for (std::size_t k = 0; k < to.size(); ++k) to[k] += from[k];
}

}  // namespace

Result<void> Network::add_coefficients(Stage& stage, double dt, Update update) const {
    const auto& node = *stage.node;
    const auto& kind = *node.kind;
    const auto values = [&](std::string_view parameter) {
        const auto found = node.values.find(parameter);
        return found == node.values.end() ? std::span<const double>() : std::span<const double>(found->second);
    };
    stage.offset = values("bias"), stage.factor = values("scale"), stage.reset = values("v_reset");
    stage.threshold = values(kind.form == NodeKind::Form::threshold ? "threshold" : "v_threshold");
    if (kind.form == NodeKind::Form::matrix) {
        const auto weight = values("weight");
        const std::size_t rows = node.outputs(), columns = node.inputs();
        stage.columns.resize(weight.size());
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < columns; ++c) stage.columns[c * rows + r] = weight[r * columns + c];
    }
    if (kind.form != NodeKind::Form::membrane) return {};
    if (update == Update::euler && kind.is_leaky) TRY(check_step(node, kind.membrane_constant(), dt));
    if (update == Update::euler && kind.has_synapse) TRY(check_step(node, "tau_syn", dt));
    for (std::size_t k = 0; k < node.outputs(); ++k) {
        const double r = node.value("r")[k];
        const auto v = kind.is_leaky ? decay_of(node.value(kind.membrane_constant())[k], dt, update) : Decay{1, dt};
        stage.keep.push_back(v.keep), stage.gain.push_back(v.gain * r);
        stage.rest.push_back(kind.is_leaky ? v.gain * node.value("v_leak")[k] : 0);
        if (kind.has_synapse) add_synapse(stage, k, dt, update);
    }
    return {};
}

/// Adds a synapse before a membrane whose coefficients are those of a constant current.
void Network::add_synapse(Stage& stage, std::size_t element, double dt, Update update) const {
    const auto& node = *stage.node;
    const double tau_syn = node.value("tau_syn")[element], w = node.value("w_in")[element], r = node.value("r")[element];
    const auto current = decay_of(tau_syn, dt, update);
    const double constant = stage.gain[element];  // the gain of a constant current
    // Euler's methods take the current at the end of the step; the exact current decays from I to w x within it.
    const bool is_exact = update == Update::exact;
    const double decaying = is_exact ? r * membrane_under_decay(tau_syn, node.value("tau_mem")[element], dt) : constant * current.keep;
    stage.current_gain.push_back(decaying);
    stage.gain[element] = w * (is_exact ? constant - decaying : constant * current.gain);
    stage.current_keep.push_back(current.keep), stage.weight.push_back(current.gain * w);
}

Result<Network> Network::create(std::shared_ptr<const Graph> graph, double dt, Update update) {
    const auto order = TRY(order_of(*graph));
    Network out;
    out.graph_ = std::move(graph);
    const auto& nodes = out.graph_->nodes;
    std::vector<std::size_t> stage_of(nodes.size());
    std::vector<bool> has_delayed_edge(nodes.size());
    for (std::size_t e = 0; e < order.is_delayed.size(); ++e)
        if (order.is_delayed[e]) has_delayed_edge[out.graph_->edges[e].from] = true;
    for (const auto n : order.nodes) {
        Stage stage{.node = &nodes[n], .signal = out.signals_};
        const auto place = [&](bool is_needed) { return is_needed ? std::exchange(out.state_size_, out.state_size_ + nodes[n].outputs()) : 0; };
        stage.current = place(nodes[n].kind->has_synapse);
        stage.membrane = place(nodes[n].kind->form == NodeKind::Form::membrane);
        stage.is_delayed = has_delayed_edge[n];
        stage.delayed = place(stage.is_delayed);
        TRY(out.add_coefficients(stage, dt, update));
        out.signals_ += nodes[n].outputs();
        out.widest_input_ = std::max(out.widest_input_, nodes[n].inputs());
        out.operations_ += nodes[n].outputs() + stage.columns.size();
        stage_of[n] = out.stages_.size();
        out.stages_.push_back(std::move(stage));
    }
    for (std::size_t e = 0; e < order.is_delayed.size(); ++e) {
        const auto& from = out.stages_[stage_of[out.graph_->edges[e].from]];
        out.stages_[stage_of[out.graph_->edges[e].to]].sources.push_back(
            {order.is_delayed[e] ? from.delayed : from.signal, static_cast<bool>(order.is_delayed[e])});
    }
    for (std::size_t at = 0; const auto n : out.graph_->inputs) {
        auto& stage = out.stages_[stage_of[n]];
        stage.is_input = true, stage.input = std::exchange(at, at + nodes[n].inputs());
    }
    for (const auto n : out.graph_->outputs) out.output_signals_.push_back(out.stages_[stage_of[n]].signal);
    return out;
}

std::vector<double> Network::start() const {
    std::vector<double> state(state_size_);
    for (const auto& stage : stages_)
        if (stage.node->kind->is_leaky)
            std::copy_n(stage.node->value("v_leak").begin(), stage.node->outputs(), state.begin() + static_cast<std::ptrdiff_t>(stage.membrane));
    return state;
}

void Network::run(const Stage& stage, std::span<const double> x, std::span<double> signals, std::span<double> state) const {
    const auto& node = *stage.node;
    const std::size_t count = node.outputs();
    double* const out = &signals[stage.signal];
    switch (node.kind->form) {
        case NodeKind::Form::port:
            std::copy_n(x.begin(), count, out);
            return;
        case NodeKind::Form::scale:
            for (std::size_t k = 0; k < count; ++k) out[k] = stage.factor[k] * x[k];
            return;
        case NodeKind::Form::threshold:
            for (std::size_t k = 0; k < count; ++k) out[k] = x[k] > stage.threshold[k] ? 1 : 0;
            return;
        case NodeKind::Form::matrix:
            std::fill_n(out, count, 0.0);
            std::copy(stage.offset.begin(), stage.offset.end(), out);
            for (std::size_t c = 0; c < x.size(); ++c)
                if (x[c] != 0)  // most inputs are spikes
                    for (std::size_t k = 0; k < count; ++k) out[k] += stage.columns[c * count + k] * x[c];
            return;
        case NodeKind::Form::membrane:
            break;
    }
    double* const v = &state[stage.membrane];
    for (std::size_t k = 0; k < count; ++k) v[k] = stage.keep[k] * v[k] + stage.rest[k] + stage.gain[k] * x[k];
    if (node.kind->has_synapse) {
        double* const current = &state[stage.current];
        for (std::size_t k = 0; k < count; ++k) {
            v[k] += stage.current_gain[k] * current[k];
            current[k] = stage.current_keep[k] * current[k] + stage.weight[k] * x[k];
        }
    }
    std::copy_n(v, count, out);
    if (!node.kind->fires) return;
    for (std::size_t k = 0; k < count; ++k) {
        out[k] = v[k] > stage.threshold[k] ? 1 : 0;
        if (out[k] > 0) v[k] = stage.reset[k];
    }
}

void Network::step(std::span<const double> input, std::span<double> output, std::span<double> state, std::span<double> workspace) const {
    const auto signals = workspace.first(signals_), x = workspace.subspan(signals_);
    for (const auto& stage : stages_) {
        const auto sum = x.first(stage.node->inputs());
        std::fill(sum.begin(), sum.end(), 0.0);
        if (stage.is_input) add(sum, &input[stage.input]);
        for (const auto& source : stage.sources) add(sum, source.is_delayed ? &state[source.at] : &signals[source.at]);
        run(stage, sum, signals, state);
    }
    for (const auto& stage : stages_)
        if (stage.is_delayed) std::copy_n(&signals[stage.signal], stage.node->outputs(), &state[stage.delayed]);
    for (std::size_t k = 0; k < output_signals_.size(); ++k) {
        const std::size_t count = graph_->nodes[graph_->outputs[k]].outputs();
        std::copy_n(&signals[output_signals_[k]], count, output.begin());
        output = output.subspan(count);
    }
}

std::vector<Network::Membrane> Network::membranes() const {
    std::vector<Membrane> out;
    for (const auto& stage : stages_)
        if (stage.node->has_single_membrane())
            out.push_back({stage.node->name, stage.membrane});
    return out;
}

}  // namespace corpuscle::nir
