// A sweep of an afferent that is made of equations: blocks of units side by side on lanes; what cannot stand there goes one by one.

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "model/population.hpp"
#include "signal/field.hpp"
#include "signal/quantity.hpp"
#include "study/afferents.hpp"
#include "study/sweep/subject.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr std::size_t most_together = 1024, least_together = 64;  // units
constexpr std::size_t most_own_samples = std::size_t{1} << 22;    // of forces of their own, all units of a block: 32 MB
constexpr std::size_t block_together = 1024;                      // samples between two looks at `stop`

/// A unit that is to be answered.
struct EquationUnit {
    std::int64_t number;
    AfferentPlan plan;
    std::shared_ptr<const FeltForce> force;
    std::vector<double> spikes = {};
    std::optional<std::string> lost = {};
};

class EquationsSweep final : public PlannedSweep {
    AfferentPlan nominal_;
    ForceMaker force_;
    std::unique_ptr<AfferentMeasures> measured_;
    struct Varied {
        std::size_t parameter, axis;
    };
    std::vector<Varied> varied_;
    std::vector<std::size_t> probes_;
    std::size_t every_ = 0;

    std::size_t parameter(std::string_view name) const {
        const auto& all = *nominal_.parameters;
        return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.row.name == name; }) -
                                        all.begin());
    }
    /// "f_B" of "sa1.f_B".
    std::string_view own_name(std::string_view asked, std::string_view text) const {
        const auto dot = text.rfind('.');
        return dot != std::string_view::npos && goes_by(nominal_, asked, text.substr(0, dot)) ? text.substr(dot + 1) : text;
    }

    Result<Target> target(std::string_view asked, const Said& what) const;
    Result<void> set(const SweepText&);
    Result<void> show(const SweepText&);

    Run run_of(const FeltForce& force) const { return {force.clock.T()}; }
    Result<EquationUnit> unit(std::int64_t number) const;
    std::size_t together() const;
    Result<void> answer(std::vector<EquationUnit>&, const Told&, const std::function<bool()>& stop) const;
    Result<bool> answer_population(std::span<EquationUnit* const>, InstructionSet, const std::function<bool()>& stop) const;
    Result<std::vector<std::vector<float>>> answer_one(EquationUnit&, const std::function<bool()>& stop) const;
    void tell(EquationUnit&, std::vector<std::vector<float>> traces, const Told&) const;

public:
    static Result<std::unique_ptr<Sweep>> make(const SweepText&, const std::string& folder);
    Result<void> work(const Next&, const Told&, const std::function<bool()>& stop) const override;
};

Result<Target> EquationsSweep::target(std::string_view asked, const Said& what) const {
    if (force_.owns(what.text)) return force_.target(what);
    std::vector<Row> rows;
    for (const auto& p : *nominal_.parameters) rows.push_back(p.row);
    const auto row = row_for({nominal_.name, std::string(own_name(asked, what.text)), ""}, rows);
    if (!row) return what.wrong(row.error().sentence);
    const auto& r = **row;
    Target out{{what.text, std::string(r.unit), std::string(r.sentence)}, nominal_.values[parameter(r.name)], r.low, r.high};
    out.read = [unit = std::string(r.unit)](const Said& s) { return parse_quantity(s.text, unit); };
    return out;
}

Result<void> EquationsSweep::set(const SweepText& said) {
    const auto& asked = said.afferent->text;
    std::vector<Wish> wishes;
    for (const auto& s : said.set) {
        if (force_.owns(s.name)) {
            if (auto ok = force_.set(s); !ok) return ok;
            continue;
        }
        wishes.assign(1, {asked, std::string(own_name(asked, s.name)), s.value.text});
        const auto one = plan_any_afferent(asked, wishes);
        if (!one) return s.value.wrong(one.error().sentence);
    }
    wishes.clear();
    for (const auto& s : said.set)
        if (!force_.owns(s.name)) wishes.push_back({asked, std::string(own_name(asked, s.name)), s.value.text});
    auto plan = plan_any_afferent(asked, wishes);
    if (!plan) return said.set[0].value.wrong(plan.error().sentence);
    nominal_ = std::move(*plan);
    return {};
}

/// The traces that are kept.
Result<void> EquationsSweep::show(const SweepText& said) {
    if (said.traces.empty()) return {};
    const auto& force = *force_.nominal();
    const auto afferent = make_afferent(nominal_, run_of(force));
    std::vector<std::string_view> names;
    for (const auto& p : afferent->probes()) names.push_back(p.name);
    for (const auto& word : said.traces) {
        const auto at = std::find(names.begin(), names.end(), word.text);
        if (at == names.end())
            return word.wrong(fmt::format("traces: {} has no '{}'{} (it has {})", nominal_.name, word.text, did_you_mean(word.text, names),
                                          fmt::join(names, ", ")));
        probes_.push_back(static_cast<std::size_t>(at - names.begin()));
        traces_.push_back(word.text);
    }
    const auto every = samples_between(said, force.clock.T());
    if (!every) return every.error();
    every_ = *every;
    for (std::size_t k = 0; k < force.samples.size(); k += every_) trace_times_.push_back(force.clock.time(static_cast<std::int64_t>(k)));
    return {};
}

Result<std::unique_ptr<Sweep>> EquationsSweep::make(const SweepText& said, const std::string& folder) {
    auto out = std::make_unique<EquationsSweep>();
    auto& s = *out;
    if (said.orders) return said.orders->wrong("orders are those of a netlist = ...; an afferent = ... answers to its force");
    const auto& asked = said.afferent->text;
    if (said.iterations)
        return said.iterations->wrong(fmt::format("{} is made of equations and takes no iterations; leave them out", asked));
    auto plan = plan_any_afferent(asked, {});
    if (!plan) return said.afferent->wrong(plan.error().sentence);
    s.nominal_ = std::move(*plan);
    const auto seed = seed_of(said);
    if (!seed) return seed.error();
    auto force = ForceMaker::of(said, folder, *seed);
    if (!force) return force.error();
    s.force_ = std::move(*force);
    if (!said.set.empty())
        if (auto ok = s.set(said); !ok) return ok.error();
    Varying varying;
    varying.named = s.nominal_.name;
    varying.target = [&](const Said& what) { return s.target(asked, what); };
    varying.vary = [&](const SweepAxis&, const std::string& what, std::size_t axis) {
        if (s.force_.owns(what))
            s.force_.vary(what, axis);
        else
            s.varied_.push_back({s.parameter(s.own_name(asked, what)), axis});
    };
    auto units = plan_of(said, varying);
    if (!units) return units.error();
    s.plan_ = std::move(*units);
    if (auto ok = s.force_.prepare(); !ok) return ok.error();
    if (const double rate = s.force_.nominal()->clock.rate(); rate < s.nominal_.least_rate)
        return (said.rate ? *said.rate : *said.afferent)
            .wrong(
                fmt::format("samples come at {:g} Hz, but what {} answers to needs {:g} Hz or more", rate, asked, s.nominal_.least_rate));
    s.measured_ = std::make_unique<AfferentMeasures>(*s.force_.nominal(), false, std::span<const std::string>());
    if (auto ok = s.measured_->choose(said.measures); !ok) return ok.error();
    const Limiting limiting{[&](const Said& name) { return s.measured_->column_of(name); },
                            [&](const Said& model, std::size_t column) {
                                return model_says(model, s.force_, {s.measured_->columns()[column].name, model.place});
                            }};
    if (auto ok = set_limits(said, limiting, s.measured_->columns()); !ok) return ok.error();
    s.measures_ = s.measured_->columns();
    const auto keeps = keeps_spikes(said);
    if (!keeps) return keeps.error();
    if (*keeps) s.trains_ = {s.nominal_.name};
    if (auto ok = s.show(said); !ok) return ok.error();
    s.facts_ = first_facts(said, fmt::format("{}, {}", asked, s.force_.name()));
    if (auto recorded = s.force_.recorded(); !recorded.empty()) s.facts_.push_back({"recording " + s.force_.name(), std::move(recorded)});
    return std::unique_ptr<Sweep>(std::move(out));
}

Result<EquationUnit> EquationsSweep::unit(std::int64_t number) const {
    const auto values = plan_.values(number);
    auto force = force_.at(values);
    if (!force) return force.error();
    EquationUnit out{number, nominal_, std::move(*force)};
    for (const auto& v : varied_) out.plan.values[v.parameter] = values[v.axis];
    if (!varied_.empty())
        if (const auto wrong = refusal(out.plan)) out.lost = wrong->sentence;
    return out;
}

std::size_t EquationsSweep::together() const {
    auto most = most_together;
    if (force_.varies()) most = std::clamp<std::size_t>(most_own_samples / force_.nominal()->samples.size(), 1, most);
    const auto share = static_cast<std::size_t>(std::min<std::int64_t>(units() / 8, most_together)) / least_together * least_together;
    return std::min(most, std::max(share, least_together));
}

Result<void> EquationsSweep::work(const Next& next, const Told& told, const std::function<bool()>& stop) const {
    const auto most = together();
    for (std::vector<EquationUnit> block;; block.clear()) {
        while (block.size() < most && !stop()) {
            const auto number = next();
            if (!number) break;
            auto made = unit(*number);
            if (!made) return made.error();
            block.push_back(std::move(*made));
        }
        if (block.empty() || stop()) return {};
        if (auto ok = answer(block, told, stop); !ok) return ok.error().code == Code::interrupted ? Result<void>() : ok;
    }
}

/// Those of a kind together; what is one for all of a population must be the same.
Result<void> EquationsSweep::answer(std::vector<EquationUnit>& block, const Told& told, const std::function<bool()>& stop) const {
    const auto set = instruction_set();
    if (!set) return set.error();
    std::map<std::vector<double>, std::vector<EquationUnit*>> kinds;
    std::vector<EquationUnit*> singles;
    for (auto& u : block) {
        if (u.lost) continue;
        if (*set == InstructionSet::scalar || !probes_.empty() || !goes_on_lanes(u.plan, run_of(*u.force))) {
            singles.push_back(&u);
            continue;
        }
        std::vector<double> shared;
        for (std::size_t k = 0; k < u.plan.values.size(); ++k)
            if ((*u.plan.parameters)[k].row.one_for_all) shared.push_back(u.plan.values[k]);
        kinds[shared].push_back(&u);
    }
    for (const auto& [shared, units] : kinds) {
        const auto done = answer_population(units, *set, stop);
        if (!done) return done.error();
        if (!*done) singles.insert(singles.end(), units.begin(), units.end());
    }
    std::vector<bool> is_told(block.size());
    for (auto* u : singles) {
        u->spikes.clear();
        auto traces = answer_one(*u, stop);
        if (!traces) return traces.error();
        tell(*u, std::move(*traces), told), is_told[static_cast<std::size_t>(u - block.data())] = true;
    }
    for (std::size_t k = 0; k < block.size(); ++k)
        if (!is_told[k]) tell(block[k], {}, told);
    return {};
}

/// False: one of them left the finite numbers, and all are to be answered one by one.
Result<bool> EquationsSweep::answer_population(std::span<EquationUnit* const> units, InstructionSet set,
                                               const std::function<bool()>& stop) const {
    std::vector<const AfferentPlan*> plans;
    for (const auto* u : units) plans.push_back(&u->plan);
    const bool alike = varied_.empty();
    auto population = make_population({alike ? std::span(plans).first(1) : std::span<const AfferentPlan* const>(plans), units.size()},
                                      run_of(*units[0]->force), set);
    if (!population) return population.error();
    const bool one_force = std::all_of(units.begin(), units.end(), [&](const EquationUnit* u) { return u->force == units[0]->force; });
    std::size_t longest = 0;
    for (const auto* u : units) longest = std::max(longest, u->force->samples.size());
    std::vector<std::vector<double>> padded(units.size());  // what is shorter holds its last value
    std::vector<const double*> columns(units.size());
    std::vector<Spike> spikes;
    Pool alone(1);
    for (std::size_t at = 0; at < longest; at += block_together) {
        if (stop()) return Error{Code::interrupted, "interrupted"};
        const auto steps = std::min(block_together, longest - at);
        PopulationForce force;
        if (one_force) {
            force = ForceProfile{std::span(units[0]->force->samples).subspan(at, steps)};
        } else {
            for (std::size_t k = 0; k < units.size(); ++k) {
                const auto& samples = units[k]->force->samples;
                columns[k] = samples.data() + at;
                if (at + steps <= samples.size()) continue;
                padded[k].assign(samples.begin() + static_cast<std::ptrdiff_t>(std::min(at, samples.size())), samples.end());
                padded[k].resize(steps, samples.back());
                columns[k] = padded[k].data();
            }
            force = ForceColumns{columns};
        }
        spikes.clear();
        PopulationAnswer answer{&spikes};
        if (const auto ok = (*population)->respond(force, steps, answer, alone); !ok) return false;
        for (const auto& s : spikes) {
            auto& u = *units[s.unit];
            if (s.step < static_cast<std::int64_t>(u.force->samples.size())) u.spikes.push_back(u.force->clock.time(s.step, s.offset));
        }
    }
    return true;
}

Result<std::vector<std::vector<float>>> EquationsSweep::answer_one(EquationUnit& u, const std::function<bool()>& stop) const {
    auto answer = answer_alone(*make_afferent(u.plan, run_of(*u.force)), *u.force, probes_, every_, stop);
    if (!answer && answer.error().code == Code::interrupted) return answer.error();
    if (!answer) {
        u.lost = answer.error().sentence;
        return std::vector<std::vector<float>>();
    }
    u.spikes = std::move(answer->spikes);
    return std::move(answer->shown);
}

void EquationsSweep::tell(EquationUnit& u, std::vector<std::vector<float>> traces, const Told& told) const {
    UnitOutcome out;
    out.unit = u.number;
    if (u.lost) {
        out.end = UnitEnd::lost, out.why = *u.lost, u.spikes.clear();
        out.measures.assign(measures_.size(), std::numeric_limits<double>::quiet_NaN());
    } else {
        UnitAnswer answer;
        answer.spikes = u.spikes;
        out.measures = measured_->values(*u.force, answer);
    }
    if (!trains_.empty()) out.spikes.push_back(std::move(u.spikes));
    traces.resize(traces_.size());
    for (auto& t : traces) t.resize(trace_times_.size(), std::numeric_limits<float>::quiet_NaN());
    out.traces = std::move(traces);
    told(std::move(out));
}

}  // namespace

Result<std::unique_ptr<Sweep>> equations_sweep(const SweepText& said, const std::string& folder) {
    return EquationsSweep::make(said, folder);
}

}  // namespace corpuscle::sweeps
