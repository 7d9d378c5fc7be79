// A sweep of an afferent that is a netlist: many chips at once, each with its own draw; where other numbers differ, with its own design.

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "circuit/batch/chips.hpp"
#include "circuit/traced.hpp"
#include "signal/field.hpp"
#include "study/sweep/netlists.hpp"
#include "study/sweep/subject.hpp"

namespace corpuscle::sweeps {
namespace {

using circuit::Chip;
using circuit::ChipAnswer;
using circuit::CircuitDesign;
using DesignPointer = std::shared_ptr<const CircuitDesign>;

constexpr std::size_t designs_kept = 16;

class ChipSweep final : public PlannedSweep {
    NetlistMaker netlist_{};
    ForceMaker force_;
    DesignPointer nominal_;
    std::unique_ptr<AfferentMeasures> measured_;
    std::size_t every_ = 0, lanes_ = circuit::BatchOptions{}.lanes;
    long most_ = 0;  // iterations that the file allows; 0: it says nothing

    mutable std::mutex guard_;
    mutable std::map<std::vector<double>, Result<DesignPointer>> designs_;
    mutable std::mutex nominal_guard_;
    mutable std::optional<long> most_by_nominal_;

    /// A chip at work, and what it needs until it has ended.
    struct AtWork {
        std::shared_ptr<const FeltForce> force;
        DesignPointer design;
    };

    Result<void> set(const SweepText&);
    Result<void> choose(const SweepText&);
    Result<void> show(const SweepText&);
    Result<DesignPointer> design(std::span<const double> values) const;
    std::optional<circuit::Draw> draw(std::int64_t unit, const CircuitDesign&) const;
    long most_iterations(const std::function<bool()>& stop) const;
    UnitOutcome outcome(std::int64_t unit, const AtWork&, ChipAnswer&&) const;
    UnitOutcome lost(std::int64_t unit, const Error&) const;

public:
    static Result<std::unique_ptr<Sweep>> make(const SweepText&, const std::string& folder);
    void set_lanes(std::size_t lanes) override { lanes_ = lanes; }
    Result<void> work(const Next&, const Told&, const std::function<bool()>& stop) const override;
};

Result<void> ChipSweep::set(const SweepText& said) {
    for (const auto& s : said.set)
        if (auto ok = force_.owns(s.name) ? force_.set(s) : netlist_.set(s); !ok) return ok;
    return {};
}

/// Measures and limits.
Result<void> ChipSweep::choose(const SweepText& said) {
    std::vector<std::string> ranges;
    for (const auto& w : nominal_->kept) ranges.emplace_back(w.range().of);
    measured_ = std::make_unique<AfferentMeasures>(*force_.nominal(), true, ranges);
    if (auto ok = measured_->choose(said.measures); !ok) return ok;
    const Limiting limiting{
        [&](const Said& name) { return measured_->column_of(name); },
        [&](const Said& model, std::size_t column) { return model_says(model, force_, {measured_->columns()[column].name, model.place}); }};
    if (auto ok = set_limits(said, limiting, measured_->columns()); !ok) return ok;
    measures_ = measured_->columns();
    return {};
}

/// The traces that are kept, in place of what the netlist saves.
Result<void> ChipSweep::show(const SweepText& said) {
    for (const auto& word : said.traces) {
        const auto found = circuit::traced(*nominal_->circuit, word.text);
        if (!found) return word.wrong(found.error().sentence);
        if (!*found)
            return word.wrong(fmt::format("traces: {} has no such node or device as '{}'{}", netlist_.name(), word.text,
                                          circuit::meant_trace(*nominal_->circuit, word.text)));
        traces_.push_back(**found);
    }
    if (traces_.empty()) return {};
    netlist_.save(traces_);
    const auto netlist = netlist_.nominal();
    if (!netlist) return netlist.error();
    auto design = CircuitDesign::of(*netlist);
    if (!design) return design.error();
    nominal_ = std::move(*design);
    const auto& force = *force_.nominal();
    const auto every = samples_between(said, force.clock.T());
    if (!every) return every.error();
    every_ = *every;
    for (std::size_t k = 0; k < force.samples.size(); k += every_) trace_times_.push_back(force.clock.time(static_cast<std::int64_t>(k)));
    return {};
}

Result<std::unique_ptr<Sweep>> ChipSweep::make(const SweepText& said, const std::string& folder) {
    auto out = std::make_unique<ChipSweep>();
    auto& s = *out;
    if (said.orders) return said.orders->wrong("orders are those of a netlist = ...; an afferent = ... answers to its force");
    auto netlist = NetlistMaker::of(*said.afferent, folder);
    if (!netlist) return netlist.error();
    s.netlist_ = std::move(*netlist);
    const auto seed = seed_of(said);
    if (!seed) return seed.error();
    auto force = ForceMaker::of(said, folder, *seed);
    if (!force) return force.error();
    s.force_ = std::move(*force);
    if (auto ok = s.set(said); !ok) return ok.error();
    const auto nominal = s.netlist_.nominal();
    if (!nominal) return nominal.error();
    auto design = CircuitDesign::of(*nominal);
    if (!design) return design.error();
    s.nominal_ = std::move(*design);
    auto written = circuit::Variants::of(*nominal);
    if (!written) return written.error();
    Varying varying;
    varying.named = s.netlist_.name(), varying.chips = true;
    varying.target = [&](const Said& what) { return s.force_.owns(what.text) ? s.force_.target(what) : s.netlist_.target(what); };
    varying.vary = [&](const SweepAxis& a, const std::string& what, std::size_t axis) {
        s.force_.owns(what) ? s.force_.vary(what, axis) : s.netlist_.vary(what, axis, a.column.words);
    };
    auto units = plan_of(said, varying, &*written);
    if (!units) return units.error();
    s.plan_ = std::move(*units);
    if (s.plan_.draws_chips() && s.nominal_->circuit->mismatch)
        return bad_input("[set] chooses one chip by mismatch = ..., and the sweep draws others; leave one of them out", {said.file});
    if (said.iterations) {
        const auto most = whole_of(*said.iterations, "iterations", 1, 1e12);
        if (!most) return most.error();
        s.most_ = static_cast<long>(*most);
    }
    if (auto ok = s.force_.prepare(); !ok) return ok.error();
    if (auto ok = s.choose(said); !ok) return ok.error();
    const auto keeps = keeps_spikes(said);
    if (!keeps) return keeps.error();
    if (*keeps) s.trains_ = {s.netlist_.name()};
    if (auto ok = s.show(said); !ok) return ok.error();
    s.facts_ = first_facts(said, s.nominal_->circuit->title);
    for (auto& fact : s.netlist_.facts()) s.facts_.push_back(std::move(fact));
    if (auto recorded = s.force_.recorded(); !recorded.empty()) s.facts_.push_back({"recording " + s.force_.name(), std::move(recorded)});
    s.tell_draws(s.netlist_.name(), *s.nominal_->circuit);
    return std::unique_ptr<Sweep>(std::move(out));
}

Result<DesignPointer> ChipSweep::design(std::span<const double> values) const {
    if (!netlist_.varies()) return nominal_;
    const auto own = netlist_.own(values);
    {
        const std::lock_guard lock(guard_);
        if (const auto at = designs_.find(own); at != designs_.end()) return at->second;
    }
    const auto netlist = netlist_.at(values);
    const auto made = netlist ? CircuitDesign::of(*netlist) : Result<DesignPointer>(netlist.error());
    const std::lock_guard lock(guard_);
    if (designs_.size() >= designs_kept) designs_.clear();
    designs_.emplace(own, made);
    return made;
}

std::optional<circuit::Draw> ChipSweep::draw(std::int64_t unit, const CircuitDesign& design) const {
    if (auto own = circuit::own_draw(*design.circuit)) return own;
    return plan_.draw(unit);
}

/// What a unit may cost: what the file says, else many times what the nominal chip takes under the nominal force.
long ChipSweep::most_iterations(const std::function<bool()>& stop) const {
    if (most_ > 0) return most_;
    const std::lock_guard lock(nominal_guard_);
    if (most_by_nominal_) return *most_by_nominal_;
    const auto& force = *force_.nominal();
    circuit::BatchOptions options;
    options.stop = stop;
    const auto answer =
        circuit::run_chip_alone({0, nominal_, circuit::own_draw(*nominal_->circuit), force.samples, force.clock.T()}, options);
    if (answer.error && answer.error->code == Code::interrupted) return 0;
    most_by_nominal_ = answer.error ? 0 : static_cast<long>(many_times_nominal * static_cast<double>(answer.work.iterations));
    return *most_by_nominal_;
}

UnitOutcome ChipSweep::lost(std::int64_t unit, const Error& error) const {
    UnitOutcome out;
    out.unit = unit, out.end = UnitEnd::lost, out.why = error.text();
    out.measures.assign(measures_.size(), std::numeric_limits<double>::quiet_NaN());
    out.spikes.resize(trains_.size());
    out.traces.assign(traces_.size(), std::vector<float>(trace_times_.size(), std::numeric_limits<float>::quiet_NaN()));
    return out;
}

UnitOutcome ChipSweep::outcome(std::int64_t unit, const AtWork& at, ChipAnswer&& answer) const {
    auto out = answer.error ? lost(unit, *answer.error) : UnitOutcome{};
    out.unit = unit, out.alone = answer.alone;
    out.steps = answer.work.steps, out.iterations = answer.work.iterations;
    if (answer.error) return out;
    if (answer.capped) out.end = UnitEnd::capped, out.why = fmt::format("stopped after {} iterations", answer.work.iterations);
    UnitAnswer of_unit;
    of_unit.spikes = answer.spikes, of_unit.iterations = static_cast<double>(answer.work.iterations);
    const double T = at.force->clock.T(), seconds = answer.spent.seconds;
    of_unit.power = answer.spent.supplies / seconds, of_unit.sensor_power = answer.spent.sensor / seconds;
    for (const auto& o : answer.outside) {
        of_unit.outside_of.push_back(static_cast<double>(o.samples) * T);
        of_unit.outside = std::max(of_unit.outside, of_unit.outside_of.back());
    }
    of_unit.outside_of.resize(nominal_->kept.size());
    out.measures = answer.capped ? std::vector<double>(measures_.size(), std::numeric_limits<double>::quiet_NaN())
                                 : measured_->values(*at.force, of_unit);
    if (!trains_.empty()) out.spikes.push_back(std::move(answer.spikes));
    out.traces = std::move(answer.shown);
    out.traces.resize(traces_.size());
    for (auto& t : out.traces) t.resize(trace_times_.size(), std::numeric_limits<float>::quiet_NaN());
    return out;
}

Result<void> ChipSweep::work(const Next& next, const Told& told, const std::function<bool()>& stop) const {
    circuit::BatchOptions options;
    options.stop = stop, options.show_every = every_, options.lanes = lanes_;
    options.most_iterations = most_iterations(stop);
    std::map<std::int64_t, AtWork> at_work;
    std::optional<Error> fault;
    const auto chip_of = [&](std::int64_t unit, AtWork& at) {
        return Chip{unit, at.design, draw(unit, *at.design), at.force->samples, at.force->clock.T()};
    };
    const auto next_chip = [&]() -> std::optional<Chip> {
        while (!stop() && !fault) {
            const auto unit = next();
            if (!unit) return {};
            const auto values = plan_.values(*unit);
            const auto force = force_.at(values);
            if (!force) return fault = force.error(), std::nullopt;
            const auto made = design(values);
            if (!made) {
                told(lost(*unit, made.error()));
                continue;
            }
            AtWork at{*force, *made};
            if (at.design == nominal_ || same_devices(*at.design->circuit, *nominal_->circuit)) {
                auto& kept = at_work[*unit] = std::move(at);
                return chip_of(*unit, kept);
            }
            auto answer = circuit::run_chip_alone(chip_of(*unit, at), options);  // another circuit: it shares no lanes
            if (answer.error && answer.error->code == Code::interrupted) return {};
            answer.alone = true;
            told(outcome(*unit, at, std::move(answer)));
        }
        return {};
    };
    const auto ended = [&](const Chip& chip, ChipAnswer&& answer) {
        const auto at = at_work.find(chip.number);
        if (!answer.error || answer.error->code != Code::interrupted) told(outcome(chip.number, at->second, std::move(answer)));
        at_work.erase(at);
    };
    const auto done = circuit::run_chips(nominal_, next_chip, ended, options);
    if (fault) return *fault;
    if (!done && done.error().code == Code::interrupted) return {};
    return done;
}

}  // namespace

Result<std::unique_ptr<Sweep>> chips_sweep(const SweepText& said, const std::string& folder) { return ChipSweep::make(said, folder); }

}  // namespace corpuscle::sweeps
