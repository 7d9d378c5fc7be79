// A sweep over an afferent that is a netlist. Each item is a chip: a design, and a sample of process and mismatch if these are sampled.
// Designs differ if netlist values vary. Many chips are simulated in parallel.

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/cost/cost.hpp"
#include "circuit/output/saved_quantities.hpp"
#include "core/parameter.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::sweeps {
namespace {

using circuit::Chip;
using circuit::ChipResponse;
using circuit::CircuitAfferentFactory;
using DesignPointer = std::shared_ptr<const CircuitAfferentFactory>;  // a netlist with one set of values

class ChipSweep final : public AfferentSweep {
    DesignPointer nominal_;  // without varied values
    std::size_t lanes_ = circuit::BatchOptions{}.lanes;
    mutable ValueCache<DesignPointer> designs_{16};  // recent designs, by their varied netlist values

    /// Force and design of a chip that is being simulated.
    struct ActiveChip {
        SweepForcePointer force;
        DesignPointer design;
    };

    Result<void> open(const SweepText& spec, const std::string& folder) override {
        netlist_ = TRY(NetlistFactory::of(*spec.get("afferent"), folder));
        TRY(open_force(spec, folder));
        for (const auto& s : spec.top.settings("set")) TRY(force_.has_parameter(s.name) ? force_.set(s) : netlist_.set(s));
        nominal_ = TRY(CircuitAfferentFactory::create(TRY(netlist_.nominal())));
        return {};
    }

    const circuit::Circuit* circuit() const override { return nominal_->circuit.get(); }
    Result<VariedQuantity> find_afferent_quantity(const LocatedText& quantity) override { return netlist_.find_quantity(quantity); }
    std::vector<std::string> range_names() const override {
        std::vector<std::string> out;
        for (const auto& w : nominal_->operating_ranges) out.emplace_back(w.range().quantity);
        return out;
    }

    /// The probes that are written to the results replace those in the netlist's .save.
    Result<void> add_probe(const LocatedText& probe) override {
        const auto found = TRY(probe.located(circuit::resolve_probe(*nominal_->circuit, probe.text)));
        if (!found)
            return probe.error_here(fmt::format("traces: {} has no node or device '{}'{}", netlist_.name(), probe.text,
                                                circuit::suggest_probe(*nominal_->circuit, probe.text)));
        probe_names.push_back(*found);
        netlist_.save(probe_names);
        nominal_ = TRY(CircuitAfferentFactory::create(TRY(netlist_.nominal())));
        const auto own =
            std::find_if(nominal_->probes.begin(), nominal_->probes.end(), [&](const auto& one) { return one.name == *found; });
        probe_units.emplace_back(own == nominal_->probes.end() ? "" : own->is_voltage() ? "V" : "A");
        return {};
    }

    /// Those of the nominal chip with the nominal force.
    Result<std::int64_t> nominal_iterations(const std::function<bool()>& stop) const override {
        const auto& force = *force_.nominal();
        circuit::BatchOptions options;
        options.should_stop = stop;
        const auto response =
            circuit::run_chip_scalar({0, nominal_, circuit::chip_sample_of(*nominal_->circuit), force.samples, force.clock.T()}, options);
        return response.error ? Result<std::int64_t>(*response.error) : response.stats.iterations;
    }

    /// The design for an item with these axis values.
    Result<DesignPointer> design(std::span<const double> values) const {
        if (!netlist_.varies()) return nominal_;
        return designs_.get(netlist_.netlist_values(values),
                            [&]() -> Result<DesignPointer> { return CircuitAfferentFactory::create(TRY(netlist_.at(values))); });
    }

    /// The sample that the netlist itself fixes by its mismatch seed, otherwise the one that the sweep draws for the item.
    std::optional<circuit::ChipSample> chip_sample(std::int64_t item, const CircuitAfferentFactory& design) const {
        if (auto fixed_sample = circuit::chip_sample_of(*design.circuit)) return fixed_sample;
        return plan_.chip_sample(item);
    }

    ItemOutcome outcome(std::int64_t item, const ActiveChip& chip, ChipResponse&& response) const {
        const double area = afferent_measures_->has_area() ? circuit::area_of(*chip.design->circuit).total() : 0;
        auto out = failed_outcome(item, response.error ? response.error->text() : "");
        out.ran_alone = response.is_scalar, out.steps = response.stats.steps, out.iterations = response.stats.iterations;
        if (response.error) return out;
        if (!train_names.empty()) out.spikes[0] = response.spikes;
        out.probes = padded_probes(std::move(response.probes));
        if (response.hit_iteration_limit) {
            out.end = ItemEnd::iteration_limit, out.reason = fmt::format("stopped after {} iterations", response.stats.iterations);
            return out;
        }
        out.end = ItemEnd::done;
        out.measures = afferent_measures_->values(*chip.force, response.spikes, &response, area);
        return out;
    }

public:
    void set_lanes(std::size_t lanes) override { lanes_ = lanes; }

    Result<void> run_items(const NextItem& next, const OutcomeHandler& on_outcome, const std::function<bool()>& stop) const override {
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
                    on_outcome(failed_outcome(*item, item_design.error().text()));
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
};

}  // namespace

std::unique_ptr<PlannedSweep> new_chip_sweep() { return std::make_unique<ChipSweep>(); }

}  // namespace corpuscle::sweeps
