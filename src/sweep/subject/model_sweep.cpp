// A sweep over a model: takes items in groups of up to max_block_items and simulates them in parallel on SIMD lanes; items for which the
// lanes cannot be used are simulated one at a time.

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "core/stimulus/stimuli.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/config_file.hpp"
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
    SimulatedResponse response = {};
    std::optional<std::string> failure = {};  // why the item cannot be simulated; no value: it can
};

class ModelSweep final : public AfferentSweep {
    std::string text_;      // the afferent in the sweep file
    AfferentPlan nominal_;  // without varied values
    struct VariedModelParameter {
        std::size_t parameter, axis;  // indexes in the model's parameters and in the plan's axes
    };
    std::vector<VariedModelParameter> varied_;  // without those of the force
    std::vector<std::size_t> probes_;           // indexes of the probes to record, among those of the afferent

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

    Result<void> open(const SweepText& spec, const std::string& folder) override {
        const auto& name = *spec.get("afferent");
        text_ = name.text;
        if (const auto* iterations = spec.get("iterations"))
            return iterations->error_here(fmt::format("{} is a model and has no iterations; remove iterations", text_));
        const auto afferent = TRY(name.located(read_afferent_spec(text_)));
        TRY(open_force(spec, folder));
        return apply_settings(*afferent, spec);
    }

    const std::string& subject_name() const override { return nominal_.name; }
    std::string title() const override { return fmt::format("{}, {}", text_, force_.name()); }

    Result<VariedQuantity> find_afferent_quantity(const LocatedText& quantity) override {
        std::vector<ParameterInfo> rows;
        for (const auto& p : *nominal_.parameters) rows.push_back(p.info);
        const auto& r = *TRY(quantity.located(find_parameter({nominal_.name, std::string(parameter_name(quantity.text)), ""}, rows)));
        const auto index = parameter_index(r.name);
        VariedQuantity out{{quantity.text, std::string(r.unit), std::string(r.description)}, nominal_.values[index], r.low, r.high};
        out.parse = [unit = std::string(r.unit)](const LocatedText& s) { return parse_quantity(s.text, unit); };
        out.vary = [this, index](std::size_t axis, const auto&) { varied_.push_back({index, axis}); };
        return out;
    }

    Result<void> select_measures(const SweepText& spec) override {
        TRY(AfferentSweep::select_measures(spec));
        const double rate = force_.nominal()->clock.rate();
        if (rate >= nominal_.min_rate) return {};
        const auto* given = spec.get("rate") ? spec.get("rate") : spec.get("afferent");
        return given->error_here(fmt::format("the sample rate is {:g} Hz, but {} needs {:g} Hz or more", rate, text_, nominal_.min_rate));
    }

    Result<void> add_probe(const LocatedText& probe) override {
        const auto afferent = make_afferent(nominal_, options_for(*force_.nominal()));
        std::vector<std::string_view> names;
        for (const auto& p : afferent->probes()) names.push_back(p.name);
        const auto at = std::find(names.begin(), names.end(), probe.text);
        if (at == names.end())
            return probe.error_here(fmt::format("traces: {} has no '{}'{} (it has {})", nominal_.name, probe.text,
                                                did_you_mean(probe.text, names), joined(names)));
        probes_.push_back(static_cast<std::size_t>(at - names.begin()));
        probe_names.push_back(probe.text), probe_units.emplace_back(afferent->probes()[probes_.back()].unit);
        return {};
    }

    /// Plans the afferent and sets the force with the fixed settings of the sweep file.
    Result<void> apply_settings(const AfferentSpec& afferent, const SweepText& spec) {
        std::vector<ParameterOverride> overrides;
        for (const auto& s : spec.top.settings("set"))
            if (force_.has_parameter(s.name))
                TRY(force_.set(s));
            else
                overrides.push_back(located_override(s, afferent.text()));
        auto planned = TRY(afferent.plan(overrides, {}));
        nominal_ = std::move(planned.result);
        auto targets = is_stimulus(force_.name()) ? stimulus_members(force_.name()) : std::vector<std::string_view>();
        targets.insert(targets.begin(), afferent.text());
        return check_all_used(planned.unused, targets);
    }

    SimulationOptions options_for(const SweepForce& force) const { return {force.clock.T()}; }

    Result<ModelItem> make_item(std::int64_t number) const {
        const auto values = plan_.values(number);
        auto force = TRY(force_.at(values));
        ModelItem out{number, nominal_, std::move(force)};
        for (const auto& v : varied_) out.plan.values[v.parameter] = values[v.axis];
        if (!varied_.empty())
            if (const auto ok = check_plan(out.plan); !ok) out.failure = ok.error().message;
        return out;
    }

    /// Number of items in a block: an eighth of the sweep, within limits, so that several threads get items.
    std::size_t block_items() const {
        auto limit = max_block_items;
        if (force_.varies()) limit = std::clamp<std::size_t>(max_varied_samples / force_.nominal()->samples.size(), 1, limit);
        const auto fraction =
            static_cast<std::size_t>(std::min<std::int64_t>(item_count / 8, max_block_items)) / min_block_items * min_block_items;
        return std::min(limit, std::max(fraction, min_block_items));
    }

    /// Simulates a block of items and reports their outcomes.
    /// Groups the items by the parameters that must be equal in a lane population, and simulates each group on lanes. Items that cannot use
    /// lanes are simulated one at a time.
    Result<void> respond(std::vector<ModelItem>& block, const OutcomeHandler& on_outcome, const std::function<bool()>& stop) const {
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
            if (!TRY(respond_on_lanes(items, set, stop))) scalars.insert(scalars.end(), items.begin(), items.end());
        }
        std::vector<bool> is_reported(block.size());
        for (auto* item : scalars) {
            TRY(respond_alone(*item, stop));
            report(*item, on_outcome), is_reported[static_cast<std::size_t>(item - block.data())] = true;
        }
        for (std::size_t k = 0; k < block.size(); ++k)
            if (!is_reported[k]) report(block[k], on_outcome);
        return {};
    }

    /// Simulates items on lanes. Returns false if the state of an item became NaN or infinite; then the caller simulates these items one at
    /// a time.
    Result<bool> respond_on_lanes(std::span<ModelItem* const> items, InstructionSet set, const std::function<bool()>& stop) const {
        std::vector<const AfferentPlan*> plans;
        for (const auto* item : items) plans.push_back(&item->plan);
        const bool same_parameters = varied_.empty();  // then one plan is enough for all lanes
        auto population = TRY(
            make_lane_population({same_parameters ? std::span(plans).first(1) : std::span<const AfferentPlan* const>(plans), items.size()},
                                 options_for(*items[0]->force), set));
        const bool same_force =
            std::all_of(items.begin(), items.end(), [&](const ModelItem* item) { return item->force == items[0]->force; });
        std::size_t longest = 0;
        for (const auto* item : items) longest = std::max(longest, item->force->samples.size());
        std::vector<std::vector<double>> padded(items.size());  // samples of the forces that end early, extended by their last value
        std::vector<const double*> columns(items.size());       // of each item: its next `steps` samples
        std::vector<Spike> spikes;
        ThreadPool single_thread(1);
        for (std::size_t at = 0; at < longest; at += block_steps) {
            if (stop()) return interrupted_error();
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
            if (const auto ok = population->respond(force, steps, response, single_thread); !ok) return false;
            for (const auto& s : spikes) {
                auto& item = *items[s.afferent_index];
                if (s.step < static_cast<std::int64_t>(item.force->samples.size()))
                    item.response.spikes.push_back(item.force->clock.time(s.step, s.offset));
            }
        }
        return true;
    }

    /// Simulates one item by the scalar code.
    Result<void> respond_alone(ModelItem& item, const std::function<bool()>& stop) const {
        auto response = simulate_afferent(*make_afferent(item.plan, options_for(*item.force)), *item.force, probes_, every_, stop);
        if (!response && response.error().code == ErrorCode::interrupted) return response.error();
        response ? void(item.response = std::move(*response)) : void(item.failure = response.error().message);
        return {};
    }

    void report(ModelItem& item, const OutcomeHandler& on_outcome) const {
        auto out = failed_outcome(item.number, item.failure.value_or(""));
        out.probes = padded_probes(std::move(item.response.probe_samples));
        if (!item.failure) {
            out.end = ItemEnd::done, out.measures = afferent_measures_->values(*item.force, item.response.spikes);
            if (!train_names.empty()) out.spikes[0] = std::move(item.response.spikes);
        }
        on_outcome(std::move(out));
    }

public:
    Result<void> run_items(const NextItem& next, const OutcomeHandler& on_outcome, const std::function<bool()>& stop) const override {
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
};

}  // namespace

std::unique_ptr<PlannedSweep> new_model_sweep() { return std::make_unique<ModelSweep>(); }

}  // namespace corpuscle::sweeps
