#include "fit/afferent_fit.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/identifiability.hpp"
#include "model/catalog.hpp"

namespace corpuscle {
namespace {

/// Points of the search as afferents.
class FitPoints {
    const FitProblem& problem_;
    const AfferentPlan& plan_;
    std::span<const FreeParameter> parameters_;

public:
    FitPoints(const FitProblem& problem, const AfferentPlan& plan, std::span<const FreeParameter> parameters)
        : problem_(problem), plan_(plan), parameters_(parameters) {}

    AfferentPlan plan(std::span<const double> point) const { return plan_at(plan_, parameters_, point); }
    Result<std::vector<ResidualBlock>> residuals(std::span<const double> point, std::size_t stage) const {
        const auto at = plan(point);
        TRY(check_plan(at));
        return problem_.residuals(at, stage);
    }
    double cost(std::span<const double> point, std::size_t stage) const {
        const auto all = residuals(point, stage);
        const double value = all ? cost_of(*all) : forbidden_cost;
        return value < forbidden_cost ? value : forbidden_cost;  // NaN is forbidden, too
    }
};

/// The point after a move along a direction, in natural coordinates, with `size` as its largest component. It is shortened where it
/// reaches a bound.
std::vector<double> moved(std::span<const FreeParameter> parameters, std::span<const double> point, std::span<const double> direction,
                          double size) {
    double largest = 0;
    for (const double d : direction) largest = std::max(largest, std::abs(d));
    double length = size / largest;
    const auto step = [&](std::size_t k) { return direction[k] / parameters[k].width(); };
    for (std::size_t k = 0; k < point.size(); ++k)
        if (const double s = step(k) * length; std::abs(direction[k]) > 1e-3 * largest && (point[k] + s > 1 || point[k] + s < 0))
            length *= std::clamp(((s > 0 ? 1 : 0) - point[k]) / s, 0.0, 1.0);
    std::vector<double> out(point.begin(), point.end());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = std::clamp(out[k] + step(k) * length, 0.0, 1.0);
    return out;
}

constexpr double named_part = 0.25;  // of a direction's largest component; smaller components are not named

/// The change along a weak direction: to twice or half the values, where the bounds leave more room.
ParameterTrade trade_along(const FitPoints& points, std::span<const FreeParameter> parameters, std::span<const double> point,
                           std::span<const double> direction, std::size_t stage, double cost, double reference) {
    using std::numbers::ln2;
    const auto up = moved(parameters, point, direction, ln2), down = moved(parameters, point, direction, -ln2);
    const auto distance = [&](const std::vector<double>& to) {
        double sum = 0;
        for (std::size_t k = 0; k < to.size(); ++k) sum += std::abs(to[k] - point[k]);
        return sum;
    };
    const auto& to = distance(up) >= distance(down) ? up : down;
    double largest = 0;
    for (const double d : direction) largest = std::max(largest, std::abs(d));
    ParameterTrade out;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        if (std::abs(direction[k]) < named_part * largest) continue;
        const double before = parameters[k].value(point[k]), after = parameters[k].value(to[k]);
        out.factors.emplace_back(parameters[k].name, parameters[k].is_logarithmic() ? after / before : after);
    }
    out.score_change = (points.cost(to, stage) - cost) / reference;
    return out;
}

void add_intervals(FitResult& result, const Identifiability& known, std::span<const double> point) {
    for (std::size_t k = 0; k < result.parameters.size(); ++k) {
        auto& p = result.parameters[k];
        if (!known.parameters[k].is_identified || p.is_at_bound) continue;
        const double half = known.parameters[k].half_width / p.parameter.width();
        // The interval may be wider than the bounds, which only limit the search.
        p.low = p.parameter.unbounded_value(point[k] - half), p.high = p.parameter.unbounded_value(point[k] + half);
    }
}

std::string bound_warning(const FreeParameter& parameter, double value) {
    const bool upper = parameter.coordinate(value) > 0.5;
    const auto wider = parameter.wider_bounds(upper);
    if (wider.empty()) return fmt::format("{} ended at {:.4g}, the end of its range", parameter.name, value);
    return fmt::format("{0} ended at its bound {1:.4g}; if {2} is plausible, widen: --bounds {0}={3}", parameter.name, value,
                       upper ? "more" : "less", wider);
}

std::vector<std::string> warnings_of(const FitResult& result, const FitProblem& problem) {
    auto out = problem.warnings(result.plan);
    for (const auto& p : result.parameters)
        if (p.is_at_bound) out.push_back(bound_warning(p.parameter, p.value));
    if (result.parameters.size() > problem.size())
        out.push_back(
            fmt::format("{} free parameters but only {} data: many values fit equally well", result.parameters.size(), problem.size()));
    for (const auto& row : result.rows)
        if (!row.reason.empty()) out.push_back(fmt::format("{} {}: {}", row.data, row.measure, row.reason));
    return out;
}

}  // namespace

Result<FitResult> fit(const FitProblem& problem, const AfferentPlan& plan, std::span<const FreeParameter> parameters, ThreadPool& pool,
                      SearchOptions options) {
    for (const auto& p : parameters)
        if (const auto reason = problem.reason_not_determined(p.name); !reason.empty())
            return bad_input(fmt::format("--free {}: {}", p.name, reason));
    const FitPoints points(problem, plan, parameters);
    const std::size_t last = problem.stages() - 1;
    std::vector<double> start;
    for (const auto& p : parameters) start.push_back(p.coordinate(p.start));
    options.stages = problem.stages();
    auto found = search_minimum([&](std::span<const double> x, std::size_t stage) { return points.cost(x, stage); }, start, pool, options);
    if (!(found.cost < forbidden_cost)) {
        const auto failed = points.residuals(found.point, last);
        return failed ? bad_input(fmt::format("{}: no values within the bounds are possible", plan.name)) : failed.error();
    }
    const double reference = problem.reference_cost(false);
    const ResidualFunction residuals = [&](std::span<const double> x) { return points.residuals(x, last); };
    if (!found.is_interrupted) {
        found.point = gauss_newton(residuals, parameters, found.point, problem.slope_effect(), [&] { return options.should_continue(1); });
        found.cost = points.cost(found.point, last);
    }
    FitResult out;
    out.plan = points.plan(found.point), out.evaluations = found.evaluations, out.is_interrupted = found.is_interrupted;
    const auto at_start = problem.residuals(plan, last);
    out.start_score = at_start ? cost_of(*at_start) / reference : NAN;
    const auto blocks = TRY(points.residuals(found.point, last));
    out.score = found.cost / reference;
    if (problem.reference_cost(true) > 0) out.test_score = cost_of(blocks, true) / problem.reference_cost(true);
    out.rows = TRY(problem.rows(out.plan));
    out.starts = found.local_costs.size();
    for (const double cost : found.local_costs) out.agreeing_starts += cost <= found.cost * 1.05 + negligible_cost;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        FittedParameter p{parameters[k], parameters[k].value(found.point[k])};
        p.is_at_bound = found.point[k] < 1e-4 || found.point[k] > 1 - 1e-4;
        out.parameters.push_back(std::move(p));
    }
    if (!out.is_interrupted) {
        const RepetitionFunction repetition = [&](double noise, std::uint64_t seed) { return problem.repetition(out.plan, noise, seed); };
        const auto known = TRY(identifiability(residuals, parameters, found.point, problem.slope_effect(), problem.has_known_deviations(),
                                               problem.can_repeat(out.plan) ? repetition : nullptr));
        add_intervals(out, known, found.point);
        for (const auto& w : known.weak)
            out.trades.push_back(trade_along(points, parameters, found.point, w.direction, last, found.cost, reference));
    }
    out.warnings = warnings_of(out, problem);
    return out;
}

}  // namespace corpuscle
