// A sweep of a netlist that says itself what is to be found of it: its analyses, one chip or one value after another on one bench.

#include <fmt/format.h>
#include <algorithm>
#include <mutex>

#include "circuit/analyses.hpp"
#include "circuit/curves.hpp"
#include "circuit/run.hpp"
#include "signal/field.hpp"
#include "study/sweep/netlists.hpp"
#include "study/sweep/subject.hpp"

namespace corpuscle::sweeps {
namespace {

using circuit::Circuit;
using circuit::RunOutcome;
using circuit::TestBench;

constexpr std::string_view of_spikes[] = {"spikes", "first_spike", "last_spike", "mean_interval"};

class AnalysesSweep final : public PlannedSweep {
    NetlistMaker netlist_{};
    std::shared_ptr<const Circuit> nominal_;
    long most_ = 0;  // iterations that the file allows; 0: it says nothing
    mutable std::mutex guard_;
    mutable std::optional<long> most_by_nominal_;

    long most_iterations(const std::function<bool()>& stop) const;
    Result<void> choose(const SweepText&);
    Result<void> keep(const SweepText&);
    Result<std::shared_ptr<const Circuit>> circuit(std::span<const double> values) const;
    UnitOutcome outcome(std::int64_t unit, const Result<RunOutcome>&, bool capped = false) const;

    /// What one thread works on, and for which values it is made.
    struct Bench {
        std::vector<double> own;
        std::unique_ptr<TestBench> bench;
    };
    Result<void> prepare(Bench&, std::span<const double> values) const;

public:
    static Result<std::unique_ptr<Sweep>> make(const SweepText&, const std::string& folder);
    Result<void> work(const Next&, const Told&, const std::function<bool()>& stop) const override;
};

std::string unit_of(std::string_view name) {
    if (name.find("spike") != std::string_view::npos && name != "spikes") return "s";
    if (name == "mean_interval") return "s";
    return name.starts_with("v(") ? "V" : name.starts_with("i(") ? "A" : "";
}

/// What the nominal circuit finds, and by what names; transients are left out, for they may take long.
Result<RunOutcome> found_quickly(const Circuit& circuit) {
    auto quick = std::make_shared<Circuit>(circuit);
    std::erase_if(quick->commands, [](const circuit::Command& c) {
        return c.name == "tran" || ((c.name == "meas" || c.name == "measure") && !c.words.empty() && c.words[0] == "tran") ||
               c.name == "expect" || ((c.name == "meas" || c.name == "measure") && c.words.size() > 2 && c.words[2].starts_with("param="));
    });
    circuit::RunOrders orders;
    orders.print = false;
    auto bench = TestBench::make(std::move(quick));
    if (!bench) return bench.error();
    (*bench)->brief = true;
    return circuit::run(**bench, orders);
}

bool has(const Circuit& circuit, std::string_view command) {
    return std::any_of(circuit.commands.begin(), circuit.commands.end(), [&](const auto& c) { return c.name == command; });
}

/// Every number that the netlist asks for, by its name.
std::vector<std::string> numbers_of(const Circuit& circuit, const std::optional<RunOutcome>& quick) {
    std::vector<std::string> out;
    const auto add = [&](std::string name) {
        if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(std::move(name));
    };
    if (quick)
        for (const auto& a : quick->analyses)
            for (const auto& [name, value] : a.findings.numbers) add(name);
    if (has(circuit, "tran") && has(circuit, "spike"))
        for (const auto name : of_spikes) add(std::string(name));
    for (const auto& c : circuit.commands)
        if ((c.name == "meas" || c.name == "measure") && c.words.size() > 2) add(c.words[1]);
    for (const auto& c : circuit.commands) {
        if (c.name == "print" && c.words.size() > 1 && c.words[0] == "op")
            for (std::size_t k = 1; k < c.words.size(); ++k) add(c.words[k]);
        if (c.name == "expect" && !c.words.empty()) add(c.words[0].substr(0, c.words[0].find('=')));
    }
    return out;
}

Result<void> AnalysesSweep::choose(const SweepText& said) {
    const auto found = found_quickly(*nominal_);
    std::optional<RunOutcome> quick;
    if (found) quick = *found;
    if (!found && !has(*nominal_, "tran")) return found.error();
    const auto known = numbers_of(*nominal_, quick);
    const auto column = [&](const Said& name) -> Result<std::size_t> {
        for (std::size_t k = 0; k < measures_.size(); ++k)
            if (measures_[k].name == name.text) return k;
        const bool is_known = std::find(known.begin(), known.end(), name.text) != known.end();
        const bool is_curve = quick && quick->number(name.text);
        const bool at_the_end = has(*nominal_, "tran") && name.text.starts_with("v(") && name.text.ends_with(')') &&
                                nominal_->node(std::string_view(name.text).substr(2, name.text.size() - 3)) >= 0;
        if (!is_known && !is_curve && !at_the_end) {
            std::vector<std::string> all = known;
            for (std::size_t n = 1; n < nominal_->nodes.size(); ++n) all.push_back(fmt::format("v({})", nominal_->nodes[n]));
            const std::vector<std::string_view> names(all.begin(), all.end());
            return name.wrong(fmt::format("the netlist has no number '{}'{} (it has {}; voltages are v(NODE), currents i(SOURCE))",
                                          name.text, did_you_mean(name.text, names),
                                          known.empty() ? "none of its own" : fmt::format("{}", fmt::join(known, ", "))));
        }
        measures_.push_back({name.text, unit_of(name.text), ""});
        return measures_.size() - 1;
    };
    if (said.measures) {
        for (const auto& name : *said.measures)
            if (const auto ok = column(name); !ok) return ok.error();
    } else {
        for (const auto& name : known)
            if (const auto ok = column({name, {}}); !ok) return ok.error();
    }
    const Limiting limiting{
        column, [](const Said& model, std::size_t) -> Result<double> {
            return model.wrong("like: models answer to forces; it is for an afferent = ..., not for a netlist's own analyses");
        }};
    if (auto ok = set_limits(said, limiting, measures_); !ok) return ok;
    if (measures_.empty())
        return said.netlist->wrong("the netlist has no number of its own (.meas, .print op); say what is wanted: measures = [\"v(out)\"]");
    return {};
}

Result<void> AnalysesSweep::keep(const SweepText& said) {
    if (!said.traces.empty()) return said.traces[0].wrong("traces are kept of an afferent = ...; of a netlist's own analyses take .meas");
    const auto keeps = keeps_spikes(said);
    if (!keeps) return keeps.error();
    if (!*keeps || !has(*nominal_, "spike")) return {};
    for (const auto& c : nominal_->commands)
        if (c.name == "tran") trains_.push_back(trains_.empty() ? "tran" : fmt::format("tran {}", trains_.size() + 1));
    return {};
}

Result<std::unique_ptr<Sweep>> AnalysesSweep::make(const SweepText& said, const std::string& folder) {
    auto out = std::make_unique<AnalysesSweep>();
    auto& s = *out;
    for (const auto& [name, value] :
         {std::pair{"force", &said.force}, {"rate", &said.rate}, {"channel", &said.channel}, {"every", &said.every}})
        if (*value)
            return (*value)->wrong(fmt::format("{} is of an afferent = ...; a netlist's own .tran takes its force from .force", name));
    auto netlist = NetlistMaker::of(*said.netlist, folder, said.orders ? said.orders->text : "");
    if (!netlist) return netlist.error();
    s.netlist_ = std::move(*netlist);
    for (const auto& setting : said.set)
        if (auto ok = s.netlist_.set(setting); !ok) return ok.error();
    const auto nominal = s.netlist_.nominal();
    if (!nominal) return nominal.error();
    auto elaborated = nominal->elaborate();
    if (!elaborated) return elaborated.error();
    s.nominal_ = std::make_shared<const Circuit>(std::move(*elaborated));
    auto written = circuit::Variants::of(*nominal);
    if (!written) return written.error();
    Varying varying;
    varying.named = s.netlist_.name(), varying.chips = true;
    varying.target = [&](const Said& what) { return s.netlist_.target(what); };
    varying.vary = [&](const SweepAxis& a, const std::string& what, std::size_t axis) { s.netlist_.vary(what, axis, a.column.words); };
    auto units = plan_of(said, varying, &*written);
    if (!units) return units.error();
    s.plan_ = std::move(*units);
    if (s.plan_.draws_chips() && s.nominal_->mismatch)
        return bad_input("[set] chooses one chip by mismatch = ..., and the sweep draws others; leave one of them out", {said.file});
    if (said.iterations) {
        const auto most = whole_of(*said.iterations, "iterations", 1, 1e12);
        if (!most) return most.error();
        s.most_ = static_cast<long>(*most);
    }
    if (auto ok = s.choose(said); !ok) return ok.error();
    if (auto ok = s.keep(said); !ok) return ok.error();
    s.facts_ = first_facts(said, s.nominal_->title);
    for (auto& fact : s.netlist_.facts()) s.facts_.push_back(std::move(fact));
    s.tell_draws(s.netlist_.name(), *s.nominal_);
    return std::unique_ptr<Sweep>(std::move(out));
}

Result<void> AnalysesSweep::prepare(Bench& at, std::span<const double> values) const {
    auto own = netlist_.own(values);
    if (at.bench && at.own == own) return {};
    at.bench.reset();
    std::shared_ptr<const Circuit> circuit = nominal_;
    if (netlist_.varies()) {
        const auto netlist = netlist_.at(values);
        if (!netlist) return netlist.error();
        auto made = netlist->elaborate();
        if (!made) return made.error();
        circuit = std::make_shared<const Circuit>(std::move(*made));
    }
    auto bench = TestBench::make(std::move(circuit));
    if (!bench) return bench.error();
    at.bench = std::move(*bench), at.bench->brief = true, at.own = std::move(own);
    return {};
}

/// What a unit's transients may cost, each: what the file says, else many times what they take as designed.
long AnalysesSweep::most_iterations(const std::function<bool()>& stop) const {
    if (most_ > 0 || !has(*nominal_, "tran")) return most_;
    const std::lock_guard lock(guard_);
    if (most_by_nominal_) return *most_by_nominal_;
    auto bench = TestBench::make(nominal_);
    if (!bench) return 0;
    (*bench)->brief = true;
    circuit::RunOrders orders;
    orders.keep = orders.print = false;
    orders.stop = [&](std::string_view, double) { return stop(); };
    const auto found = circuit::run(**bench, orders);
    if (!found && found.error().code == Code::interrupted) return 0;
    most_by_nominal_ = found ? static_cast<long>(many_times_nominal * static_cast<double>(outcome(0, found).iterations)) : 0;
    return *most_by_nominal_;
}

UnitOutcome AnalysesSweep::outcome(std::int64_t unit, const Result<RunOutcome>& found, bool capped) const {
    UnitOutcome out;
    out.unit = unit;
    out.measures.assign(measures_.size(), std::numeric_limits<double>::quiet_NaN());
    out.spikes.resize(trains_.size());
    if (!found) {
        out.end = capped ? UnitEnd::capped : UnitEnd::lost, out.why = found.error().text();
        return out;
    }
    for (std::size_t k = 0; k < measures_.size(); ++k)
        if (const auto value = found->number(measures_[k].name)) out.measures[k] = *value;
    std::size_t train = 0;
    for (const auto& a : found->analyses) {
        if (a.findings.spikes && train < out.spikes.size()) out.spikes[train++] = *a.findings.spikes;
        for (const auto& [what, count] : a.findings.work) {
            if (what == "steps") out.steps += static_cast<std::int64_t>(count);
            if (what == "iterations") out.iterations += static_cast<std::int64_t>(count);
        }
    }
    return out;
}

Result<void> AnalysesSweep::work(const Next& next, const Told& told, const std::function<bool()>& stop) const {
    Bench at;
    const auto most = most_iterations(stop);
    circuit::RunOrders orders;
    orders.keep = orders.print = false;
    orders.stop = [&](std::string_view, double) { return stop(); };
    while (!stop()) {
        const auto unit = next();
        if (!unit) return {};
        if (const auto ok = prepare(at, plan_.values(*unit)); !ok) {
            told(outcome(*unit, ok.error()));
            continue;
        }
        if (const auto own = circuit::own_draw(*at.bench->circuit))
            at.bench->draw(*own);
        else if (const auto draw = plan_.draw(*unit))
            at.bench->draw(*draw);
        at.bench->most_iterations = most, at.bench->capped = false;
        const auto found = circuit::run(*at.bench, orders);
        if (!found && found.error().code == Code::interrupted) return {};
        if (!found && found.error().code != Code::not_converged) return found.error();
        told(outcome(*unit, found, at.bench->capped));
    }
    return {};
}

}  // namespace

Result<std::unique_ptr<Sweep>> analyses_sweep(const SweepText& said, const std::string& folder) {
    return AnalysesSweep::make(said, folder);
}

}  // namespace corpuscle::sweeps
