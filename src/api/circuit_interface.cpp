#include <ranges>

#include "api/circuit_columns.hpp"
#include "api/result.hpp"
#include "circuit/analyses.hpp"
#include "run/netlist/variant_run.hpp"

namespace corpuscle {
namespace {

using api::value_or_throw;

constexpr auto always = [](double) { return true; };

CircuitAnalysis description_of(circuit::AnalysisRun&& run) {
    return {run.directive->name, std::move(run.result.table), std::move(run.result.stats), std::move(run.result.spikes)};
}

/// Collects the results of all variants.
class ResultCollector final : public VariantHandler {
    CircuitResult result_;
    api::ColumnCollector columns_;
    std::vector<Error> failures_;
    bool has_steps_;

public:
    explicit ResultCollector(bool has_steps) : has_steps_(has_steps) {}

    Result<circuit::RunOptions> begin(const circuit::Variant&, circuit::AnalysisContext&) override {
        columns_.plots.clear();
        return circuit::RunOptions{.curve_sink = &columns_, .keep_points = false, .print_tables = false};
    }
    Result<void> end(const circuit::Variant& variant, circuit::RunOutcome&& outcome) override {
        auto& to = add(variant);
        to.plots = std::move(columns_.plots);
        api::name_analyses(to.plots, outcome);
        to.measures = std::move(outcome.numbers);
        for (const auto& e : outcome.expectations) to.expectations.push_back({e.name, e.actual, e.expected, e.tolerance, e.is_met});
        for (const auto& warning : outcome.warnings) to.warnings.push_back(warning.text());
        if (const auto met = check_expectations_met(outcome, variant.label); !met) to.warnings.push_back(met.error().text());
        for (auto& analysis : outcome.analyses) to.analyses.push_back(description_of(std::move(analysis)));
        return {};
    }
    void fail(const circuit::Variant& variant, const Error& error) override {
        add(variant).error = error.text();
        failures_.push_back(error);
    }
    /// The result; throws if no step converged.
    CircuitResult finish(std::size_t count) {
        if (!failures_.empty()) {
            const auto error = error_of_failures(failures_, count);
            if (failures_.size() == count) api::throw_error(error);
            result_.warnings.push_back(error.text());
        }
        return std::move(result_);
    }

private:
    CircuitResult& add(const circuit::Variant& variant) {
        result_.title = variant.circuit->title;
        if (!has_steps_) return result_;
        auto& step = result_.steps.emplace_back();
        step.title = variant.circuit->title, step.step = variant.label;
        return step;
    }
};

}  // namespace

struct Circuit::Impl {
    std::string name;
    circuit::NetlistVariants variants;
    std::shared_ptr<const circuit::Circuit> nominal;  // the first variant

    CircuitResult run(const std::optional<circuit::AnalysisSelection>& selection, const Progress& progress) const {
        auto copy = variants;  // at() changes it
        ResultCollector collector(copy.count() > 1);
        value_or_throw(run_variants(copy, selection, collector, progress ? progress : always));
        return collector.finish(copy.count());
    }
    static std::shared_ptr<const Impl> make(const std::string& name, const circuit::NetlistOpener& open, const CircuitSettings& settings) {
        NetlistChanges changes{{}, settings.probes};
        for (const auto& text : settings.settings) changes.overrides.push_back(value_or_throw(circuit::parse_netlist_override(name, text)));
        auto variants = value_or_throw(circuit::NetlistVariants::create(value_or_throw(change_netlist(open, name, changes, ""))));
        auto nominal = value_or_throw(variants.at(0)).circuit;
        return std::make_shared<const Impl>(Impl{name, std::move(variants), std::move(nominal)});
    }
};

Circuit::Circuit(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

Circuit::Circuit(const std::string& name_or_path, const CircuitSettings& settings)
    : impl_(Impl::make(name_or_path, [&](const std::string& corner) { return circuit::open_netlist(name_or_path, corner); }, settings)) {}

Circuit Circuit::from_text(const std::string& text, const CircuitSettings& settings, const std::string& name) {
    return Circuit(Impl::make(name, [&](const std::string& corner) { return circuit::Netlist::parse_text(text, name, corner); }, settings));
}

CircuitResult Circuit::run(const Progress& progress) const { return impl_->run({}, progress); }

CircuitResult Circuit::analyse(const std::string& analysis, const std::vector<std::string>& words, const Progress& progress) const {
    return impl_->run(circuit::AnalysisSelection{analysis, words}, progress);
}

const std::string& Circuit::name() const { return impl_->name; }
const std::string& Circuit::title() const { return impl_->nominal->title; }

std::vector<std::string> Circuit::nodes() const {
    const auto& all = impl_->nominal->nodes;
    return {all.begin() + 1, all.end()};
}

std::vector<std::string> Circuit::elements() const {
    std::vector<std::string> out;
    for (const auto& e : impl_->nominal->elements) out.push_back(e.name);
    return out;
}

std::vector<CircuitAnalysisDescription> circuit_analyses() {
    std::vector<CircuitAnalysisDescription> out;
    for (const auto* a : circuit::analyses) out.push_back({std::string(a->name), std::string(a->usage), std::string(a->description)});
    return out;
}

}  // namespace corpuscle
