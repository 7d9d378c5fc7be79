// A sweep over a netlist's own analyses (.op, .tran, .meas ...). Each thread has one analysis context, in which it runs the analyses for
// one item after another.

#include <fmt/format.h>
#include <algorithm>
#include <mutex>

#include "circuit/analyses.hpp"
#include "circuit/output/curve_view.hpp"
#include "circuit/run_directives.hpp"
#include "core/parameter.hpp"
#include "sweep/subject/netlist_factory.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::sweeps {
namespace {

using circuit::AnalysisContext;
using circuit::Circuit;
using circuit::RunOutcome;

constexpr std::string_view spike_measures[] = {"spikes", "first_spike", "last_spike", "mean_interval"};

class AnalysesSweep final : public PlannedSweep {
    NetlistFactory netlist_{};
    std::shared_ptr<const Circuit> nominal_;               // without varied values
    long iteration_limit_ = 0;                             // iteration limit in the sweep file; 0: the file has none
    mutable std::mutex mutex_;                             // protects nominal_iteration_limit_
    mutable std::optional<long> nominal_iteration_limit_;  // see find_iteration_limit(); no value: not yet computed

    long find_iteration_limit(const std::function<bool()>& stop) const;
    Result<void> select_measures(const SweepText&);
    Result<void> select_trains(const SweepText&);
    /// `truncated`: whether an error in the result means that the item reached its iteration limit.
    ItemOutcome outcome(std::int64_t item, const Result<RunOutcome>&, bool truncated = false) const;

    /// A thread's analysis context, and the varied netlist values for which it was made.
    struct ThreadContext {
        std::vector<double> values;
        std::unique_ptr<AnalysisContext> context;
    };
    /// Makes the context for an item with these axis values, unless the present context fits. The chip's sample is applied later.
    Result<void> prepare(ThreadContext&, std::span<const double> values) const;

public:
    static Result<std::unique_ptr<Sweep>> make(const SweepText&, const std::string& folder);
    Result<void> run_items(const NextItem&, const OutcomeHandler&, const std::function<bool()>& stop) const override;
};

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

/// Selects the measures of the sweep file; without them, all numbers of the netlist. Then sets the limits.
Result<void> AnalysesSweep::select_measures(const SweepText& spec) {
    const auto result = run_without_transients(*nominal_);
    std::optional<RunOutcome> without_transients;
    if (result) without_transients = *result;
    // With a transient, an error may be due to its omission.
    if (!result && !has_directive(*nominal_, "tran")) return result.error();
    const auto known = number_names(*nominal_, without_transients);
    const auto column = [&](const LocatedText& name) -> Result<std::size_t> {
        for (std::size_t k = 0; k < measures_.size(); ++k)
            if (measures_[k].name == name.text) return k;
        const bool is_known = std::find(known.begin(), known.end(), name.text) != known.end();
        const bool is_curve = without_transients && without_transients->find_number(name.text);  // the measure is its last value
        const bool is_node = has_directive(*nominal_, "tran") && name.text.starts_with("v(") && name.text.ends_with(')') &&
                             nominal_->find_node(std::string_view(name.text).substr(2, name.text.size() - 3)) >= 0;
        if (!is_known && !is_curve && !is_node) {
            std::vector<std::string> all = known;
            for (std::size_t n = 1; n < nominal_->nodes.size(); ++n) all.push_back(fmt::format("v({})", nominal_->nodes[n]));
            const std::vector<std::string_view> names(all.begin(), all.end());
            return name.error_here(fmt::format("the netlist has no number '{}'{} (it has {}; voltages are v(NODE), currents i(SOURCE))",
                                               name.text, did_you_mean(name.text, names),
                                               known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
        }
        measures_.push_back({name.text, unit_of(name.text), ""});
        return measures_.size() - 1;
    };
    if (spec.measures) {
        for (const auto& name : *spec.measures) TRY(column(name));
    } else {
        for (const auto& name : known) TRY(column({name, {}}));
    }
    const MeasureLookup lookup{
        column, [](const LocatedText& model, std::size_t) -> Result<double> {
            return model.error_here("like: models respond to a force; use it with afferent = ..., not with a netlist's own analyses");
        }};
    TRY(set_limits(spec, lookup, measures_));
    if (measures_.empty())
        return spec.netlist->error_here("the netlist computes no numbers (.meas, .print op); name the measures: measures = [\"v(out)\"]");
    return {};
}

/// One train for each .tran, if spikes are kept and the netlist has a .spike.
Result<void> AnalysesSweep::select_trains(const SweepText& spec) {
    if (!spec.probes.empty()) return spec.probes[0].error_here("traces applies to afferent = ...; for a netlist's own analyses use .meas");
    const auto keeps = TRY(keeps_spikes(spec));
    if (!keeps || !has_directive(*nominal_, "spike")) return {};
    for (const auto& d : nominal_->directives)
        if (d.name == "tran") train_names_.push_back(train_names_.empty() ? "tran" : fmt::format("tran {}", train_names_.size() + 1));
    return {};
}

Result<std::unique_ptr<Sweep>> AnalysesSweep::make(const SweepText& spec, const std::string& folder) {
    auto out = std::make_unique<AnalysesSweep>();
    auto& s = *out;
    for (const auto& [name, value] :
         {std::pair{"force", &spec.force}, {"rate", &spec.rate}, {"channel", &spec.channel}, {"every", &spec.every}})
        if (*value)
            return (*value)->error_here(
                fmt::format("{} applies to afferent = ...; a netlist's own .tran takes its force from .force", name));
    s.netlist_ = TRY(NetlistFactory::of(*spec.netlist, folder, spec.directives ? spec.directives->text : ""));
    for (const auto& setting : spec.settings) TRY(s.netlist_.set(setting));
    const auto nominal = TRY(s.netlist_.nominal());
    auto elaborated = TRY(nominal.elaborate());
    s.nominal_ = std::make_shared<const Circuit>(std::move(elaborated));
    auto variants = TRY(circuit::NetlistVariants::create(nominal));
    VariableQuantities quantities;
    quantities.subject_name = s.netlist_.name(), quantities.can_sample_chips = true;
    quantities.find_quantity = [&](const LocatedText& quantity) { return s.netlist_.find_quantity(quantity); };
    quantities.vary = [&](const SweepAxis& a, const std::string& quantity, std::size_t axis) {
        s.netlist_.vary(quantity, axis, a.column.labels);
    };
    s.plan_ = TRY(plan_of(spec, quantities, &variants));
    if (s.plan_.samples_chips() && s.nominal_->mismatch_seed)
        return bad_input("[set] selects one chip by mismatch = ..., but the sweep samples others; remove one of the two", {spec.file});
    if (spec.iterations) {
        const auto limit = TRY(parse_integer(*spec.iterations, "iterations", 1, 1e12));
        s.iteration_limit_ = static_cast<long>(limit);
    }
    TRY(s.select_measures(spec));
    TRY(s.select_trains(spec));
    s.metadata_ = first_metadata(spec, s.nominal_->title);
    for (auto& entry : s.netlist_.metadata()) s.metadata_.push_back(std::move(entry));
    s.add_mismatch_metadata(s.netlist_.name(), *s.nominal_);
    return std::unique_ptr<Sweep>(std::move(out));
}

Result<void> AnalysesSweep::prepare(ThreadContext& thread, std::span<const double> values) const {
    auto netlist_values = netlist_.netlist_values(values);
    if (thread.context && thread.values == netlist_values) return {};
    thread.context.reset();
    std::shared_ptr<const Circuit> circuit = nominal_;
    if (netlist_.varies()) {
        const auto netlist = TRY(netlist_.at(values));
        auto elaborated = TRY(netlist.elaborate());
        circuit = std::make_shared<const Circuit>(std::move(elaborated));
    }
    auto context = TRY(AnalysisContext::make(std::move(circuit)));
    thread.context = std::move(context), thread.context->is_brief = true, thread.values = std::move(netlist_values);
    return {};
}

/// Iteration limit of each transient: from the sweep file, otherwise iteration_limit_factor times the iterations of the nominal circuit in
/// all its analyses. 0: no limit, because there is no transient, the nominal circuit fails, or `stop` returned true.
long AnalysesSweep::find_iteration_limit(const std::function<bool()>& stop) const {
    if (iteration_limit_ > 0 || !has_directive(*nominal_, "tran")) return iteration_limit_;
    const std::lock_guard lock(mutex_);
    if (nominal_iteration_limit_) return *nominal_iteration_limit_;
    auto context = AnalysisContext::make(nominal_);
    if (!context) return 0;
    (*context)->is_brief = true;
    circuit::RunOptions run_options;
    run_options.keep_points = run_options.print_tables = false;
    run_options.should_stop = [&](std::string_view, double) { return stop(); };
    const auto result = circuit::run_directives(**context, run_options);
    if (!result && result.error().code == ErrorCode::interrupted) return 0;
    nominal_iteration_limit_ = result ? static_cast<long>(iteration_limit_factor * static_cast<double>(outcome(0, result).iterations)) : 0;
    return *nominal_iteration_limit_;
}

ItemOutcome AnalysesSweep::outcome(std::int64_t item, const Result<RunOutcome>& result, bool truncated) const {
    ItemOutcome out;
    out.item = item;
    out.measures.assign(measures_.size(), std::numeric_limits<double>::quiet_NaN());
    out.spikes.resize(train_names_.size());
    if (!result) {
        out.end = truncated ? ItemEnd::iteration_limit : ItemEnd::diverged, out.reason = result.error().text();
        return out;
    }
    for (std::size_t k = 0; k < measures_.size(); ++k)
        if (const auto value = result->find_number(measures_[k].name)) out.measures[k] = *value;
    std::size_t train = 0;
    for (const auto& a : result->analyses) {
        if (a.result.spikes && train < out.spikes.size()) out.spikes[train++] = *a.result.spikes;
        for (const auto& [quantity, count] : a.result.stats) {
            if (quantity == "steps") out.steps += static_cast<std::int64_t>(count);
            if (quantity == "iterations") out.iterations += static_cast<std::int64_t>(count);
        }
    }
    return out;
}

Result<void> AnalysesSweep::run_items(const NextItem& next, const OutcomeHandler& on_outcome, const std::function<bool()>& stop) const {
    ThreadContext thread;
    const auto limit = find_iteration_limit(stop);
    circuit::RunOptions run_options;
    run_options.keep_points = run_options.print_tables = false;
    run_options.should_stop = [&](std::string_view, double) { return stop(); };
    while (!stop()) {
        const auto item = next();
        if (!item) return {};
        if (const auto ok = prepare(thread, plan_.values(*item)); !ok) {
            on_outcome(outcome(*item, ok.error()));
            continue;
        }
        auto& context = *thread.context;
        // A netlist may select one chip by its mismatch seed; otherwise the sweep samples the chip.
        if (const auto fixed_sample = circuit::chip_sample_of(*context.circuit))
            context.apply_variation(*fixed_sample);
        else if (const auto sample = plan_.chip_sample(*item))
            context.apply_variation(*sample);
        context.max_iterations = limit, context.hit_iteration_limit = false;
        const auto result = circuit::run_directives(context, run_options);
        if (!result && result.error().code == ErrorCode::interrupted) return {};
        if (!result && result.error().code != ErrorCode::not_converged) return result.error();
        on_outcome(outcome(*item, result, context.hit_iteration_limit));
    }
    return {};
}

}  // namespace

Result<std::unique_ptr<Sweep>> make_analysis_sweep(const SweepText& spec, const std::string& folder) {
    return AnalysesSweep::make(spec, folder);
}

}  // namespace corpuscle::sweeps
