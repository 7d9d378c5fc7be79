#include "model/copies.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

constexpr std::uint64_t max_samples = 1000;  // random draws for one parameter of one copy

/// Index of a parameter among the plan's parameters, which must contain it.
std::size_t index_of(const AfferentPlan& plan, std::string_view parameter) {
    const auto& all = *plan.parameters;
    return static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const AfferentParameter& p) { return p.info.name == parameter; }) - all.begin());
}

/// Remedy for a relative spread of a value that is 0.
std::string write_deviation(std::string_view unit) {
    return fmt::format("write the deviation itself{}", unit.empty() ? ", a plain number" : fmt::format(", in {}", unit));
}

/// Parses the factor of a lognormal distribution in o.value: "x3".
Result<ParameterDistribution> parse_factor(const AfferentPlan& plan, const ParameterOverride& o, const ParameterInfo& row) {
    const auto error = [&](std::string_view why) { return bad_input(fmt::format("{}: {}", o.typed, why), o.location); };
    const auto factor = parse_bare_number<double>(trimmed(trimmed(o.value).substr(1)));
    if (!factor || !std::isfinite(*factor)) return error(fmt::format("'{}' is not a factor; write x and a number, such as 'x3'", o.value));
    if (*factor < 1) return error("a factor must be at least 1; x3 means divided by 3 or multiplied by 3");
    if (plan.values[index_of(plan, row.name)] == 0 && *factor > 1)
        return error(fmt::format("{} times a factor is 0; {}", format_quantity(0, row.unit), write_deviation(row.unit)));
    return ParameterDistribution{.afferent = plan.name, .parameter = row.name, .unit = row.unit, .factor = *factor};
}

/// Parses the spread in o.value: a standard deviation as a percentage of the plan's value of the parameter ("10%") or as a number in the
/// parameter's unit, or a factor ("x3").
Result<ParameterDistribution> parse_spread(const AfferentPlan& plan, const ParameterOverride& o, const ParameterInfo& row) {
    if (trimmed(o.value).starts_with('x')) return parse_factor(plan, o, row);
    const auto error = [&](std::string_view why) { return bad_input(fmt::format("{}: {}", o.typed, why), o.location); };
    const bool is_percentage = trimmed(o.value).ends_with('%');
    const auto read = parse_quantity(o.value, is_percentage ? "" : row.unit);
    if (!read && is_percentage) return error(fmt::format("'{}' is not a percentage; write a number and %, such as '10%'", o.value));
    if (!read) return error(read.error().message);
    if (*read < 0) return error("a standard deviation must not be negative");
    if (!is_percentage) return ParameterDistribution{plan.name, row.name, row.unit, *read};
    const double value = plan.values[index_of(plan, row.name)];
    if (value == 0 && *read > 0)
        return error(fmt::format("a percentage of {} is 0; {}", format_quantity(0, row.unit), write_deviation(row.unit)));
    return ParameterDistribution{plan.name, row.name, row.unit, *read * std::abs(value), *read};
}

/// Samples the parameters of all copies of one plan.
class CopySampler {
    struct SampledParameter {
        std::size_t at;    ///< index among the plan's parameters
        double value;      ///< mean of a normal distribution, median of a lognormal one, SI
        double deviation;  ///< standard deviation of the value, SI; of its logarithm if the distribution is lognormal
        bool is_lognormal;
        std::string spread;  ///< ParameterDistribution::text()
        ParameterInfo row;
        std::uint64_t stream;     ///< identifies the parameter's random numbers
        std::size_t group;        ///< parameters linked by order constraints form a group and are sampled together
        std::uint64_t count = 0;  ///< random draws so far for the current copy
    };
    /// An order constraint of the plan.
    struct OrderBound {
        std::size_t lower, upper;  ///< indices among the plan's parameters
        bool or_equal;
    };
    const AfferentPlan& plan_;
    std::uint64_t seed_;
    std::vector<SampledParameter> sampled_;
    std::vector<OrderBound> bounds_;
    std::vector<std::size_t> group_of_;  // group of each of the plan's parameters, sampled or not

    /// True if the parameter with index `at` is sampled.
    bool is_sampled(std::size_t at) const {
        return std::any_of(sampled_.begin(), sampled_.end(), [&](const SampledParameter& d) { return d.at == at; });
    }

    /// Draws values of one parameter until one lies within the parameter's range. Returns false if max_samples is reached before.
    bool sample(SampledParameter& d, AfferentPlan& copy) const {
        while (d.count < max_samples) {
            const auto index = (d.stream >> 32 << 32) | d.count++;  // the upper half of the stream's 64 bits, and the number of the draw
            const double z = d.deviation * normal(seed_, copy.copy_number, static_cast<std::uint32_t>(d.stream), index);
            const double x = d.is_lognormal ? d.value * num::exp(z) : d.value + z;
            if (!(x >= d.row.low && x <= d.row.high)) continue;
            copy.values[d.at] = x;
            return true;
        }
        return false;
    }

    /// True if all order constraints that involve a parameter of the group hold.
    bool in_order(const AfferentPlan& copy, std::size_t group) const {
        return std::all_of(bounds_.begin(), bounds_.end(), [&](const OrderBound& b) {
            const double lower = copy.values[b.lower], upper = copy.values[b.upper];
            return (group_of_[b.lower] != group && group_of_[b.upper] != group) || (b.or_equal ? lower <= upper : lower < upper);
        });
    }

    /// Samples the parameters of a group until its order constraints hold. Returns false if a parameter reaches max_samples before.
    bool sample_group(std::size_t group, AfferentPlan& copy) {
        do
            for (auto& d : sampled_)
                if (d.group == group && !sample(d, copy)) return false;
        while (!in_order(copy, group));
        return true;
    }

    /// Samples all parameters of a copy, group by group. Returns false if one reaches max_samples before.
    bool sample_all(AfferentPlan& copy) {
        for (std::size_t group = 0; group < group_of_.size(); ++group)
            if (std::any_of(sampled_.begin(), sampled_.end(), [&](const SampledParameter& d) { return d.group == group; }))
                if (!sample_group(group, copy)) return false;
        return true;
    }

    /// The error if a parameter has reached max_samples. `last` is the reason why the last values were refused.
    Error exhausted(const AfferentPlan& copy, const Result<void>& last) const {
        const auto& worst = *std::max_element(sampled_.begin(), sampled_.end(),
                                              [](const SampledParameter& a, const SampledParameter& b) { return a.count < b.count; });
        return bad_input(fmt::format("{}: none of {} samples of {} about {} with a {} of {} is valid{}; lower its --spread", copy.name,
                                     max_samples, worst.row.name, format_quantity(worst.value, worst.row.unit),
                                     worst.is_lognormal ? "spread" : "standard deviation", worst.spread,
                                     last ? "" : fmt::format(" (the last: {})", last.error().message)));
    }

public:
    CopySampler(const AfferentPlan& plan, std::span<const ParameterDistribution> distributions, std::uint64_t seed)
        : plan_(plan), seed_(seed), group_of_(plan.values.size()) {
        std::iota(group_of_.begin(), group_of_.end(), std::size_t{0});
        for (const auto& s : distributions) {
            if (s.afferent != plan.name) continue;
            const auto at = index_of(plan, s.parameter);
            sampled_.push_back({at, plan.values[at], s.factor ? num::log(*s.factor) : s.deviation, s.factor.has_value(), s.text(),
                                (*plan.parameters)[at].info, stream_id(fmt::format("{}.{}", plan.name, s.parameter)),
                                0});  // the group is set below
        }
        for (const auto& o : order_constraints_of(plan)) bounds_.push_back({index_of(plan, o.lower), index_of(plan, o.upper), o.or_equal});
        for (const auto& b : bounds_)
            if (is_sampled(b.lower) && is_sampled(b.upper))  // merges their groups
                std::replace(group_of_.begin(), group_of_.end(), std::size_t{group_of_[b.upper]}, std::size_t{group_of_[b.lower]});
        for (auto& d : sampled_) d.group = group_of_[d.at];
    }

    Result<AfferentPlan> copy(std::uint32_t number) {
        AfferentPlan copy = plan_;
        copy.original_name = plan_.name, copy.copy_number = number, copy.name = fmt::format("{}#{}", plan_.name, number);
        if (sampled_.empty()) return copy;
        for (auto& d : sampled_) d.count = 0;
        Result<void> valid;
        do
            // In the first pass `valid` holds no error yet; the values sampled last then give the reason.
            if (!sample_all(copy)) return exhausted(copy, valid ? check_plan(copy) : valid);
        while (!(valid = check_plan(copy)));
        return copy;
    }
};

}  // namespace

std::string ParameterDistribution::text() const {
    if (factor) return fmt::format("x{:.4g}", *factor);
    return fraction ? fmt::format("{:.3g}%", *fraction * 100) : format_quantity(deviation, unit);
}

Result<Applied<std::vector<ParameterDistribution>>> distributions_for(const AfferentPlan& plan,
                                                                      std::span<const ParameterOverride> overrides) {
    const auto rows = parameter_infos(plan);
    const bool ignores_case = plan.traits().ignores_case;
    auto [own, unused] = select_overrides(overrides, [&](std::string_view target) { return matches_name(plan, target); });
    std::vector<ParameterDistribution> distributions;
    for (auto& o : own) {
        if (ignores_case) o.parameter = lower(o.parameter);
        const auto error = [&](ErrorCode code, std::string why) { return Error{code, fmt::format("{}: {}", o.typed, why), o.location}; };
        const auto row = TRY(find_parameter(o, rows));
        if (row->is_shared_by_copies)
            return error(ErrorCode::bad_input, fmt::format("{} has one value for all copies; --set {} changes it", o.parameter, o.name()));
        if (std::any_of(distributions.begin(), distributions.end(),
                        [&](const ParameterDistribution& s) { return s.parameter == o.parameter; }))
            return error(ErrorCode::bad_usage, fmt::format("{}.{} is given twice", plan.name, o.parameter));
        distributions.push_back(TRY(parse_spread(plan, o, *row)));
    }
    return Applied<std::vector<ParameterDistribution>>{std::move(distributions), std::move(unused)};
}

Result<std::vector<AfferentPlan>> make_copies(const AfferentPlan& plan, std::uint32_t n,
                                              std::span<const ParameterDistribution> distributions, std::uint64_t seed) {
    std::vector<AfferentPlan> copies;
    copies.reserve(n);
    CopySampler sampler(plan, distributions, seed);
    for (std::uint32_t number = 1; number <= n; ++number) {
        auto copy = TRY(sampler.copy(number));
        auto rebuilt = TRY(plan.factory->rebuilt(copy, plan));
        if (rebuilt) copy.factory = std::move(rebuilt);
        copies.push_back(std::move(copy));
    }
    return copies;
}

std::vector<std::size_t> copy_group_starts(std::span<const AfferentPlan> plans) {
    std::vector<std::size_t> starts;
    for (std::size_t k = 0; k < plans.size(); ++k)
        if (plans[k].copy_number <= 1) starts.push_back(k);
    starts.push_back(plans.size());
    return starts;
}

const std::string& base_name(const AfferentPlan& plan) { return plan.copy_number > 0 ? plan.original_name : plan.name; }

}  // namespace corpuscle
