#include "nir/nir_afferent.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <mutex>

#include "core/checksum.hpp"
#include "core/text/ascii_text.hpp"
#include "nir/graph_file.hpp"
#include "nir/loops.hpp"
#include "nir/network.hpp"

namespace corpuscle::nir {
namespace {

constexpr int state_version = 1;

std::uint64_t fingerprint_of(const Graph& graph) {
    Checksum sum;
    for (const auto& node : graph.nodes) {
        sum.add(node.name);
        sum.add(node.kind->type);
        for (const auto& [name, values] : node.values) {
            sum.add(name);
            sum.add(values.data(), values.size() * sizeof(double));
        }
    }
    for (const auto& e : graph.edges) sum.add(std::uint64_t{e.from}), sum.add(std::uint64_t{e.to});
    return sum.value();
}

class GraphAfferent final : public Afferent {
    std::string name_, format_;
    std::shared_ptr<const Network> network_;
    std::vector<Network::Membrane> membranes_;
    std::vector<std::string> probe_names_;  // probes_ refers to them
    std::vector<Probe> probes_;

public:
    GraphAfferent(std::string name, std::shared_ptr<const Network> network, const SimulationOptions& run)
        : name_(std::move(name)), format_(fmt::format("nir {:016x}/{}, T = {} s, {}", fingerprint_of(network->graph()), state_version, run.dt,
                                                      run.method == Method::exact ? "exact" : "backward Euler")),
          network_(std::move(network)), membranes_(network_->membranes()) {
        for (const auto& m : membranes_) probe_names_.push_back(fmt::format("{}.v", m.node));
        for (const auto& probe : probe_names_) probes_.push_back({probe, ""});
    }

    std::span<const Probe> probes() const override { return probes_; }
    State start(ChannelSlot) const override { return {format_, 0, network_->start()}; }

    Result<void> respond(std::span<const double> force, State& state, ResponseBlock& response) const override {
        TRY(check_block(name_, format_, network_->state_size(), state, force));
        auto workspace = network_->workspace();
        for (std::size_t k = 0; k < force.size(); ++k) {
            double spikes = 0;
            network_->step({&force[k], 1}, {&spikes, 1}, state.values, workspace);
            const auto step = state.step + static_cast<std::int64_t>(k);
            for (; spikes > 0.5; --spikes) response.spikes.push_back({step, 1.0, response.afferent_index});
            for (std::size_t p = 0; p < response.probes.size(); ++p) response.probes[p][k] = state.values[membranes_[p].at];
        }
        state.step += static_cast<std::int64_t>(force.size());
        return {};
    }
};

/// The networks of one graph by step and method, which all its copies share. May be used by several threads.
class Networks {
    std::shared_ptr<const Graph> graph_;
    std::mutex mutex_;
    std::map<std::pair<double, Method>, std::shared_ptr<const Network>> made_;

public:
    explicit Networks(std::shared_ptr<const Graph> graph) : graph_(std::move(graph)) {}

    std::shared_ptr<const Network> network(const SimulationOptions& run) {
        const std::lock_guard lock(mutex_);
        auto& found = made_[{run.dt, run.method}];
        if (!found) {
            const auto update = run.method == Method::exact ? Update::exact : Update::backward_euler;
            found = std::make_shared<const Network>(*Network::create(graph_, run.dt, update));  // cannot fail: plan() has checked the loops
        }
        return found;
    }
};

class GraphFactory final : public AfferentFactory {
    std::shared_ptr<Networks> networks_;

public:
    explicit GraphFactory(std::shared_ptr<const Graph> graph) : networks_(std::make_shared<Networks>(std::move(graph))) {}

    std::unique_ptr<Afferent> make(const AfferentPlan& plan, const SimulationOptions& run) const override {
        return std::make_unique<GraphAfferent>(plan.name, networks_->network(run), run);
    }
    AfferentTraits traits(const AfferentPlan&) const override {
        return {.can_use_lanes = false, .lane_obstacles = "NIR graphs", .reason_no_noise = "a NIR graph has no membrane current in A"};
    }
    std::string composition(const AfferentPlan&) const override { return "NIR graph"; }
    std::vector<std::pair<std::string, std::string>> labels(const AfferentPlan&) const override { return {{"format", "NIR"}}; }
};

/// The nodes whose outputs reach the output, directly or through ports of graphs within the graph.
std::vector<std::size_t> sources_of_output(const Graph& graph) {
    std::vector<std::size_t> reached = {graph.outputs[0]}, sources;
    for (std::size_t k = 0; k < reached.size(); ++k)
        for (const auto& e : graph.edges) {
            if (e.to != reached[k]) continue;
            const bool is_inner_port = graph.nodes[e.from].kind->form == NodeKind::Form::port && e.from != graph.inputs[0];
            auto& found = is_inner_port ? reached : sources;
            if (std::find(found.begin(), found.end(), e.from) == found.end()) found.push_back(e.from);
        }
    return sources;
}

/// A graph is an afferent if it has one input and one output, which receives the spikes of neurons and nothing else.
Result<void> check_afferent(const Graph& graph, const std::string& path) {
    if (graph.input_count() != 1 || graph.output_count() != 1)
        return bad_input(fmt::format("an afferent has one input and one output, but this graph has {} and {}; simulate it in Python with "
                                     "corpuscle.nir('{}').run(...)",
                                     graph.input_count(), graph.output_count(), path),
                         {path});
    for (const auto n : sources_of_output(graph))
        if (const auto& from = graph.nodes[n]; !from.kind->fires)
            return bad_input(fmt::format("the output of an afferent is spikes, but '{}' ({}), which leads to the output, does not fire; "
                                         "connect IF, LIF or CubaLIF with the output, or use Python's corpuscle.nir('{}').run(...)",
                                         from.name, from.kind->type, path),
                             {path});
    const auto order = order_of(graph);
    return order ? Result<void>() : bad_input(order.error().message, {path});
}

/// The probes of a plan with the requested names.
std::vector<RequestedProbe> requested(const Graph& graph, const std::string& path, std::span<const std::string> probes) {
    std::vector<std::string> names;
    for (const auto& node : graph.nodes)
        if (node.has_single_membrane()) names.push_back(node.name + ".v");
    const std::vector<std::string_view> known(names.begin(), names.end());
    std::vector<RequestedProbe> out;
    for (const auto& probe : probes) {
        const bool exists = std::find(names.begin(), names.end(), probe) != names.end();
        auto hint = exists ? "" : did_you_mean(probe, known);
        if (!exists && hint.empty() && !names.empty()) hint = fmt::format("; {} has {}", path, joined(names));
        out.push_back({exists ? std::optional(probe) : std::nullopt, std::move(hint)});
    }
    return out;
}

}  // namespace

Result<PlannedAfferent> GraphSpec::plan(std::span<const ParameterOverride> overrides, std::span<const std::string> probes) const {
    for (const auto& o : overrides)
        if (o.target == text())
            return bad_input(fmt::format("{}: a NIR graph has no parameters that can be set; change its file with Python's nir or h5py",
                                         o.typed.empty() ? o.text() : o.typed),
                             o.location);
    auto graph = TRY(read_graph(text()));
    TRY(check_afferent(graph, text()));
    AfferentPlan plan;
    plan.name = text();
    plan.description = "NIR graph";
    plan.min_rate = 1 / graph.shortest_time_constant();
    plan.parameters = std::make_shared<const std::vector<AfferentParameter>>();
    auto found = requested(graph, text(), probes);
    plan.factory = std::make_shared<const GraphFactory>(std::make_shared<const Graph>(std::move(graph)));
    return PlannedAfferent{{std::move(plan), {overrides.begin(), overrides.end()}}, std::move(found)};
}

}  // namespace corpuscle::nir
