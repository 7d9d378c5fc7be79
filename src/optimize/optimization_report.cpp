#include "optimize/optimization_report.hpp"

#include <fmt/format.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/text/aligned_table.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::optimize {
namespace {

using Json = nlohmann::ordered_json;

constexpr double min_gain = 1e-4;  // smallest relative improvement of the goal for which a limit is reported

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

std::string value_text(const DesignVariable& v, double x) { return v.is_integer ? fmt::format("{:g}", x) : format_quantity(x, v.unit); }

std::string goal_text(const DesignGoal& goal, double x) {
    if (std::isnan(x)) return "-";
    return goal.kind == DesignGoal::Kind::measure ? format_quantity(x, goal.unit) : fmt::format("{:.4g}", x);
}

std::string change_text(double before, double after) {
    if (before == 0 || std::isnan(before) || std::isnan(after)) return "-";
    const double percent = 100 * (after / before - 1);
    return fmt::format("{:+.1f} %", std::abs(percent) < 0.05 ? 0.0 : percent);
}

/// The relative change of the goal at a neighbouring design, negative if it improves.
double goal_change(const OptimizationProblem& problem, const OptimizationResult& result, const VariableStep& step) {
    const double change = (step.goal - result.found.score.goal) / std::abs(result.found.score.goal);
    return problem.goal.is_maximized ? -change : change;
}

TableRows design_table(const OptimizationProblem& problem, const OptimizationResult& r) {
    TableRows rows = {{"variable", "from", "before", "found", "to", "change", "goal % per %"}};
    for (std::size_t k = 0; k < problem.variables.size(); ++k) {
        const auto& v = problem.variables[k];
        const auto& limit = r.limits[k];
        rows.push_back({fmt::format("{}", fmt::join(v.names, "+")), value_text(v, v.min), value_text(v, v.start),
                        value_text(v, r.found.values[k]) + (limit.is_at_min || limit.is_at_max ? " (bound)" : ""), value_text(v, v.max),
                        change_text(v.start, r.found.values[k]),
                        std::isnan(limit.sensitivity) ? "-" : fmt::format("{:+.3f}", limit.sensitivity)});
    }
    return rows;
}

std::string within_text(const OptimizationProblem& problem, const ScoredDesign& d) {
    std::size_t conditions = 0;
    for (std::size_t c = 0; c < problem.condition_count; ++c) conditions += d.cases[c].is_within;
    return fmt::format("{} of {}", conditions, problem.condition_count);
}

TableRows score_table(const OptimizationProblem& problem, const OptimizationResult& r) {
    TableRows rows = {{"", "before", "found", "change"}};
    if (problem.goal.kind != DesignGoal::Kind::none)
        rows.push_back({problem.goal.name, goal_text(problem.goal, r.start.score.goal), goal_text(problem.goal, r.found.score.goal),
                        change_text(r.start.score.goal, r.found.score.goal)});
    rows.push_back({"conditions within the limits", within_text(problem, r.start), within_text(problem, r.found), ""});
    if (problem.chip_count() > 0)
        rows.push_back({"chips within the limits", fmt::format("{} of {}", r.start.score.chips_within, r.start.score.chips),
                        fmt::format("{} of {}", r.found.score.chips_within, r.found.score.chips), ""});
    return rows;
}

Json document_of(const OptimizationProblem& problem, const ScoredDesign& d) {
    std::size_t conditions = 0;
    for (std::size_t c = 0; c < problem.condition_count; ++c) conditions += d.cases[c].is_within;
    Json out = {{"goal", number(d.score.goal)}, {"is_within", d.score.is_within}, {"conditions_within", conditions}};
    if (problem.chip_count() > 0) out["chips_within"] = d.score.chips_within;
    out["worst_case"] = {{"case", problem.cases[d.score.worst_case].text}, {"limit", d.score.limit}, {"excess", number(d.score.excess)}};
    return out;
}

Json document_of(const OptimizationProblem& problem, const std::optional<VariableStep>& step) {
    if (!step) return nullptr;
    return {{"value", step->value},           {"goal", number(step->goal)}, {"is_within", step->is_within},
            {"excess", number(step->excess)}, {"limit", step->limit},       {"case", problem.cases[step->worst_case].text}};
}

}  // namespace

std::vector<std::string> limiting_reasons(const OptimizationProblem& problem, const OptimizationResult& r) {
    std::vector<std::string> out;
    for (std::size_t k = 0; k < problem.variables.size(); ++k) {
        const auto& v = problem.variables[k];
        const auto& limit = r.limits[k];
        // Positive: the goal becomes worse if the variable grows.
        const double signs = std::copysign(1.0, r.found.score.goal) * std::copysign(1.0, r.found.values[k]);
        const double sensitivity = limit.sensitivity * signs * (problem.goal.is_maximized ? -1 : 1);
        if (limit.is_at_min && sensitivity > min_gain)
            out.push_back(fmt::format("{} is at its lower bound, {}", v.name(), value_text(v, v.min)));
        if (limit.is_at_max && sensitivity < -min_gain)
            out.push_back(fmt::format("{} is at its upper bound, {}", v.name(), value_text(v, v.max)));
        for (const auto& step : {limit.down, limit.up}) {
            if (!step || step->is_within) continue;
            const double change = goal_change(problem, r, *step);
            if (!std::isnan(change) && change > -min_gain) continue;
            out.push_back(fmt::format("{} = {} would {} the goal{}, but fails at {}: {}", v.name(), value_text(v, step->value),
                                      std::isnan(change) ? "change" : "improve",
                                      std::isnan(change) ? "" : fmt::format(" by {:.2g} %", -100 * change),
                                      problem.cases[step->worst_case].text, step->limit));
        }
    }
    return out;
}

std::vector<std::string> design_lines(const OptimizationProblem& problem, const OptimizationResult& r) {
    std::vector<std::string> out;
    for (std::size_t k = 0; k < problem.variables.size(); ++k) {
        const auto& v = problem.variables[k];
        out.push_back(
            fmt::format("{}: {} (before: {})", fmt::join(v.names, ", "), value_text(v, r.found.values[k]), value_text(v, v.start)));
    }
    return out;
}

std::string format_result(const OptimizationProblem& problem, const OptimizationResult& r) {
    auto out = format_table(design_table(problem, r)) + "\n" + format_table(score_table(problem, r));
    if (!r.found.score.is_within)
        out += fmt::format("\nNo design within the limits was found; the best one fails at {}: {}\n",
                           problem.cases[r.found.score.worst_case].text, r.found.score.limit);
    if (const auto reasons = limiting_reasons(problem, r); !reasons.empty()) {
        out += "\nLimits:\n";
        for (const auto& reason : reasons) out += fmt::format("  {}\n", reason);
    }
    return out + fmt::format(
                     "\n{} designs in {} rounds, {} simulations{}{}\n", r.designs, r.rounds, r.simulated + r.reused,
                     r.reused > 0 ? fmt::format(" ({} of them from the results file)", r.reused) : "",
                     r.is_settled ? "" : "; the last round still found better designs or failing cases, so more [search] rounds may help");
}

nlohmann::ordered_json document_of(const OptimizationProblem& problem, const OptimizationResult& r) {
    Json out = {{"title", problem.title}, {"subject", problem.subject}, {"goal", problem.goal.name}, {"unit", problem.goal.unit}};
    auto& variables = out["variables"] = Json::array();
    for (std::size_t k = 0; k < problem.variables.size(); ++k) {
        const auto& v = problem.variables[k];
        const auto& limit = r.limits[k];
        variables.push_back({{"names", v.names},
                             {"unit", v.unit},
                             {"from", v.min},
                             {"to", v.max},
                             {"before", v.start},
                             {"found", r.found.values[k]},
                             {"at_lower_bound", limit.is_at_min},
                             {"at_upper_bound", limit.is_at_max},
                             {"sensitivity", number(limit.sensitivity)},
                             {"down", document_of(problem, limit.down)},
                             {"up", document_of(problem, limit.up)}});
    }
    out["conditions"] = problem.condition_count, out["chips"] = problem.chip_count();
    out["before"] = document_of(problem, r.start), out["found"] = document_of(problem, r.found);
    out["limits"] = limiting_reasons(problem, r);
    out["designs"] = r.designs, out["rounds"] = r.rounds, out["simulations"] = r.simulated + r.reused, out["settled"] = r.is_settled;
    return out;
}

}  // namespace corpuscle::optimize
