#include "optimize/design_score.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/text/quantity.hpp"

namespace corpuscle::optimize {
namespace {

constexpr double not_converged_excess = 200, truncated_excess = 100;

/// Takes the excess over a limit, if it is larger than those before.
void take(CaseScore& score, double excess, bool is_met, const auto& limit) {
    const double counted = is_met ? std::min(excess, 0.0) : min_excess + std::max(excess, 0.0);
    score.is_within = score.is_within && is_met;
    if (score.limit.empty() || counted > score.excess) score.excess = counted, score.limit = limit();
}

/// The excess of x over a limit, in units of `scale`. A number of spikes is within it up to half a spike further; none at all, where none
/// is allowed, says nothing about how far the next one is.
double measure_excess(const SweepColumn& measure, double x, double limit, double direction, double scale) {
    const bool is_count = measure.name.starts_with("spikes");
    if (is_count && direction > 0 && limit == 0 && x == 0) return -1;
    return (direction * (x - limit) - (is_count ? 0.5 : 0)) / scale;
}

void add_measure_limits(const OptimizationProblem& problem, std::size_t number, const ItemOutcome& outcome, CaseScore& score) {
    for (std::size_t k = 0; k < problem.sweep->measures.size(); ++k) {
        const auto& m = problem.sweep->measures[k];
        if ((!m.min && !m.max) || (problem.is_nominal_limit[k] && !problem.is_nominal(number))) continue;
        const double x = outcome.measures[k];
        if (std::isnan(x)) {
            take(score, 10, false, [&] { return m.name + " has no value"; });
            continue;
        }
        // Half the allowed range; of one limit its magnitude. A limit of 0 has a scale only for numbers without a unit.
        double scale = m.min && m.max ? (*m.max - *m.min) / 2 : std::abs(m.min ? *m.min : *m.max);
        if (scale == 0) scale = m.unit.empty() || x == 0 ? 1 : std::abs(x);
        if (m.min)
            take(score, measure_excess(m, x, *m.min, -1, scale), x >= *m.min,
                 [&] { return fmt::format("{} at least {}", m.name, format_quantity(*m.min, m.unit)); });
        if (m.max)
            take(score, measure_excess(m, x, *m.max, 1, scale), x <= *m.max,
                 [&] { return fmt::format("{} at most {}", m.name, format_quantity(*m.max, m.unit)); });
    }
}

std::string phase_text(const OptimizationProblem& problem, const TimeWindow& window) {
    if (const auto* force = problem.sweep->nominal_force())
        for (const auto& p : force->phases)
            if (p.from == window.from && p.to == window.to) return p.name;
    return fmt::format("{:.4g} to {:.4g} s", window.from, window.to);
}

/// The number of spikes in each phase. The excess follows from the spread number, which changes steadily with the design.
void add_pattern_limits(const OptimizationProblem& problem, std::span<const double> spikes, CaseScore& score) {
    const auto& pattern = *problem.pattern;
    for (const auto& p : pattern.phases) {
        const auto count =
            static_cast<double>(std::ranges::count_if(spikes, [&](double t) { return t >= p.phase.from && t < p.phase.to; }));
        const double half = (p.max - p.min) / 2 + 0.5, middle = (p.max + p.min) / 2;
        const double deviation = std::abs(spread_count(spikes, p.phase) - middle) - half;
        take(score, deviation / half, count >= p.min && count <= p.max,
             [&] { return fmt::format("{:g} to {:g} spikes in {}", p.min, p.max, phase_text(problem, p.phase)); });
    }
    if (pattern.first_spike_tolerance <= 0) return;
    const double delay = spikes.empty() ? pattern.phases.back().phase.to : std::abs(spikes[0] - pattern.first_spike);
    take(score, delay / pattern.first_spike_tolerance - 1, !spikes.empty() && delay <= pattern.first_spike_tolerance,
         [&] { return fmt::format("first spike within {}", format_quantity(pattern.first_spike_tolerance, "s")); });
}

/// The chip that decides about the yield: the worst one, apart from the number of chips that may fail. Chips that were not simulated count
/// as within the limits. No value if fewer chips were simulated than may fail. `chips`: their indices in `scores`.
std::optional<std::size_t> decisive_chip(const OptimizationProblem& problem, std::vector<std::size_t>& chips,
                                         std::span<const CaseScore> scores) {
    if (chips.empty()) return {};
    const auto all = static_cast<double>(problem.chip_count());
    const auto may_fail = static_cast<std::size_t>(all - std::max(1.0, std::ceil(problem.required_yield * all - 1e-9)));
    if (may_fail >= chips.size()) return {};
    std::ranges::sort(chips, [&](std::size_t a, std::size_t b) {
        return scores[a].excess != scores[b].excess ? scores[a].excess > scores[b].excess : a < b;
    });
    return chips[may_fail];
}

double goal_of(const OptimizationProblem& problem, std::span<const std::size_t> cases, std::span<const CaseScore> scores,
               const DesignScore& design) {
    using Over = DesignGoal::Over;
    if (problem.goal.kind == DesignGoal::Kind::none) return 0;
    if (problem.goal.kind == DesignGoal::Kind::yield)
        return design.chips == 0 ? 0 : static_cast<double>(design.chips_within) / static_cast<double>(design.chips);
    if (problem.goal.over == Over::first) return scores[0].value;
    double sum = 0, worst = -std::numeric_limits<double>::infinity(), count = 0;
    const double sign = problem.goal.is_maximized ? -1 : 1;
    for (std::size_t k = 0; k < cases.size(); ++k) {
        if (cases[k] >= problem.condition_count) continue;
        if (std::isnan(scores[k].value)) return scores[k].value;
        sum += scores[k].value, worst = std::max(worst, sign * scores[k].value), ++count;
    }
    return problem.goal.over == Over::mean ? sum / count : sign * worst;
}

}  // namespace

CaseScore score_case(const OptimizationProblem& problem, std::size_t number, const ItemOutcome& outcome) {
    CaseScore out{.is_within = true, .excess = -1, .limit = "", .value = no_value};
    if (outcome.end == ItemEnd::diverged) return {false, not_converged_excess, "does not converge", no_value};
    const auto spikes = outcome.spikes.empty() ? std::span<const double>() : std::span<const double>(outcome.spikes[0]);
    if (outcome.end == ItemEnd::iteration_limit) {
        const auto* force = problem.sweep->nominal_force();
        const double done = spikes.empty() || !force ? 0 : spikes.back() / force->end();  // the earlier it stopped, the worse
        return {false, truncated_excess * (2 - done), "iteration limit", no_value};
    }
    add_measure_limits(problem, number, outcome, out);
    if (problem.has_pattern(number)) add_pattern_limits(problem, spikes, out);
    if (problem.goal.kind == DesignGoal::Kind::measure) out.value = outcome.measures[problem.goal.column];
    if (problem.goal.kind == DesignGoal::Kind::distance) out.value = problem.pattern->distance(spikes);
    return out;
}

DesignScore score_design(const OptimizationProblem& problem, std::span<const std::size_t> cases, std::span<const CaseScore> scores) {
    DesignScore out;
    std::vector<std::size_t> chips;
    const auto take_worse = [&](std::size_t k) {
        if (!out.limit.empty() && !(scores[k].excess > out.excess)) return;
        out.excess = scores[k].excess, out.worst_case = cases[k], out.limit = scores[k].limit;
    };
    for (std::size_t k = 0; k < cases.size(); ++k) {
        if (cases[k] < problem.condition_count)
            take_worse(k);
        else
            chips.push_back(k), out.chips_within += scores[k].is_within;
    }
    out.chips = chips.size();
    if (problem.goal.kind != DesignGoal::Kind::yield)
        if (const auto chip = decisive_chip(problem, chips, scores)) take_worse(*chip);
    out.goal = goal_of(problem, cases, scores, out);
    out.is_within = out.excess <= 0 && !std::isnan(out.goal);
    return out;
}

double merit(const OptimizationProblem& problem, const DesignScore& score, double reference) {
    constexpr double worst = 1e6;
    if (std::isnan(score.goal)) return worst + score.excess;
    const double relative = (problem.goal.is_maximized ? -1 : 1) * score.goal / reference;
    return score.is_within ? relative : relative + 0.5 + 2 * score.excess;
}

}  // namespace corpuscle::optimize
