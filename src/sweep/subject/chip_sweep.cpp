// A sweep over an afferent that is a netlist. Each item is a chip: a design, and a sample of process and mismatch if these are sampled.
// Designs differ if netlist values vary. Many chips are simulated in parallel.

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/output/resolve_probe.hpp"
#include "core/parameter.hpp"
#include "sweep/subject/netlist_factory.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::sweeps {
namespace {

using circuit::Chip;
using circuit::ChipResponse;
using circuit::CircuitAfferentFactory;
using DesignPointer = std::shared_ptr<const CircuitAfferentFactory>;  // a netlist with one set of values

constexpr std::size_t max_cached_designs = 16;

class ChipSweep final : public PlannedSweep {
    NetlistFactory netlist_{};
    ForceFactory force_;
    DesignPointer nominal_;  // without varied values
    std::unique_ptr<AfferentMeasures> afferent_measures_;
    std::size_t every_ = 0;  // sampling step of the probes, in samples of the force; 0: no probes
    std::size_t lanes_ = circuit::BatchOptions{}.lanes;
    long iteration_limit_ = 0;  // iteration limit in the sweep file; 0: the file has none

    mutable std::mutex designs_mutex_;
    mutable std::map<std::vector<double>, Result<DesignPointer>> designs_;  // recent designs, by their varied netlist values
    mutable std::mutex nominal_mutex_;                                      // protects nominal_iteration_limit_
    mutable std::optional<long> nominal_iteration_limit_;                   // see find_iteration_limit(); no value: not yet computed

    /// Force and design of a chip that is being simulated.
    struct ActiveChip {
        std::shared_ptr<const SweepForce> force;
        DesignPointer design;
    };

    /// Applies the fixed settings of the sweep file.
    Result<void> apply_settings(const SweepText&);
    Result<void> select_measures(const SweepText&);
    Result<void> select_probes(const SweepText&);
    /// The design for an item with these axis values.
    Result<DesignPointer> design(std::span<const double> values) const;
    /// The sample that the netlist itself fixes by its mismatch seed, otherwise the one that the sweep draws for the item.
    std::optional<circuit::ChipSample> chip_sample(std::int64_t item, const CircuitAfferentFactory&) const;
    long find_iteration_limit(const std::function<bool()>& stop) const;
    ItemOutcome outcome(std::int64_t item, const ActiveChip&, ChipResponse&&) const;
    /// The outcome of an item that did not converge or whose netlist is wrong.
    ItemOutcome failed_outcome(std::int64_t item, const Error&) const;

public:
    static Result<std::unique_ptr<Sweep>> make(const SweepText&, const std::string& folder);
    void set_lanes(std::size_t lanes) override { lanes_ = lanes; }
    Result<void> run_items(const NextItem&, const OutcomeHandler&, const std::function<bool()>& stop) const override;
};

Result<void> ChipSweep::apply_settings(const SweepText& spec) {
    for (const auto& s : spec.settings) TRY(force_.has_parameter(s.name) ? force_.set(s) : netlist_.set(s));
    return {};
}

/// Selects the measures, and sets their limits.
Result<void> ChipSweep::select_measures(const SweepText& spec) {
    std::vector<std::string> ranges;
    for (const auto& w : nominal_->operating_ranges) ranges.emplace_back(w.range().quantity);
    afferent_measures_ = std::make_unique<AfferentMeasures>(*force_.nominal(), true, ranges);
    TRY(afferent_measures_->select(spec.measures));
    const MeasureLookup lookup{[&](const LocatedText& name) { return afferent_measures_->require_column(name); },
                               [&](const LocatedText& model, std::size_t column) {
                                   return model_measure(model, force_, {afferent_measures_->columns()[column].name, model.location});
                               }};
    TRY(set_limits(spec, lookup, afferent_measures_->columns()));
    measures_ = afferent_measures_->columns();
    return {};
}

/// Selects the probes that are written to the results, instead of those in the netlist's .save.
Result<void> ChipSweep::select_probes(const SweepText& spec) {
    for (const auto& probe : spec.probes) {
        const auto found = circuit::resolve_probe(*nominal_->circuit, probe.text);
        if (!found) return probe.error_here(found.error().message);
        if (!*found)
            return probe.error_here(fmt::format("traces: {} has no node or device '{}'{}", netlist_.name(), probe.text,
                                                circuit::suggest_probe(*nominal_->circuit, probe.text)));
        probe_names_.push_back(**found);
    }
    if (probe_names_.empty()) return {};
    netlist_.save(probe_names_);
    const auto netlist = TRY(netlist_.nominal());
    nominal_ = TRY(CircuitAfferentFactory::create(netlist));
    const auto& force = *force_.nominal();
    every_ = TRY(probe_stride(spec, force.clock.T()));
    for (std::size_t k = 0; k < force.samples.size(); k += every_) probe_times_.push_back(force.clock.time(static_cast<std::int64_t>(k)));
    return {};
}

Result<std::unique_ptr<Sweep>> ChipSweep::make(const SweepText& spec, const std::string& folder) {
    auto out = std::make_unique<ChipSweep>();
    auto& s = *out;
    if (spec.directives) return spec.directives->error_here("orders applies to netlist = ...; an afferent = ... responds to its force");
    s.netlist_ = TRY(NetlistFactory::of(*spec.afferent, folder));
    const auto seed = TRY(seed_of(spec));
    s.force_ = TRY(ForceFactory::of(spec, folder, seed));
    TRY(s.apply_settings(spec));
    const auto nominal = TRY(s.netlist_.nominal());
    s.nominal_ = TRY(CircuitAfferentFactory::create(nominal));
    auto variants = TRY(circuit::NetlistVariants::create(nominal));
    VariableQuantities quantities;
    quantities.subject_name = s.netlist_.name(), quantities.can_sample_chips = true;
    quantities.find_quantity = [&](const LocatedText& quantity) {
        return s.force_.has_parameter(quantity.text) ? s.force_.find_quantity(quantity) : s.netlist_.find_quantity(quantity);
    };
    quantities.vary = [&](const SweepAxis& a, const std::string& quantity, std::size_t axis) {
        s.force_.has_parameter(quantity) ? s.force_.vary(quantity, axis) : s.netlist_.vary(quantity, axis, a.column.labels);
    };
    s.plan_ = TRY(plan_of(spec, quantities, &variants));
    if (s.plan_.samples_chips() && s.nominal_->circuit->mismatch_seed)
        return bad_input("[set] selects one chip by mismatch = ..., but the sweep samples others; remove one of the two", {spec.file});
    if (spec.iterations) {
        const auto limit = TRY(parse_integer(*spec.iterations, "iterations", 1, 1e12));
        s.iteration_limit_ = static_cast<long>(limit);
    }
    TRY(s.force_.prepare());
    TRY(s.select_measures(spec));
    const auto keeps = TRY(keeps_spikes(spec));
    if (keeps) s.train_names_ = {s.netlist_.name()};
    TRY(s.select_probes(spec));
    s.metadata_ = first_metadata(spec, s.nominal_->circuit->title);
    for (auto& entry : s.netlist_.metadata()) s.metadata_.push_back(std::move(entry));
    if (auto recorded = s.force_.recording_summary(); !recorded.empty())
        s.metadata_.push_back({"recording " + s.force_.name(), std::move(recorded)});
    s.add_mismatch_metadata(s.netlist_.name(), *s.nominal_->circuit);
    return std::unique_ptr<Sweep>(std::move(out));
}

Result<DesignPointer> ChipSweep::design(std::span<const double> values) const {
    if (!netlist_.varies()) return nominal_;
    const auto netlist_values = netlist_.netlist_values(values);
    {
        const std::lock_guard lock(designs_mutex_);
        if (const auto at = designs_.find(netlist_values); at != designs_.end()) return at->second;
    }
    const auto netlist = netlist_.at(values);
    const auto new_design = netlist ? CircuitAfferentFactory::create(*netlist) : Result<DesignPointer>(netlist.error());
    const std::lock_guard lock(designs_mutex_);
    if (designs_.size() >= max_cached_designs) designs_.clear();
    designs_.emplace(netlist_values, new_design);
    return new_design;
}

std::optional<circuit::ChipSample> ChipSweep::chip_sample(std::int64_t item, const CircuitAfferentFactory& design) const {
    if (auto fixed_sample = circuit::chip_sample_of(*design.circuit)) return fixed_sample;
    return plan_.chip_sample(item);
}

/// Iteration limit of an item: from the sweep file, otherwise iteration_limit_factor times the iterations of the nominal chip with the
/// nominal force. 0: no limit, because the nominal chip fails or `stop` returned true.
long ChipSweep::find_iteration_limit(const std::function<bool()>& stop) const {
    if (iteration_limit_ > 0) return iteration_limit_;
    const std::lock_guard lock(nominal_mutex_);
    if (nominal_iteration_limit_) return *nominal_iteration_limit_;
    const auto& force = *force_.nominal();
    circuit::BatchOptions options;
    options.should_stop = stop;
    const auto response =
        circuit::run_chip_scalar({0, nominal_, circuit::chip_sample_of(*nominal_->circuit), force.samples, force.clock.T()}, options);
    if (response.error && response.error->code == ErrorCode::interrupted) return 0;
    nominal_iteration_limit_ =
        response.error ? 0 : static_cast<long>(iteration_limit_factor * static_cast<double>(response.stats.iterations));
    return *nominal_iteration_limit_;
}

ItemOutcome ChipSweep::failed_outcome(std::int64_t item, const Error& error) const {
    ItemOutcome out;
    out.item = item, out.end = ItemEnd::diverged, out.reason = error.text();
    out.measures.assign(measures_.size(), std::numeric_limits<double>::quiet_NaN());
    out.spikes.resize(train_names_.size());
    out.probes.assign(probe_names_.size(), std::vector<float>(probe_times_.size(), std::numeric_limits<float>::quiet_NaN()));
    return out;
}

ItemOutcome ChipSweep::outcome(std::int64_t item, const ActiveChip& chip, ChipResponse&& response) const {
    auto out = response.error ? failed_outcome(item, *response.error) : ItemOutcome{};
    out.item = item, out.ran_alone = response.is_scalar;
    out.steps = response.stats.steps, out.iterations = response.stats.iterations;
    if (response.error) return out;
    if (response.hit_iteration_limit)
        out.end = ItemEnd::iteration_limit, out.reason = fmt::format("stopped after {} iterations", response.stats.iterations);
    ItemResponse measured;
    measured.spikes = response.spikes, measured.iterations = static_cast<double>(response.stats.iterations);
    const double T = chip.force->clock.T(), seconds = response.energy_use.seconds;
    measured.power = response.energy_use.supplies / seconds, measured.sensor_power = response.energy_use.sensor / seconds;
    for (const auto& o : response.range_violations) {
        measured.time_outside_ranges.push_back(static_cast<double>(o.samples) * T);
        measured.time_outside = std::max(measured.time_outside, measured.time_outside_ranges.back());
    }
    measured.time_outside_ranges.resize(nominal_->operating_ranges.size());
    out.measures = response.hit_iteration_limit ? std::vector<double>(measures_.size(), std::numeric_limits<double>::quiet_NaN())
                                                : afferent_measures_->values(*chip.force, measured);
    if (!train_names_.empty()) out.spikes.push_back(std::move(response.spikes));
    out.probes = std::move(response.probes);
    out.probes.resize(probe_names_.size());
    for (auto& t : out.probes) t.resize(probe_times_.size(), std::numeric_limits<float>::quiet_NaN());
    return out;
}

Result<void> ChipSweep::run_items(const NextItem& next, const OutcomeHandler& on_outcome, const std::function<bool()>& stop) const {
    circuit::BatchOptions options;
    options.should_stop = stop, options.probe_every = every_, options.lanes = lanes_;
    options.max_iterations = find_iteration_limit(stop);
    std::map<std::int64_t, ActiveChip> active;  // by item; keeps forces and designs alive
    std::optional<Error> sweep_error;
    const auto chip_of = [&](std::int64_t item, ActiveChip& at) {
        return Chip{item, at.design, chip_sample(item, *at.design), at.force->samples, at.force->clock.T()};
    };
    const auto next_chip = [&]() -> std::optional<Chip> {
        while (!stop() && !sweep_error) {
            const auto item = next();
            if (!item) return {};
            const auto values = plan_.values(*item);
            const auto force = force_.at(values);
            if (!force) return sweep_error = force.error(), std::nullopt;
            const auto item_design = design(values);
            if (!item_design) {
                on_outcome(failed_outcome(*item, item_design.error()));
                continue;
            }
            ActiveChip at{*force, *item_design};
            if (at.design == nominal_ || same_devices(*at.design->circuit, *nominal_->circuit)) {
                auto& active_chip = active[*item] = std::move(at);
                return chip_of(*item, active_chip);
            }
            auto response = circuit::run_chip_scalar(chip_of(*item, at), options);  // a circuit with other devices cannot share lanes
            if (response.error && response.error->code == ErrorCode::interrupted) return {};
            response.is_scalar = true;
            on_outcome(outcome(*item, at, std::move(response)));
        }
        return {};
    };
    const auto on_done = [&](const Chip& chip, ChipResponse&& response) {
        const auto at = active.find(chip.id);  // next_chip() has inserted it
        if (!response.error || response.error->code != ErrorCode::interrupted)
            on_outcome(outcome(chip.id, at->second, std::move(response)));
        active.erase(at);
    };
    const auto done = circuit::run_chips(nominal_, next_chip, on_done, options);
    if (sweep_error) return *sweep_error;
    if (!done && done.error().code == ErrorCode::interrupted) return {};
    return done;
}

}  // namespace

Result<std::unique_ptr<Sweep>> make_chip_sweep(const SweepText& spec, const std::string& folder) { return ChipSweep::make(spec, folder); }

}  // namespace corpuscle::sweeps
