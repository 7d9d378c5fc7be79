// A sweep over a model: takes items in groups of up to max_block_items and simulates them in parallel on SIMD lanes; items for which the
// lanes cannot be used are simulated one at a time.

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "core/located_override.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/text/quantity.hpp"
#include "model/lane_population.hpp"
#include "run/afferent_plan.hpp"
#include "sweep/subject/subject.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr std::size_t max_block_items = 1024, min_block_items = 64;  // here a block is the items that are simulated together
// Limit on the sum of the force samples of all items of a block, if the force varies: 32 MB.
constexpr std::size_t max_varied_samples = std::size_t{1} << 22;
constexpr std::size_t block_steps = 1024;  // force samples between two calls of `stop`

/// A work item.
struct ModelItem {
    std::int64_t number;  // index in the sweep
    AfferentPlan plan;
    std::shared_ptr<const SweepForce> force;
    std::vector<double> spikes = {};          // times since the first sample of the force, s
    std::optional<std::string> failure = {};  // why the item cannot be simulated; no value: it can
};

class ModelSweep final : public PlannedSweep {
    AfferentPlan nominal_;  // without varied values
    ForceFactory force_;
    std::unique_ptr<AfferentMeasures> afferent_measures_;
    struct VariedModelParameter {
        std::size_t parameter, axis;  // indexes in the model's parameters and in the plan's axes
    };
    std::vector<VariedModelParameter> varied_;  // without those of the force
    std::vector<std::size_t> probes_;           // indexes of the probes to record, among those of the afferent
    std::size_t every_ = 0;                     // sampling step of the probes, in samples of the force; 0: no probes

    /// Index of the afferent's parameter of this name, which must exist.
    std::size_t parameter_index(std::string_view name) const {
        const auto& all = *nominal_.parameters;
        return static_cast<std::size_t>(
            std::find_if(all.begin(), all.end(), [&](const AfferentParameter& p) { return p.info.name == name; }) - all.begin());
    }
    /// The name of a parameter without the afferent: "f_B" of "sa1.f_B" or "f_B".
    std::string_view parameter_name(std::string_view text) const {
        const auto dot = text.rfind('.');
        return dot != std::string_view::npos && matches_name(nominal_, text.substr(0, dot)) ? text.substr(dot + 1) : text;
    }

    Result<VariedQuantity> find_quantity(const LocatedText& quantity) const;
    /// Plans the afferent and sets the force with the fixed settings of the sweep file.
    Result<void> apply_settings(const AfferentSpec&, const SweepText&);
    Result<void> select_probes(const SweepText&);

    SimulationOptions options_for(const SweepForce& force) const { return {force.clock.T()}; }
    Result<ModelItem> make_item(std::int64_t number) const;
    std::size_t block_items() const;
    /// Simulates a block of items and reports their outcomes.
    Result<void> respond(std::vector<ModelItem>& block, const OutcomeHandler&, const std::function<bool()>& stop) const;
    Result<bool> respond_on_lanes(std::span<ModelItem* const>, InstructionSet, const std::function<bool()>& stop) const;
    /// Simulates one item by the scalar code and returns the samples of its probes.
    Result<std::vector<std::vector<float>>> respond_alone(ModelItem&, const std::function<bool()>& stop) const;
    void report(ModelItem&, std::vector<std::vector<float>> probe_samples, const OutcomeHandler&) const;

public:
    static Result<std::unique_ptr<Sweep>> make(const SweepText&, const std::string& folder);
    Result<void> run_items(const NextItem&, const OutcomeHandler&, const std::function<bool()>& stop) const override;
};

Result<VariedQuantity> ModelSweep::find_quantity(const LocatedText& quantity) const {
    if (force_.has_parameter(quantity.text)) return force_.find_quantity(quantity);
    std::vector<ParameterInfo> rows;
    for (const auto& p : *nominal_.parameters) rows.push_back(p.info);
    const auto row = find_parameter({nominal_.name, std::string(parameter_name(quantity.text)), ""}, rows);
    if (!row) return quantity.error_here(row.error().message);
    const auto& r = **row;
    VariedQuantity out{
        {quantity.text, std::string(r.unit), std::string(r.description)}, nominal_.values[parameter_index(r.name)], r.low, r.high};
    out.parse = [unit = std::string(r.unit)](const LocatedText& s) { return parse_quantity(s.text, unit); };
    return out;
}

Result<void> ModelSweep::apply_settings(const AfferentSpec& afferent, const SweepText& spec) {
    std::vector<ParameterOverride> overrides;
    for (const auto& s : spec.settings) {
        if (!force_.has_parameter(s.name))
            overrides.push_back(located_override(s, afferent.text()));
        else if (auto ok = force_.set(s); !ok)
            return ok;
    }
    auto planned = TRY(afferent.plan(overrides, {}));
    nominal_ = std::move(planned.result);
    auto targets = is_stimulus(force_.name()) ? stimulus_members(force_.name()) : std::vector<std::string_view>();
    targets.insert(targets.begin(), afferent.text());
    return check_all_used(planned.unused, targets);
}

/// Selects the probes that are written to the results.
Result<void> ModelSweep::select_probes(const SweepText& spec) {
    if (spec.probes.empty()) return {};
    const auto& force = *force_.nominal();
    const auto afferent = make_afferent(nominal_, options_for(force));
    std::vector<std::string_view> names;
    for (const auto& p : afferent->probes()) names.push_back(p.name);
    for (const auto& probe : spec.probes) {
        const auto at = std::find(names.begin(), names.end(), probe.text);
        if (at == names.end())
            return probe.error_here(fmt::format("traces: {} has no '{}'{} (it has {})", nominal_.name, probe.text,
                                                did_you_mean(probe.text, names), fmt::join(names, ", ")));
        probes_.push_back(static_cast<std::size_t>(at - names.begin()));
        probe_names_.push_back(probe.text);
    }
    every_ = TRY(probe_stride(spec, force.clock.T()));
    for (std::size_t k = 0; k < force.samples.size(); k += every_) probe_times_.push_back(force.clock.time(static_cast<std::int64_t>(k)));
    return {};
}

Result<std::unique_ptr<Sweep>> ModelSweep::make(const SweepText& spec, const std::string& folder) {
    auto out = std::make_unique<ModelSweep>();
    auto& s = *out;
    if (spec.directives) return spec.directives->error_here("orders applies to netlist = ...; an afferent = ... responds to its force");
    const auto& afferent_name = spec.afferent->text;
    if (spec.iterations)
        return spec.iterations->error_here(fmt::format("{} is a model and has no iterations; remove iterations", afferent_name));
    const auto afferent = read_afferent_spec(afferent_name);
    if (!afferent) return spec.afferent->error_here(afferent.error().message);
    const auto seed = TRY(seed_of(spec));
    s.force_ = TRY(ForceFactory::of(spec, folder, seed));
    TRY(s.apply_settings(**afferent, spec));
    VariableQuantities quantities;
    quantities.subject_name = s.nominal_.name;
    quantities.find_quantity = [&](const LocatedText& quantity) { return s.find_quantity(quantity); };
    quantities.vary = [&](const SweepAxis&, const std::string& quantity, std::size_t axis) {
        if (s.force_.has_parameter(quantity))
            s.force_.vary(quantity, axis);
        else
            s.varied_.push_back({s.parameter_index(s.parameter_name(quantity)), axis});
    };
    s.plan_ = TRY(plan_of(spec, quantities));
    TRY(s.force_.prepare());
    if (const double rate = s.force_.nominal()->clock.rate(); rate < s.nominal_.min_rate)
        return (spec.rate ? *spec.rate : *spec.afferent)
            .error_here(fmt::format("the sample rate is {:g} Hz, but {} needs {:g} Hz or more", rate, afferent_name, s.nominal_.min_rate));
    s.afferent_measures_ = std::make_unique<AfferentMeasures>(*s.force_.nominal(), false, std::span<const std::string>());
    TRY(s.afferent_measures_->select(spec.measures));
    const MeasureLookup lookup{[&](const LocatedText& name) { return s.afferent_measures_->require_column(name); },
                               [&](const LocatedText& model, std::size_t column) {
                                   return model_measure(model, s.force_, {s.afferent_measures_->columns()[column].name, model.location});
                               }};
    TRY(set_limits(spec, lookup, s.afferent_measures_->columns()));
    s.measures_ = s.afferent_measures_->columns();
    const auto keeps = TRY(keeps_spikes(spec));
    if (keeps) s.train_names_ = {s.nominal_.name};
    TRY(s.select_probes(spec));
    s.metadata_ = first_metadata(spec, fmt::format("{}, {}", afferent_name, s.force_.name()));
    if (auto summary = s.force_.recording_summary(); !summary.empty())
        s.metadata_.push_back({"recording " + s.force_.name(), std::move(summary)});
    return std::unique_ptr<Sweep>(std::move(out));
}

Result<ModelItem> ModelSweep::make_item(std::int64_t number) const {
    const auto values = plan_.values(number);
    auto force = TRY(force_.at(values));
    ModelItem out{number, nominal_, std::move(force)};
    for (const auto& v : varied_) out.plan.values[v.parameter] = values[v.axis];
    if (!varied_.empty())
        if (const auto ok = check_plan(out.plan); !ok) out.failure = ok.error().message;
    return out;
}

/// Number of items in a block: an eighth of the sweep, within limits, so that several threads get items.
std::size_t ModelSweep::block_items() const {
    auto limit = max_block_items;
    if (force_.varies()) limit = std::clamp<std::size_t>(max_varied_samples / force_.nominal()->samples.size(), 1, limit);
    const auto fraction =
        static_cast<std::size_t>(std::min<std::int64_t>(item_count() / 8, max_block_items)) / min_block_items * min_block_items;
    return std::min(limit, std::max(fraction, min_block_items));
}

Result<void> ModelSweep::run_items(const NextItem& next, const OutcomeHandler& on_outcome, const std::function<bool()>& stop) const {
    const auto limit = block_items();
    for (std::vector<ModelItem> block;; block.clear()) {
        while (block.size() < limit && !stop()) {
            const auto number = next();
            if (!number) break;
            block.push_back(TRY(make_item(*number)));
        }
        if (block.empty() || stop()) return {};
        if (auto ok = respond(block, on_outcome, stop); !ok) return ok.error().code == ErrorCode::interrupted ? Result<void>() : ok;
    }
}

/// Groups the items by the parameters that must be equal in a lane population, and simulates each group on lanes. Items that cannot use
/// lanes are simulated one at a time.
Result<void> ModelSweep::respond(std::vector<ModelItem>& block, const OutcomeHandler& on_outcome, const std::function<bool()>& stop) const {
    const auto set = TRY(instruction_set());
    std::map<std::vector<double>, std::vector<ModelItem*>> lane_groups;
    std::vector<ModelItem*> scalars;  // items that are simulated one at a time
    for (auto& item : block) {
        if (item.failure) continue;
        if (set == InstructionSet::scalar || !probes_.empty() || !can_use_lanes(item.plan, options_for(*item.force))) {
            scalars.push_back(&item);
            continue;
        }
        std::vector<double> shared;  // the values that all lanes must share
        for (std::size_t k = 0; k < item.plan.values.size(); ++k)
            if ((*item.plan.parameters)[k].info.is_shared_by_copies) shared.push_back(item.plan.values[k]);
        lane_groups[shared].push_back(&item);
    }
    for (const auto& [shared, items] : lane_groups) {
        const auto done = TRY(respond_on_lanes(items, set, stop));
        if (!done) scalars.insert(scalars.end(), items.begin(), items.end());
    }
    std::vector<bool> is_reported(block.size());
    for (auto* item : scalars) {
        item->spikes.clear();  // left over if the lanes failed
        auto probe_samples = TRY(respond_alone(*item, stop));
        report(*item, std::move(probe_samples), on_outcome), is_reported[static_cast<std::size_t>(item - block.data())] = true;
    }
    for (std::size_t k = 0; k < block.size(); ++k)
        if (!is_reported[k]) report(block[k], {}, on_outcome);
    return {};
}

/// Simulates items on lanes. Returns false if the state of an item became NaN or infinite; then the caller simulates these items one at a
/// time.
Result<bool> ModelSweep::respond_on_lanes(std::span<ModelItem* const> items, InstructionSet set, const std::function<bool()>& stop) const {
    std::vector<const AfferentPlan*> plans;
    for (const auto* item : items) plans.push_back(&item->plan);
    const bool same_parameters = varied_.empty();  // then one plan is enough for all lanes
    auto population =
        make_lane_population({same_parameters ? std::span(plans).first(1) : std::span<const AfferentPlan* const>(plans), items.size()},
                             options_for(*items[0]->force), set);
    if (!population) return population.error();
    const bool same_force = std::all_of(items.begin(), items.end(), [&](const ModelItem* item) { return item->force == items[0]->force; });
    std::size_t longest = 0;
    for (const auto* item : items) longest = std::max(longest, item->force->samples.size());
    std::vector<std::vector<double>> padded(items.size());  // samples of the forces that end early, extended by their last value
    std::vector<const double*> columns(items.size());       // of each item: its next `steps` samples
    std::vector<Spike> spikes;
    ThreadPool single_thread(1);
    for (std::size_t at = 0; at < longest; at += block_steps) {
        if (stop()) return Error{ErrorCode::interrupted, "interrupted"};
        const auto steps = std::min(block_steps, longest - at);
        PopulationForce force;
        if (same_force) {
            force = ForceProfile{std::span(items[0]->force->samples).subspan(at, steps)};
        } else {
            for (std::size_t k = 0; k < items.size(); ++k) {
                const auto& samples = items[k]->force->samples;
                columns[k] = samples.data() + at;
                if (at + steps <= samples.size()) continue;
                padded[k].assign(samples.begin() + static_cast<std::ptrdiff_t>(std::min(at, samples.size())), samples.end());
                padded[k].resize(steps, samples.back());
                columns[k] = padded[k].data();
            }
            force = ForceColumns{columns};
        }
        spikes.clear();
        PopulationResponse response{&spikes};
        if (const auto ok = (*population)->respond(force, steps, response, single_thread); !ok) return false;
        for (const auto& s : spikes) {
            auto& item = *items[s.afferent_index];
            if (s.step < static_cast<std::int64_t>(item.force->samples.size()))
                item.spikes.push_back(item.force->clock.time(s.step, s.offset));
        }
    }
    return true;
}

Result<std::vector<std::vector<float>>> ModelSweep::respond_alone(ModelItem& item, const std::function<bool()>& stop) const {
    auto response = simulate_afferent(*make_afferent(item.plan, options_for(*item.force)), *item.force, probes_, every_, stop);
    if (!response && response.error().code == ErrorCode::interrupted) return response.error();
    if (!response) {
        item.failure = response.error().message;
        return std::vector<std::vector<float>>();
    }
    item.spikes = std::move(response->spikes);
    return std::move(response->probe_samples);
}

void ModelSweep::report(ModelItem& item, std::vector<std::vector<float>> probe_samples, const OutcomeHandler& on_outcome) const {
    ItemOutcome out;
    out.item = item.number;
    if (item.failure) {
        out.end = ItemEnd::diverged, out.reason = *item.failure, item.spikes.clear();
        out.measures.assign(measures_.size(), std::numeric_limits<double>::quiet_NaN());
    } else {
        ItemResponse response;
        response.spikes = item.spikes;
        out.measures = afferent_measures_->values(*item.force, response);
    }
    if (!train_names_.empty()) out.spikes.push_back(std::move(item.spikes));
    probe_samples.resize(probe_names_.size());
    for (auto& t : probe_samples) t.resize(probe_times_.size(), std::numeric_limits<float>::quiet_NaN());
    out.probes = std::move(probe_samples);
    on_outcome(std::move(out));
}

}  // namespace

Result<std::unique_ptr<Sweep>> make_model_sweep(const SweepText& spec, const std::string& folder) { return ModelSweep::make(spec, folder); }

}  // namespace corpuscle::sweeps
