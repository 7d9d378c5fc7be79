#include "run/export/nir_graph.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "run/export/affine_form.hpp"

namespace corpuscle {
namespace {

constexpr double max_force = 20;         // N: staircases reach to the signals of this force
constexpr std::size_t levels = 1024;     // of a staircase
constexpr double smallest_level = 1e-5;  // of the largest

/// A graph that grows by nodes and the edges that lead to them.
class GraphBuilder {
    nir::Graph graph_;
    std::map<std::string, std::size_t, std::less<>> nodes_;  // by name

public:
    bool has(std::string_view name) const { return nodes_.contains(name); }

    void add(const std::string& name, std::string_view type, std::map<std::string, std::vector<double>, std::less<>> values,
             nir::Shape input, nir::Shape output) {
        nodes_[name] = graph_.nodes.size();
        if (type == "Input") graph_.inputs.push_back(graph_.nodes.size());
        if (type == "Output") graph_.outputs.push_back(graph_.nodes.size());
        graph_.nodes.push_back({name, nir::find_node_kind(type), std::move(input), std::move(output), std::move(values)});
    }
    void connect(const std::string& from, const std::string& to) { graph_.edges.push_back({nodes_.at(from), nodes_.at(to)}); }

    /// Adds `form` to the input of each of the `width` elements of node `to`. A constant goes with the first signal, of which there is one.
    void connect(const AffineForm& form, const std::string& to, std::size_t width) {
        double constant = form.constant;
        for (const auto& [signal, factor] : form.factors) {
            if (factor == 1 && constant == 0 && width == 1) {
                connect(signal, to);
                continue;
            }
            const auto name = fmt::format("{}_to_{}", signal, to);
            std::map<std::string, std::vector<double>, std::less<>> values{{"weight", std::vector<double>(width, factor)}};
            if (constant != 0) values["bias"] = std::vector<double>(width, constant);
            add(name, constant != 0 ? "Affine" : "Linear", std::move(values), {1}, {width});
            connect(signal, name), connect(name, to);
            constant = 0;
        }
    }
    nir::Graph finish() { return std::move(graph_); }
};

class NirExporter {
    const ExportedAfferent& afferent_;
    const ReceptorEquations& receptor_;
    const NeuronEquations& neuron_;
    AffineForms forms_;
    GraphBuilder graph_;
    std::map<std::string, AffineForm, std::less<>> slopes_;  // of the receptor's states
    std::map<std::string, double, std::less<>> bounds_;      // largest magnitude of a signal
    std::vector<Error> warnings_;

    Error refused(const std::string& reason) const {
        return bad_input(fmt::format("{}: cannot be exported to NIR: {}", afferent_.plan.name, reason));
    }
    Result<AffineForm> read(std::string_view quantity, std::string_view expression) {
        auto form = forms_.read(expression);
        if (!form) return refused(fmt::format("{} = {}: {}, for which NIR has no node", quantity, expression, form.error().message));
        return form;
    }
    Result<double> number(std::string_view quantity, std::string_view expression) {
        const auto form = TRY(read(quantity, expression));
        if (!form.is_constant()) return refused(fmt::format("{} = {} is not constant", quantity, expression));
        return form.constant;
    }

    double bound_of(const AffineForm& form) const {
        double bound = std::abs(form.constant);
        for (const auto& [signal, factor] : form.factors) bound += std::abs(factor) * bounds_.at(signal);
        return bound;
    }

    /// Adds the nodes of all signals of a form that the graph does not have yet.
    Result<void> add_signals(const AffineForm& form) {
        for (const auto& [signal, factor] : form.factors) {
            if (graph_.has(signal)) continue;
            if (signal == "dF") return refused("it uses the slope of the force, for which NIR has no node");
            TRY(slopes_.contains(signal) ? add_filter(signal) : add_staircase(signal));
        }
        return {};
    }

    /// A state of the receptor, dx/dt = -x/tau + the rest, as an LI.
    Result<void> add_filter(const std::string& state) {
        auto rest = slopes_.at(state);
        const double tau = -1 / rest.factor(state);
        if (!(tau > 0)) return refused(fmt::format("{} does not decay by itself", state));
        rest *= tau;
        rest.factors.erase(state);
        TRY(add_signals(rest));
        bounds_[state] = bound_of(rest);
        graph_.add(state, "LI", {{"tau", {tau}}, {"r", {1}}, {"v_leak", {std::exchange(rest.constant, 0)}}}, {1}, {1});
        graph_.connect(rest, state, 1);
        return {};
    }

    /// A positive part as a sum of steps: each threshold that its input exceeds adds the height of a step. The levels are a geometric
    /// series, so that the relative error is the same at all of them.
    Result<void> add_staircase(const std::string& signal) {
        const auto& all = forms_.rectifiers();
        const auto& part = *std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.name == signal; });
        auto input = part.input;
        const auto text = part.text;
        TRY(add_signals(input));
        const double top = bound_of(input), ratio = std::pow(smallest_level, -1.0 / (levels - 1));
        std::vector<double> thresholds, heights;
        double level = top * smallest_level, below = 0;
        for (std::size_t k = 0; k < levels; ++k, level *= ratio) {
            thresholds.push_back(level - input.constant);
            heights.push_back(level * std::sqrt(ratio) - below);
            below = level * std::sqrt(ratio);
        }
        bounds_[signal] = below;
        input.constant = 0;
        const auto steps = signal + "_steps";
        graph_.add(steps, "Threshold", {{"threshold", std::move(thresholds)}}, {levels}, {levels});
        graph_.connect(input, steps, levels);
        graph_.add(signal, "Linear", {{"weight", std::move(heights)}}, {levels}, {1});
        graph_.connect(steps, signal);
        warnings_.push_back(bad_input(
            fmt::format("{} is a staircase of {} thresholds up to its largest value at {} N; its relative error is below {:.2g} % down to {:g} of "
                        "that value, and below it is 0",
                        text, levels, max_force, 100 * (std::sqrt(ratio) - 1), smallest_level)));
        return {};
    }

    Result<void> check_neuron() const {
        if (neuron_.states.size() != 1 || !neuron_.condition.empty() || neuron_.at_spike.size() != 1)
            return refused(fmt::format("NIR has no node for the neuron {}; export one with lif-a or lif-b, such as sa1, fa1 or sa1b+lif-a",
                                       neuron_.name));
        if (afferent_.equations.refractory_time > 0)
            return refused(fmt::format("NIR has no refractory time ({0} = {1:g} s); add --set {2}.{0}=0", neuron_.refractory_time,
                                       afferent_.equations.refractory_time, afferent_.plan.name));
        return {};
    }

    /// Adds the neuron that this current (A) drives.
    Result<void> add_neuron(const std::string& name, AffineForm current) {
        const auto& u = neuron_.states[0];
        const auto slope = TRY(read(fmt::format("d{}/dt", u.name), u.slope));
        const double threshold = TRY(number("threshold", neuron_.threshold)), reset = TRY(number(u.name, neuron_.at_spike[0].expression)),
                     start = TRY(number(u.name, afferent_.initial(u)));
        if (const double leak = -slope.factor(u.name); leak > 0) {
            graph_.add(name, "LIF",
                       {{"tau", {1 / leak}},
                        {"r", {slope.factor("I") / leak}},
                        {"v_leak", {slope.constant / leak}},
                        {"v_threshold", {threshold}},
                        {"v_reset", {reset}}},
                       {1}, {1});
        } else {
            current.constant += slope.constant / slope.factor("I");
            if (!u.minimum.empty()) {
                current = forms_.rectify(std::move(current), "the net current, max(I - leak, 0),");
                warnings_.push_back(bad_input(fmt::format(
                    "the membrane of an IF does not leak in a pause, as {} does down to {}: the first spike after a pause may come earlier",
                    u.name, u.minimum)));
            }
            graph_.add(name, "IF", {{"r", {slope.factor("I")}}, {"v_threshold", {threshold - start}}, {"v_reset", {reset - start}}}, {1}, {1});
        }
        TRY(add_signals(current));
        if (current.is_constant()) return refused("its current does not depend on the force");
        graph_.connect(current, name, 1);
        graph_.connect(name, "output");
        return {};
    }

public:
    explicit NirExporter(const ExportedAfferent& afferent)
        : afferent_(afferent), receptor_(*afferent.equations.receptor), neuron_(*afferent.equations.neuron) {}

    Result<NirExport> run() {
        TRY(check_neuron());
        forms_.define_number("pi", std::numbers::pi);
        for (const auto& p : afferent_.equations.parameters) forms_.define_number(p.name, p.value);
        for (const auto name : {"F", "dF", "I"}) forms_.define_signal(name);
        forms_.define_signal(neuron_.states[0].name);
        for (const auto& s : receptor_.states) forms_.define_signal(s.name);
        for (const auto& s : receptor_.states) slopes_[std::string(s.name)] = TRY(read(fmt::format("d{}/dt", s.name), s.slope));
        std::map<std::string, AffineForm, std::less<>> definitions;
        for (const auto& d : receptor_.definitions) {
            definitions[std::string(d.name)] = TRY(read(d.name, d.expression));
            if (d.name != "I") forms_.define(d.name, definitions[std::string(d.name)]);  // in the neuron I is a signal
        }
        graph_.add("F", "Input", {{"shape", {1}}}, {1}, {1});
        graph_.add("output", "Output", {{"shape", {1}}}, {1}, {1});
        bounds_["F"] = max_force;
        for (const auto& current : receptor_.currents)
            TRY(add_neuron(receptor_.currents.size() == 1 ? "neuron" : fmt::format("neuron_{}", current), definitions.at(std::string(current))));
        return NirExport{graph_.finish(), std::move(warnings_)};
    }
};

}  // namespace

Result<NirExport> nir_export_of(const ExportedAfferent& afferent) { return NirExporter(afferent).run(); }

}  // namespace corpuscle
