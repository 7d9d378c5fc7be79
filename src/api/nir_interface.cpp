#include <fmt/format.h>
#include <cmath>

#include "api/result.hpp"
#include "core/afferent.hpp"
#include "core/text/ascii_text.hpp"
#include "corpuscle/nir.hpp"
#include "nir/graph_file.hpp"
#include "nir/network.hpp"

namespace corpuscle {
namespace {

nir::Update update_of(const std::string& method) {
    constexpr std::pair<std::string_view, nir::Update> methods[] = {
        {"exact", nir::Update::exact}, {"euler", nir::Update::euler}, {"backward-euler", nir::Update::backward_euler}};
    std::vector<std::string_view> names;
    for (const auto& [name, update] : methods) {
        if (name == method) return update;
        names.push_back(name);
    }
    throw InputError(fmt::format("unknown method '{}' (there are {})", method, joined(names)));
}

}  // namespace

struct NirGraph::Impl {
    std::string path;
    std::shared_ptr<const nir::Graph> graph;
};

NirGraph::NirGraph(const std::string& path)
    : impl_(std::make_shared<const Impl>(Impl{path, std::make_shared<const nir::Graph>(api::value_or_throw(nir::read_graph(path)))})) {}

std::vector<NirNode> NirGraph::nodes() const {
    std::vector<NirNode> out;
    for (const auto& n : impl_->graph->nodes)
        out.push_back({n.name, std::string(n.kind->type), n.input_shape, n.output_shape, {n.values.begin(), n.values.end()}});
    return out;
}

std::vector<std::pair<std::string, std::string>> NirGraph::edges() const {
    std::vector<std::pair<std::string, std::string>> out;
    const auto& graph = *impl_->graph;
    for (const auto& e : graph.edges) out.emplace_back(graph.nodes[e.from].name, graph.nodes[e.to].name);
    return out;
}

std::string NirGraph::version() const { return impl_->graph->version; }
std::vector<std::string> NirGraph::input_nodes() const {
    std::vector<std::string> out;
    for (const auto n : impl_->graph->inputs) out.push_back(impl_->graph->nodes[n].name);
    return out;
}

std::vector<std::string> NirGraph::output_nodes() const {
    std::vector<std::string> out;
    for (const auto n : impl_->graph->outputs) out.push_back(impl_->graph->nodes[n].name);
    return out;
}

std::size_t NirGraph::input_count() const { return impl_->graph->input_count(); }
std::size_t NirGraph::output_count() const { return impl_->graph->output_count(); }

std::vector<double> NirGraph::run(std::span<const double> input, double rate, const std::string& method, const Progress& progress) const {
    const std::size_t width = input_count(), steps = input.size() / width;
    if (!std::isfinite(rate) || rate <= 0) throw InputError(fmt::format("rate = {} Hz must be a finite number above 0", rate));
    if (input.size() % width != 0)
        throw InputError(fmt::format("{}: the input has {} values, which are not complete steps of {}", impl_->path, input.size(), width));
    if (const auto bad = first_non_finite(input); bad < input.size())
        throw InputError(fmt::format("{}: input {} of step {} is {}, not a finite number", impl_->path, bad % width, bad / width, input[bad]));
    auto network = nir::Network::create(impl_->graph, 1 / rate, update_of(method));
    if (!network) throw InputError(fmt::format("{}: {}", impl_->path, network.error().message));
    auto state = network->start(), workspace = network->workspace();
    std::vector<double> output(steps * output_count());
    const std::size_t report_interval = 1 + (std::size_t{1} << 22) / (1 + network->operations());  // some milliseconds
    for (std::size_t k = 0; k < steps; ++k) {
        if (progress && k % report_interval == 0 && !progress(static_cast<double>(k) / static_cast<double>(steps)))
            throw InterruptedError("interrupted");
        network->step(input.subspan(k * width, width), std::span(output).subspan(k * output_count(), output_count()), state, workspace);
    }
    if (const auto bad = first_non_finite(output); bad < output.size())
        throw InputError(fmt::format("{}: output {} of step {} is {}: the network diverges", impl_->path, bad % output_count(),
                                     bad / output_count(), output[bad]));
    return output;
}

}  // namespace corpuscle
