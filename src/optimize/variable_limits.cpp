#include "optimize/variable_limits.hpp"

namespace corpuscle::optimize {
namespace {

constexpr double step_length = 0.02;  // of a variable's range

/// The value one step away; no value if the variable is at its bound.
std::optional<double> neighbour(const DesignVariable& v, double value, int direction) {
    if (value == (direction < 0 ? v.min : v.max)) return {};
    if (v.is_integer) return value + direction;
    return v.value(v.position(value) + direction * step_length);
}

/// The relative change of the goal over that of the variable, between the two steps.
double sensitivity_of(const VariableLimit& limit, double value, double goal) {
    const VariableStep here{value, goal, true, 0, 0, ""}, low = limit.down.value_or(here), high = limit.up.value_or(here);
    if (high.value == low.value || goal == 0 || value == 0) return no_value;
    return (high.goal - low.goal) / goal / ((high.value - low.value) / value);
}

}  // namespace

std::vector<DesignStep> steps_from(const OptimizationProblem& problem, const std::vector<double>& design) {
    std::vector<DesignStep> out;
    for (std::size_t k = 0; k < problem.variables.size(); ++k)
        for (const int direction : {-1, 1})
            if (const auto value = neighbour(problem.variables[k], design[k], direction)) {
                out.push_back({k, direction, design});
                out.back().design[k] = *value;
            }
    return out;
}

std::vector<VariableLimit> variable_limits(const OptimizationProblem& problem, const ScoredDesign& found, std::span<const DesignStep> steps,
                                           std::span<const ScoredDesign> scored) {
    std::vector<VariableLimit> out(problem.variables.size());
    for (std::size_t p = 0; p < steps.size(); ++p) {
        const auto& s = scored[p].score;
        const auto k = steps[p].variable;
        (steps[p].direction < 0 ? out[k].down : out[k].up) =
            VariableStep{steps[p].design[k], s.goal, s.is_within, s.excess, s.worst_case, s.limit};
    }
    for (std::size_t k = 0; k < out.size(); ++k) {
        const auto& v = problem.variables[k];
        const double x = found.values[k];
        out[k].is_at_min = x == v.min, out[k].is_at_max = x == v.max;
        out[k].sensitivity = sensitivity_of(out[k], x, found.score.goal);
    }
    return out;
}

}  // namespace corpuscle::optimize
