#include "run/netlist/variant_run.hpp"

#include <algorithm>

#include "circuit/analyses.hpp"
#include "circuit/output/saved_quantities.hpp"

namespace corpuscle {
namespace {

using namespace circuit;

/// True if a transient is repeated with smaller tolerances, to estimate the error of its spikes.
bool checks_spikes(const circuit::Circuit& circuit, bool is_brief) {
    const auto option = circuit.options.find("spikecheck");
    return !is_brief && circuit.has_directive("spike") && (option == circuit.options.end() || option->second != 0);
}

/// The progress of a variant. If there are transients, other analyses are not counted, because transients take most of the time.
class VariantProgress {
    std::size_t analyses_ = 0, transients_ = 0;  // in the netlist; a transient that is repeated counts twice
    std::size_t done_ = 0;                       // number of counted analyses that have ended
    double last_ = 0;                            // last fraction of the current analysis; a smaller one means that the next has begun

public:
    VariantProgress(const circuit::Circuit& circuit, bool is_brief) {
        for (const auto& c : circuit.directives) analyses_ += find_analysis(c.name) != nullptr, transients_ += c.name == "tran";
        if (checks_spikes(circuit, is_brief)) transients_ *= 2;
    }
    /// The finished fraction of the variant when `fraction` of `analysis` ("tran"), the current one, is finished; both 0 to 1.
    double of(std::string_view analysis, double fraction) {
        if (transients_ > 0 && analysis != "tran") return static_cast<double>(done_) / static_cast<double>(transients_);
        if (fraction < last_) ++done_;
        last_ = fraction;
        const auto all = static_cast<double>(transients_ > 0 ? transients_ : std::max<std::size_t>(analyses_, 1));
        return std::min((static_cast<double>(done_) + fraction) / all, 1.0);
    }
};

/// The circuits of successive variants with the selected analysis. Variants that share a circuit share the result, too.
class SelectedCircuits {
    const std::optional<AnalysisSelection>& selection_;
    std::shared_ptr<const circuit::Circuit> original_, selected_;

public:
    explicit SelectedCircuits(const std::optional<AnalysisSelection>& selection) : selection_(selection) {}
    Result<std::shared_ptr<const circuit::Circuit>> of(const std::shared_ptr<const circuit::Circuit>& circuit) {
        if (!selection_) return circuit;
        if (circuit != original_) {
            selected_ = std::make_shared<const circuit::Circuit>(TRY(select_analysis(*circuit, *selection_)));
            original_ = circuit;
        }
        return selected_;
    }
};

/// Creates the analysis context of a variant, or reuses `context` if the circuit is the same, as for the chips of .mc. `brief`: analyses
/// make no tables and no warnings.
Result<void> prepare(std::unique_ptr<AnalysisContext>& context, const Variant& variant, bool brief) {
    if (!context || context->circuit != variant.circuit) context = TRY(AnalysisContext::make(variant.circuit));
    context->is_brief = brief;
    if (variant.sample) context->apply_variation(*variant.sample);
    return {};
}

/// Runs one variant. `should_continue` gets the completed fraction of the variant.
Result<RunOutcome> run_variant(AnalysisContext& context, const Variant& variant, RunOptions options,
                               const std::function<bool(double)>& should_continue) {
    VariantProgress progress(*variant.circuit, context.is_brief);
    bool is_stopped = false;
    options.should_stop = [&](std::string_view analysis, double fraction) {
        return is_stopped = is_stopped || !should_continue(progress.of(analysis, fraction));
    };
    auto outcome = circuit::run_directives(context, options);
    if (is_stopped) return interrupted_error();
    return outcome;
}

}  // namespace

Result<Netlist> change_netlist(const NetlistOpener& open, const std::string& name, const NetlistChanges& changes,
                               std::string_view probe_option) {
    const auto applied = TRY(apply_overrides(open, name, changes.overrides));  // all overrides are for this netlist, so none is unused
    const auto& netlist = applied.result;
    if (changes.probes.empty()) return netlist;
    const auto circuit = TRY(netlist.elaborate());
    auto overrides = netlist.overrides();
    for (const auto& probe : changes.probes) {
        const auto found = TRY(resolve_probe(circuit, probe));
        if (!found)
            return bad_input(
                fmt::format("{}{}: {} has no such node or device{}", probe_option, probe, name, suggest_probe(circuit, probe)));
        overrides.saved.push_back(*found);
    }
    return netlist.with_overrides(std::move(overrides));
}

Result<void> run_variants(NetlistVariants& variants, const std::optional<AnalysisSelection>& selection, VariantHandler& handler,
                          const std::function<bool(double)>& should_continue) {
    const auto count = variants.count();
    SelectedCircuits circuits(selection);
    std::unique_ptr<AnalysisContext> context;
    for (std::size_t k = 0; k < count; ++k) {
        const auto go_on = [&](double fraction) {
            return should_continue((static_cast<double>(k) + fraction) / static_cast<double>(count));
        };
        auto variant = TRY(variants.at(k));
        variant.circuit = TRY(circuits.of(variant.circuit));
        TRY(prepare(context, variant, /* brief = */ k > 0 || variants.has_chips()));
        auto outcome = run_variant(*context, variant, TRY(handler.begin(variant, *context)), go_on);
        if (!outcome && outcome.error().code == ErrorCode::interrupted) return outcome.error();
        if (!go_on(1)) return interrupted_error();
        if (outcome) {
            TRY(handler.end(variant, std::move(*outcome)));
        } else if (outcome.error().code == ErrorCode::not_converged && count > 1) {
            handler.fail(variant, outcome.error());
        } else {
            auto error = outcome.error();
            if (!variant.label.empty()) error.message = fmt::format("{}: {}", variant.label, error.message);
            return error;
        }
    }
    return {};
}

Error error_of_failures(const std::vector<Error>& failures, std::size_t count) {
    auto error = failures.at(0);
    error.message = fmt::format("{} of {} did not converge; the first: {}", failures.size(), count, error.message);
    return error;
}

Result<void> check_expectations_met(const RunOutcome& outcome, std::string_view label) {
    for (const auto& e : outcome.expectations)
        if (!e.is_met)
            return bad_input(fmt::format("{}{}{} is {:g}, not {:g} within {:g}", label, label.empty() ? "" : ": ", e.name, e.actual,
                                         e.expected, e.tolerance),
                             e.location);
    return {};
}

}  // namespace corpuscle
