#include "model/spread.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "signal/quantity.hpp"
#include "signal/random.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

constexpr std::uint64_t most_draws = 1000;  // of one parameter of one copy

std::size_t place_of(const AfferentPlan& plan, std::string_view parameter) {
    const auto& all = *plan.parameters;
    return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.row.name == parameter; }) -
                                    all.begin());
}

/// A deviation as it was written: a share of the value ("10%"), or in the parameter's own unit.
Result<Spread> parse_spread(const AfferentPlan& plan, const Wish& w, const Row& row) {
    const auto refused = [&](std::string_view why) { return bad_input(fmt::format("--spread {}: {}", w.text(), why)); };
    const bool shared = trimmed(w.value).ends_with('%');
    const auto read = parse_quantity(w.value, shared ? "" : row.unit);
    if (!read && shared) return refused(fmt::format("'{}' is no share; write a number and %, such as '10%'", w.value));
    if (!read) return refused(read.error().sentence);
    if (*read < 0) return refused("a standard deviation is not below 0");
    if (!shared) return Spread{plan.name, row.name, row.unit, *read};
    const double value = plan.values[place_of(plan, row.name)];
    if (value == 0 && *read > 0)
        return refused(fmt::format("a share of {} is nothing; write the deviation itself{}", format_quantity(0, row.unit),
                                   row.unit.empty() ? ", a plain number" : fmt::format(", in {}", row.unit)));
    return Spread{plan.name, row.name, row.unit, *read * std::abs(value), *read};
}

/// Everything that the copies of one plan are drawn with.
class Drawing {
    struct Drawn {
        std::size_t at;  ///< among the plan's parameters
        double value, deviation;
        Row row;
        std::uint64_t stream;
        std::size_t group;  ///< those that orders bind are drawn together
        std::uint64_t draws = 0;
    };
    struct Bound {
        std::size_t less, more;  ///< among the plan's parameters
        bool or_equal;
    };
    const AfferentPlan& plan_;
    std::uint64_t seed_;
    std::vector<Drawn> drawn_;
    std::vector<Bound> bounds_;
    std::vector<std::size_t> group_of_;  // of each of the plan's parameters

    void join(std::size_t a, std::size_t b) {
        const auto from = group_of_[b], to = group_of_[a];
        std::replace(group_of_.begin(), group_of_.end(), from, to);
    }

    bool is_drawn(std::size_t at) const {
        return std::any_of(drawn_.begin(), drawn_.end(), [&](const Drawn& d) { return d.at == at; });
    }

    /// The next value within the row's range; false if there was none.
    bool draw(Drawn& d, AfferentPlan& copy) const {
        while (d.draws < most_draws) {
            const auto index = (d.stream >> 32 << 32) | d.draws++;
            const double x = d.value + d.deviation * normal(seed_, copy.copy, static_cast<std::uint32_t>(d.stream), index);
            if (!(x >= d.row.low && x <= d.row.high)) continue;
            copy.values[d.at] = x;
            return true;
        }
        return false;
    }

    bool in_order(const AfferentPlan& copy, std::size_t group) const {
        return std::all_of(bounds_.begin(), bounds_.end(), [&](const Bound& b) {
            const double less = copy.values[b.less], more = copy.values[b.more];
            return (group_of_[b.less] != group && group_of_[b.more] != group) || (b.or_equal ? less <= more : less < more);
        });
    }

    /// Draws what is of a group until its orders hold.
    bool draw_group(std::size_t group, AfferentPlan& copy) {
        do
            for (auto& d : drawn_)
                if (d.group == group && !draw(d, copy)) return false;
        while (!in_order(copy, group));
        return true;
    }

    bool draw_all(AfferentPlan& copy) {
        for (std::size_t group = 0; group < group_of_.size(); ++group)
            if (std::any_of(drawn_.begin(), drawn_.end(), [&](const Drawn& d) { return d.group == group; }))
                if (!draw_group(group, copy)) return false;
        return true;
    }

    Error exhausted(const AfferentPlan& copy, const std::optional<Error>& last) const {
        const auto& most =
            *std::max_element(drawn_.begin(), drawn_.end(), [](const Drawn& a, const Drawn& b) { return a.draws < b.draws; });
        return bad_input(
            fmt::format("{}: {} draws of {} about {} with a standard deviation of {} gave none that can stand{}; lower its "
                        "--spread",
                        copy.name, most_draws, most.row.name, format_quantity(most.value, most.row.unit),
                        format_quantity(most.deviation, most.row.unit), last ? fmt::format(" (the last: {})", last->sentence) : ""));
    }

public:
    Drawing(const AfferentPlan& plan, std::span<const Spread> spreads, std::uint64_t seed)
        : plan_(plan), seed_(seed), group_of_(plan.values.size()) {
        std::iota(group_of_.begin(), group_of_.end(), std::size_t{0});
        for (const auto& s : spreads) {
            if (s.afferent != plan.name) continue;
            const auto at = place_of(plan, s.parameter);
            drawn_.push_back(
                {at, plan.values[at], s.deviation, (*plan.parameters)[at].row, stream_of(fmt::format("{}.{}", plan.name, s.parameter)), 0});
        }
        for (const auto& o : orders_of(plan)) bounds_.push_back({place_of(plan, o.lesser), place_of(plan, o.greater), o.or_equal});
        for (const auto& b : bounds_)
            if (is_drawn(b.less) && is_drawn(b.more)) join(b.less, b.more);
        for (auto& d : drawn_) d.group = group_of_[d.at];
    }

    Result<AfferentPlan> copy(std::uint32_t number) {
        AfferentPlan copy = plan_;
        copy.of = plan_.name, copy.copy = number, copy.name = fmt::format("{}#{}", plan_.name, number);
        if (drawn_.empty()) return copy;
        for (auto& d : drawn_) d.draws = 0;
        std::optional<Error> wrong;
        do
            if (!draw_all(copy)) return exhausted(copy, wrong ? wrong : refusal(copy));
        while ((wrong = refusal(copy)));
        return copy;
    }
};

}  // namespace

Result<std::vector<Spread>> spreads_for(const AfferentPlan& plan, std::string_view asked, std::span<const Wish> wishes) {
    std::vector<Row> rows;
    for (const auto& p : *plan.parameters) rows.push_back(p.row);
    std::vector<Spread> spreads;
    for (const auto& w : wishes) {
        if (!goes_by(plan, asked, w.of)) continue;
        w.used = true;
        const auto row = row_for(w, rows);
        if (!row) return row.error();
        if ((*row)->one_for_all)
            return bad_input(fmt::format("--spread {}: {} is one number for all copies; --set {}.{} changes it", w.text(), w.parameter,
                                         w.of, w.parameter));
        if (std::any_of(spreads.begin(), spreads.end(), [&](const Spread& s) { return s.parameter == w.parameter; }))
            return bad_usage(fmt::format("--spread {}: {}.{} is given twice", w.text(), plan.name, w.parameter));
        auto spread = parse_spread(plan, w, **row);
        if (!spread) return spread.error();
        spreads.push_back(std::move(*spread));
    }
    return spreads;
}

Result<std::vector<AfferentPlan>> copies_of(const AfferentPlan& plan, std::uint32_t n, std::span<const Spread> spreads,
                                            std::uint64_t seed) {
    std::vector<AfferentPlan> copies;
    copies.reserve(n);
    Drawing drawing(plan, spreads, seed);
    for (std::uint32_t number = 1; number <= n; ++number) {
        auto copy = drawing.copy(number);
        if (!copy) return copy.error();
        copies.push_back(std::move(*copy));
    }
    return copies;
}

std::vector<std::size_t> groups_of(std::span<const AfferentPlan> plans) {
    std::vector<std::size_t> begins;
    for (std::size_t k = 0; k < plans.size(); ++k)
        if (plans[k].copy <= 1) begins.push_back(k);
    begins.push_back(plans.size());
    return begins;
}

const std::string& base_name(const AfferentPlan& plan) { return plan.copy > 0 ? plan.of : plan.name; }

}  // namespace corpuscle
