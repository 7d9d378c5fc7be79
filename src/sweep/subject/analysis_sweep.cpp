// A sweep over a netlist's own analyses (.op, .tran, .meas ...). Each thread has one analysis context, in which it runs the analyses for
// one item after another.

#include <fmt/format.h>
#include <algorithm>

#include "circuit/analyses.hpp"
#include "circuit/output/curve_view.hpp"
#include "circuit/run_directives.hpp"
#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::sweeps {
namespace {

using circuit::AnalysisContext;
using circuit::Circuit;
using circuit::RunOutcome;

constexpr std::string_view spike_measures[] = {"spikes", "first_spike", "last_spike", "mean_interval"};

/// The unit of a number of the netlist, from its name; "" if unknown.
std::string unit_of(std::string_view name) {
    if (name.find("spike") != std::string_view::npos && name != "spikes") return "s";
    if (name == "mean_interval") return "s";
    return name.starts_with("v(") ? "V" : name.starts_with("i(") ? "A" : "";
}

/// Runs the analyses of the nominal circuit, to find the names of their results. Transients are left out, because they may take long; so
/// are .expect lines and .meas lines that need a transient or compute with other measurements.
Result<RunOutcome> run_without_transients(const Circuit& circuit) {
    auto without_transients = std::make_shared<Circuit>(circuit);
    std::erase_if(without_transients->directives, [](const circuit::Directive& d) {
        return d.name == "tran" || ((d.name == "meas" || d.name == "measure") && !d.words.empty() && d.words[0] == "tran") ||
               d.name == "expect" || ((d.name == "meas" || d.name == "measure") && d.words.size() > 2 && d.words[2].starts_with("param="));
    });
    circuit::RunOptions run_options;
    run_options.print_tables = false;
    auto context = TRY(AnalysisContext::make(std::move(without_transients)));
    context->is_brief = true;
    return circuit::run_directives(*context, run_options);
}

/// The options of an item's analyses, which only their numbers and spikes are read from.
circuit::RunOptions sweep_run_options(const std::function<bool()>& stop) {
    circuit::RunOptions out;
    out.keep_points = out.print_tables = false;
    out.should_stop = [&stop](std::string_view, double) { return stop(); };
    return out;
}

bool has_directive(const Circuit& circuit, std::string_view name) {
    return std::any_of(circuit.directives.begin(), circuit.directives.end(), [&](const auto& d) { return d.name == name; });
}

/// The names of all numbers that the netlist computes. `without_transients`: see run_without_transients(); no value if that failed.
std::vector<std::string> number_names(const Circuit& circuit, const std::optional<RunOutcome>& without_transients) {
    std::vector<std::string> out;
    const auto add = [&](std::string name) {
        if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(std::move(name));
    };
    if (without_transients)
        for (const auto& a : without_transients->analyses)
            for (const auto& [name, value] : a.result.numbers) add(name);
    if (has_directive(circuit, "tran") && has_directive(circuit, "spike"))
        for (const auto name : spike_measures) add(std::string(name));
    for (const auto& d : circuit.directives)
        if ((d.name == "meas" || d.name == "measure") && d.words.size() > 2) add(d.words[1]);
    for (const auto& d : circuit.directives) {
        if (d.name == "print" && d.words.size() > 1 && d.words[0] == "op")
            for (std::size_t k = 1; k < d.words.size(); ++k) add(d.words[k]);
        if (d.name == "expect" && !d.words.empty()) add(d.words[0].substr(0, d.words[0].find('=')));
    }
    return out;
}

class AnalysesSweep final : public PlannedSweep {
    std::shared_ptr<const Circuit> nominal_;        // without varied values
    std::optional<RunOutcome> without_transients_;  // see run_without_transients(); no value if that failed
    std::vector<std::string> number_names_;         // of all numbers that the netlist computes

    Result<void> open(const SweepText& spec, const std::string& folder) override {
        for (const auto* name : {"force", "rate", "channel", "every"})
            if (const auto* value = spec.get(name))
                return value->error_here(
                    fmt::format("{} applies to afferent = ...; a netlist's own .tran takes its force from .force", name));
        if (const auto probes = spec.top.elements_of("traces"); !probes.empty())
            return probes[0].error_here("traces applies to afferent = ...; for a netlist's own analyses use .meas");
        const auto* orders = spec.get("orders");
        netlist_ = TRY(NetlistFactory::of(*spec.get("netlist"), folder, orders ? orders->text : ""));
        for (const auto& setting : spec.top.settings("set")) TRY(netlist_.set(setting));
        nominal_ = std::make_shared<const Circuit>(TRY(TRY(netlist_.nominal()).elaborate()));
        return {};
    }

    const Circuit* circuit() const override { return nominal_.get(); }
    Result<VariedQuantity> find_quantity(const LocatedText& quantity) override { return netlist_.find_quantity(quantity); }
    /// Selects the measures of the sweep file; without them, all numbers of the netlist.
    Result<void> select_measures(const SweepText& spec) override {
        auto result = run_without_transients(*nominal_);
        // With a transient, an error may be due to its omission.
        if (!result && !has_directive(*nominal_, "tran")) return result.error();
        if (result) without_transients_ = std::move(*result);
        number_names_ = number_names(*nominal_, without_transients_);
        const auto* names = spec.get("measures");
        if (names)
            for (const auto& name : names->elements) TRY(measure_column(name));
        else
            for (const auto& name : number_names_) TRY(measure_column({name, {}}));
        return {};
    }

    Result<std::size_t> measure_column(const LocatedText& name) override {
        for (std::size_t k = 0; k < measures.size(); ++k)
            if (measures[k].name == name.text) return k;
        const auto& known = number_names_;
        const bool is_known = std::find(known.begin(), known.end(), name.text) != known.end();
        const bool is_curve = without_transients_ && without_transients_->find_number(name.text);  // the measure is its last value
        const bool is_node = has_directive(*nominal_, "tran") && name.text.starts_with("v(") && name.text.ends_with(')') &&
                             nominal_->find_node(std::string_view(name.text).substr(2, name.text.size() - 3)) >= 0;
        if (!is_known && !is_curve && !is_node) {
            std::vector<std::string> all = known;
            for (std::size_t n = 1; n < nominal_->nodes.size(); ++n) all.push_back(fmt::format("v({})", nominal_->nodes[n]));
            const std::vector<std::string_view> names(all.begin(), all.end());
            return name.error_here(fmt::format("the netlist has no number '{}'{} (it has {}; voltages are v(NODE), currents i(SOURCE))",
                                               name.text, did_you_mean(name.text, names), known.empty() ? "none" : joined(known)));
        }
        measures.push_back({name.text, unit_of(name.text), ""});
        return measures.size() - 1;
    }

    Result<double> model_value(const LocatedText& model, std::size_t) const override {
        return model.error_here("like: models respond to a force; use it with afferent = ..., not with a netlist's own analyses");
    }

    /// One train for each .tran, if spikes are kept and the netlist has a .spike.
    Result<void> select_outputs(const SweepText& spec, bool keeps_spikes) override {
        if (measures.empty())
            return spec.get("netlist")->error_here(
                "the netlist computes no numbers (.meas, .print op); name the measures: measures = [\"v(out)\"]");
        if (!keeps_spikes || !has_directive(*nominal_, "spike")) return {};
        for (const auto& d : nominal_->directives)
            if (d.name == "tran") train_names.push_back(train_names.empty() ? "tran" : fmt::format("tran {}", train_names.size() + 1));
        return {};
    }

    /// Those of the nominal circuit in all its analyses; 0 if it has no transient.
    Result<std::int64_t> nominal_iterations(const std::function<bool()>& stop) const override {
        if (!has_directive(*nominal_, "tran")) return 0;
        auto context = TRY(AnalysisContext::make(nominal_));
        context->is_brief = true;
        const auto result = TRY(circuit::run_directives(*context, sweep_run_options(stop)));
        return outcome(0, result).iterations;
    }

    ItemOutcome outcome(std::int64_t item, const RunOutcome& result) const {
        auto out = failed_outcome(item, "", ItemEnd::done);
        for (std::size_t k = 0; k < measures.size(); ++k)
            if (const auto value = result.find_number(measures[k].name)) out.measures[k] = *value;
        std::size_t train = 0;
        for (const auto& a : result.analyses) {
            if (a.result.spikes && train < out.spikes.size()) out.spikes[train++] = *a.result.spikes;
            for (const auto& [quantity, count] : a.result.stats) {
                if (quantity == "steps") out.steps += static_cast<std::int64_t>(count);
                if (quantity == "iterations") out.iterations += static_cast<std::int64_t>(count);
            }
        }
        return out;
    }

    /// A thread's analysis context, and the varied netlist values for which it was made.
    struct ThreadContext {
        std::vector<double> values;
        std::unique_ptr<AnalysisContext> context;
    };

    /// Makes the context for an item with these axis values, unless the present context fits. The chip's sample is applied later.
    Result<void> prepare_thread(ThreadContext& thread, std::span<const double> values,
                                const std::optional<circuit::ChipSample>& chip) const {
        auto netlist_values = netlist_.netlist_values(values);
        const bool draws_values = nominal_->has_random_values && chip;
        if (thread.context && thread.values == netlist_values && !draws_values) return {};
        thread.context.reset();
        std::shared_ptr<const Circuit> circuit = nominal_;
        if (netlist_.varies() || draws_values) {
            const auto draws =
                draws_values ? std::optional(circuit::RandomDraws{chip->seed, chip->chip, true, chip->has_mismatch}) : std::nullopt;
            circuit = std::make_shared<const Circuit>(TRY(TRY(netlist_.at(values)).elaborate({}, draws)));
        }
        thread.context = TRY(AnalysisContext::make(std::move(circuit)));
        thread.context->is_brief = true, thread.values = std::move(netlist_values);
        return {};
    }

public:
    Result<void> run_items(const NextItem& next, const OutcomeHandler& on_outcome, const std::function<bool()>& stop) const override {
        ThreadContext thread;
        const auto limit = find_iteration_limit(stop);
        const auto run_options = sweep_run_options(stop);
        while (!stop()) {
            const auto item = next();
            if (!item) return {};
            const auto sample = plan_.chip_sample(*item);
            if (const auto ok = prepare_thread(thread, plan_.values(*item), sample); !ok) {
                on_outcome(failed_outcome(*item, ok.error().text()));
                continue;
            }
            auto& context = *thread.context;
            // A netlist may select one chip by its mismatch seed; otherwise the sweep samples the chip.
            if (const auto fixed_sample = circuit::chip_sample_of(*context.circuit))
                context.apply_variation(*fixed_sample);
            else if (sample)
                context.apply_variation(*sample);
            context.max_iterations = limit, context.hit_iteration_limit = false;
            const auto result = circuit::run_directives(context, run_options);
            if (stop()) return {};  // the result may be incomplete
            if (!result && result.error().code != ErrorCode::not_converged) return result.error();
            on_outcome(result ? outcome(*item, *result)
                              : failed_outcome(*item, result.error().text(),
                                               context.hit_iteration_limit ? ItemEnd::iteration_limit : ItemEnd::diverged));
        }
        return {};
    }
};

}  // namespace

std::unique_ptr<PlannedSweep> new_analysis_sweep() { return std::make_unique<AnalysesSweep>(); }

}  // namespace corpuscle::sweeps
