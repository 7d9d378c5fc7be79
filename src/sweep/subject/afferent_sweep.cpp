// The common part of the sweeps over models and netlist afferents: force, measures, probes.

#include <fmt/format.h>
#include <cmath>

#include "core/text/quantity.hpp"
#include "run/afferent_plan.hpp"
#include "run/simulate.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::sweeps {
namespace {

/// The sampling step of the probes in the results (key every), in samples of the force. T: step of the force, s.
Result<std::size_t> probe_stride(const ConfigNode* given, double T) {
    double every = 1e-3;
    if (given) {
        every = TRY(given->located(parse_quantity(given->text, "s"), "every: "));
        if (!(every > 0 && every < 1e9)) return given->error_here(fmt::format("every = {} must be above 0 s and below 1e9 s", given->text));
    }
    return static_cast<std::size_t>(std::max(1.0, std::round(every / T)));
}

}  // namespace

Result<SimulatedResponse> simulate_afferent(const Afferent& afferent, const SweepForce& force, std::span<const std::size_t> probes,
                                            std::size_t every, const std::function<bool()>& stop) {
    const auto response = TRY(simulate(afferent, force.samples, {probes, every, stop}));
    SimulatedResponse out;
    for (const auto& values : response.probes) out.probe_samples.emplace_back(values.begin(), values.end());
    for (const auto& s : response.spikes)
        if (s.step <= static_cast<std::int64_t>(force.samples.size())) out.spikes.push_back(force.clock.time(s.step, s.offset));
    return out;
}

Result<void> AfferentSweep::open_force(const SweepText& spec, const std::string& folder) {
    if (const auto* orders = spec.get("orders"))
        return orders->error_here("orders applies to netlist = ...; an afferent = ... responds to its force");
    const auto seed = TRY(seed_of(spec));
    force_ = TRY(ForceFactory::of(spec, folder, seed));
    return {};
}

Result<VariedQuantity> AfferentSweep::find_quantity(const LocatedText& quantity) {
    return force_.has_parameter(quantity.text) ? force_.find_quantity(quantity) : find_afferent_quantity(quantity);
}

Result<void> AfferentSweep::select_measures(const SweepText& spec) {
    TRY(force_.prepare());
    afferent_measures_ = std::make_unique<AfferentMeasures>(*force_.nominal(), circuit() != nullptr, range_names());
    TRY(afferent_measures_->select(spec.get("measures")));
    measures = afferent_measures_->columns();
    return {};
}

Result<std::size_t> AfferentSweep::measure_column(const LocatedText& measure) {
    const auto column = TRY(afferent_measures_->require_column(measure));
    if (column == measures.size()) measures.push_back(afferent_measures_->columns().back());
    return column;
}

Result<double> AfferentSweep::model_value(const LocatedText& model, std::size_t column) const {
    if (force_.varies())
        return model.error_here("like: the force varies between items, and so does a model's response; write numbers instead");
    const auto plan = TRY(model.located(plan_any_afferent(model.text), "like: "));
    const auto& force = *force_.nominal();
    const auto afferent = make_afferent(plan.result, {force.clock.T()});
    const auto response = TRY(simulate_afferent(*afferent, force));
    AfferentMeasures of_model(force, false, {});
    const auto measure = TRY(of_model.require_column({measures[column].name, model.location}));
    return of_model.values(force, response.spikes)[measure];
}

Result<void> AfferentSweep::select_outputs(const SweepText& spec, bool keeps_spikes) {
    if (keeps_spikes) train_names = {subject_name()};
    const auto probes = spec.top.elements_of("traces");
    if (probes.empty()) return {};
    for (const auto& probe : probes) TRY(add_probe(probe));
    const auto& force = *force_.nominal();
    every_ = TRY(probe_stride(spec.get("every"), force.clock.T()));
    for (std::size_t k = 0; k < force.samples.size(); k += every_) probe_times.push_back(force.clock.time(static_cast<std::int64_t>(k)));
    return {};
}

}  // namespace corpuscle::sweeps
