#include "study/sweep/subject.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/knobs.hpp"
#include "signal/field.hpp"
#include "signal/quantity.hpp"
#include "signal/text.hpp"
#include "study/sweep/drawn.hpp"

namespace corpuscle::sweeps {
namespace {

constexpr double largest_seed = 0x1p53 - 1;

/// Reads what varies into a plan.
class PlanReader {
    const SweepText& said_;
    const Varying& varying_;
    const circuit::Variants* written_;
    circuit::Chips chips_{0, 0, false, false};
    Drawing drawing_;
    std::vector<SweepAxis> axes_;

    bool writes_chips() const { return written_ && written_->draws(); }
    const SaidAxis* chips_axis() const {
        for (const auto& a : said_.vary)
            if (a.what.text == "process" || a.what.text == "mismatch") return &a;
        return nullptr;
    }

    /// process and mismatch as the file says them, else as the netlist's .mc does.
    Result<void> chips() {
        chips_.seed = drawing_.seed;
        const auto* said = chips_axis();
        if (said && !varying_.chips)
            return said->what.wrong(fmt::format("{} is made of equations; '{}' is of a circuit's chips", varying_.named, said->what.text));
        if (!said && writes_chips()) {
            chips_.process = written_->chips().process, chips_.mismatch = written_->chips().mismatch;
            if (!said_.seed) chips_.seed = drawing_.seed = written_->chips().seed;
        }
        for (const auto& a : said_.vary) {
            if (a.what.text != "process" && a.what.text != "mismatch") continue;
            if (a.how || a.from || a.to || a.count || a.list || a.mean || a.sigma || a.log || a.at_least || a.at_most)
                return a.what.wrong(
                    fmt::format("{}: it is drawn as the process's card says; nothing else is to be said of it", a.what.text));
            bool& one = a.what.text == "process" ? chips_.process : chips_.mismatch;
            if (one) return a.what.wrong(fmt::format("'{}' varies twice", a.what.text));
            one = true;
        }
        return {};
    }

    Result<void> units() {
        const SaidAxis* drawn = chips_axis();
        for (const auto& a : said_.vary)
            if (!drawn && is_drawn(a)) drawn = &a;
        if (said_.units) {
            const auto units = whole_of(*said_.units, "units", 1, 1e9);
            if (!units) return units.error();
            if (!drawn && !writes_chips() && *units > 1)
                return said_.units->wrong(
                    fmt::format("units = {}, but nothing is drawn: all would be alike; a grid says itself how many there are", *units));
            drawing_.draws = static_cast<std::uint64_t>(*units);
        } else if (writes_chips()) {
            drawing_.draws = static_cast<std::uint64_t>(written_->chips().count);
        } else if (drawn) {
            return drawn->what.wrong(fmt::format("{} is drawn, but nobody says how often: units = 1000", drawn->what.text));
        }
        return {};
    }

    bool is_said(std::string_view name) const {
        return std::any_of(said_.vary.begin(), said_.vary.end(), [&](const SaidAxis& a) { return same_letters(a.what.text, name); });
    }

    /// The netlist's own .step, unless the file says it anew.
    Result<void> steps() {
        if (!written_) return {};
        for (const auto& step : written_->axes()) {
            if (is_said(step.name)) continue;
            const auto target = varying_.target({step.name, {}});
            if (!target) return target.error();
            SweepAxis axis{target->column, step.values};
            varying_.vary(axis, step.name, axes_.size());
            axes_.push_back(std::move(axis));
        }
        return {};
    }

    /// The unit that people gave, where the target does not know one.
    static std::string unit_in(const SaidAxis& said) {
        const Said* first = said.list && !said.list->empty() ? &said.list->front()
                            : said.from                      ? &*said.from
                            : said.mean                      ? &*said.mean
                                                             : nullptr;
        const auto value = first ? circuit::number_with_unit(first->text) : Result<circuit::Measured>(Error{});
        return value ? std::string(value->unit) : "";
    }

    Result<void> axis(const SaidAxis& said) {
        for (const auto& other : axes_)
            if (same_letters(other.column.name, said.what.text)) return said.what.wrong(fmt::format("'{}' varies twice", said.what.text));
        auto target = varying_.target(said.what);
        if (!target) return target.error();
        if (target->column.unit.empty() && target->check) target->column.unit = unit_in(said);
        auto axis = axis_of(said, *target, drawing_);
        if (!axis) return axis.error();
        varying_.vary(*axis, said.what.text, axes_.size());
        axes_.push_back(std::move(*axis));
        return {};
    }

public:
    PlanReader(const SweepText& said, const Varying& varying, const circuit::Variants* written)
        : said_(said), varying_(varying), written_(written) {}

    Result<SweepPlan> read() {
        const auto seed = seed_of(said_);
        if (!seed) return seed.error();
        drawing_.seed = *seed;
        if (auto ok = chips(); !ok) return ok.error();
        if (auto ok = units(); !ok) return ok.error();
        if (auto ok = steps(); !ok) return ok.error();
        for (const auto& a : said_.vary)
            if (a.what.text != "process" && a.what.text != "mismatch")
                if (auto ok = axis(a); !ok) return ok.error();
        double count = static_cast<double>(drawing_.draws);
        for (const auto& a : axes_) count *= a.values.empty() ? 1 : static_cast<double>(a.values.size());
        if (count > SweepPlan::most_units)
            return bad_input(fmt::format("{:g} units; at most {:g}", count, SweepPlan::most_units), {said_.file});
        return SweepPlan(std::move(axes_), chips_, static_cast<std::int64_t>(drawing_.draws));
    }
};

/// One line of [limits] into its column.
Result<void> set_limit(const SaidLimit& limit, const Limiting& limiting, std::vector<SweepColumn>& columns) {
    const auto at = limiting.column(limit.measure);
    if (!at) return at.error();
    auto& column = columns[*at];
    const auto wrong = [&](const Said& s, std::string why) { return s.wrong(fmt::format("{}: {}", limit.measure.text, why)); };
    const auto read = [&](const Said& s) {
        const auto value = parse_quantity(s.text, column.unit);
        return value ? value : Result<double>(wrong(s, value.error().sentence));
    };
    if (limit.like) {
        if (limit.at_least || limit.at_most) return wrong(*limit.like, "either like and within, or at_least and at_most");
        if (!limit.within) return wrong(*limit.like, "within is missing: how far from the model a unit may be, such as 3 or \"10%\"");
        const auto model = limiting.like(*limit.like, *at);
        if (!model) return model.error();
        if (std::isnan(*model)) return wrong(*limit.like, fmt::format("{} has none of it under this force", limit.like->text));
        const bool share = trimmed(limit.within->text).ends_with('%') && !column.unit.empty();
        auto within = share ? parse_quantity(limit.within->text, "") : read(*limit.within);
        if (!within) return wrong(*limit.within, within.error().sentence);
        if (share || trimmed(limit.within->text).ends_with('%')) *within *= std::abs(*model);
        if (!(*within >= 0)) return wrong(*limit.within, "within is not below 0");
        column.at_least = *model - *within, column.at_most = *model + *within;
        return {};
    }
    if (limit.within) return wrong(*limit.within, "within goes with like = \"sa1\"");
    for (const auto& [said, end] : {std::pair{&limit.at_least, &column.at_least}, {&limit.at_most, &column.at_most}}) {
        if (!*said) continue;
        const auto value = read(**said);
        if (!value) return value.error();
        *end = *value;
    }
    if (!limit.at_least && !limit.at_most) return wrong(limit.measure, "the limit is empty; write at_least, at_most or both");
    if (column.at_least && column.at_most && *column.at_least > *column.at_most)
        return wrong(limit.at_least ? *limit.at_least : limit.measure, "nothing is at least this and at most that");
    return {};
}

}  // namespace

void PlannedSweep::tell_draws(const std::string& subject, const circuit::Circuit& circuit) {
    if (!plan_.chips().mismatch) return;
    Drawn drawn;
    drawn.seed = plan_.chips().seed, drawn.chips = plan_.draws();
    drawn.subjects.push_back({subject, drawn_devices(circuit)});
    facts_.push_back({drawn_fact, text_of(drawn)});
}

Result<std::uint64_t> seed_of(const SweepText& said) {
    if (!said.seed) return std::uint64_t{0};
    const auto seed = whole_of(*said.seed, "seed", 0, largest_seed);
    if (!seed) return seed.error();
    return static_cast<std::uint64_t>(*seed);
}

Result<SweepPlan> plan_of(const SweepText& said, const Varying& varying, const circuit::Variants* written) {
    return PlanReader(said, varying, written).read();
}

Result<void> set_limits(const SweepText& said, const Limiting& limiting, std::vector<SweepColumn>& columns) {
    for (const auto& limit : said.limits)
        if (auto ok = set_limit(limit, limiting, columns); !ok) return ok;
    return {};
}

Result<bool> keeps_spikes(const SweepText& said) {
    if (!said.keep) return true;
    for (const auto& word : *said.keep)
        if (word.text != "spikes")
            return word.wrong(fmt::format("keep: '{}' is unknown; there is \"spikes\" (traces are kept by traces = [...])", word.text));
    return !said.keep->empty();
}

Result<std::size_t> samples_between(const SweepText& said, double T) {
    double every = 1e-3;
    if (said.every) {
        const auto value = parse_quantity(said.every->text, "s");
        if (!value) return said.every->wrong("every: " + value.error().sentence);
        if (!(*value > 0 && *value < 1e9)) return said.every->wrong(fmt::format("every = {} must be above 0", said.every->text));
        every = *value;
    }
    return static_cast<std::size_t>(std::max(1.0, std::round(every / T)));
}

std::vector<Sweep::Fact> first_facts(const SweepText& said, const std::string& title) {
    std::vector<Sweep::Fact> out = {{"title", said.title ? said.title->text : title},
                                    {"results format", fmt::format("{}", results_format)}};
    if (!said.canonical.empty()) out.push_back({"sweep file", said.canonical});
    return out;
}

}  // namespace corpuscle::sweeps
