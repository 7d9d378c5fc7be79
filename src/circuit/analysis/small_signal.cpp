// .tf and .sens: transfer function and sensitivities at 0 Hz.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/analyses.hpp"
#include "core/parameter.hpp"

namespace corpuscle::circuit {
namespace {

/// A circuit linearized at its operating point x. The solver has factored its conductances.
struct LinearCircuit {
    std::vector<double> x;
    SystemEvaluation evaluation;
    LinearSolver<double> solver;
};

/// `c` is the directive that messages name.
Result<LinearCircuit> linearize(AnalysisContext& context, const Directive& c) {
    const auto operating_point = TRY(context.operating_point());
    LinearCircuit linear{operating_point.x, evaluate_operating_point(context, operating_point.x),
                         LinearSolver<double>(context.system.pattern())};
    if (!linear.solver.factor(std::span<const double>(linear.evaluation.G).first(context.system.pattern().entries())))
        return bad_input(fmt::format(".{}: the matrix is singular at the operating point", c.name), c.location);
    return linear;
}

/// Adds a value to x[unknown]; does nothing for ground (-1).
void add(std::vector<double>& x, int unknown, double value) {
    if (unknown >= 0) x[static_cast<std::size_t>(unknown)] += value;
}

}  // namespace

Result<AnalysisResult> analyse_tf(AnalysisContext& context, const Directive& c) {
    const auto out = TRY(read_output_variable(context.system, c, 0));
    if (c.words.size() != 2) return bad_input(fmt::format(".tf: {} words; expected .tf OUTPUT SOURCE", c.words.size()), c.location);
    const auto* source = context.system.device(c.words[1]);
    if (source == nullptr || !(source->name[0] == 'v' || source->name[0] == 'i'))
        return bad_input(fmt::format(".tf: '{}' is not an independent source", c.words[1]), c.location);
    auto linear = TRY(linearize(context, c));
    constexpr double infinite = 1e20;  // ohm: printed for an infinite resistance
    const bool is_voltage_source = source->unknowns.size() == 3;
    std::vector<double> response(linear.x.size());  // of the unknowns to a change of the source by 1 V or 1 A
    if (is_voltage_source)
        add(response, source->unknowns[2], 1);
    else
        add(response, source->unknowns[0], -1), add(response, source->unknowns[1], 1);
    linear.solver.solve(response);
    AnalysisResult result;
    const auto across = [&](const std::vector<double>& x) {
        return OutputVariable{source->unknowns[0], source->unknowns[1]}.value(std::span<const double>(x));
    };
    const double input_resistance = is_voltage_source ? (response[static_cast<std::size_t>(source->unknowns[2])] == 0
                                                             ? infinite
                                                             : -1 / response[static_cast<std::size_t>(source->unknowns[2])])
                                                      : -across(response);
    std::vector<double> output_response(linear.x.size());  // to 1 A into an output voltage, or to -1 V of the source of an output current
    const bool is_voltage_output = context.system.is_voltage(out.plus);
    double output_resistance = infinite;
    if (is_voltage_output) {
        add(output_response, out.plus, 1), add(output_response, out.minus, -1);
        linear.solver.solve(output_response);
        output_resistance = out.value(std::span<const double>(output_response));
    } else {
        add(output_response, out.plus, -1);
        linear.solver.solve(output_response);
        const double g = output_response[static_cast<std::size_t>(out.plus)];
        output_resistance = g == 0 ? infinite : std::abs(1 / g);
    }
    result.numbers = {{"transfer_function", out.value(std::span<const double>(response))},
                      {source->name + "#input_impedance", std::abs(input_resistance)},
                      {"output_impedance_at_" + c.words[0], std::abs(output_resistance)}};
    Plot plot{"Transfer Function", false, false, {}};
    for (const auto& [name, value] : result.numbers) plot.curves.push_back({name, "notype", {value}});
    result.plots.push_back(std::move(plot));
    return result;
}

/// The derivative of the output with respect to the principal value p of each device is -lambda . df/dp, where G^T lambda is 1 at `plus`
/// and -1 at `minus` of the output. df/dp is a difference quotient.
Result<AnalysisResult> analyse_sens(AnalysisContext& context, const Directive& c) {
    const auto out = TRY(read_output_variable(context.system, c, 0));
    auto linear = TRY(linearize(context, c));
    std::vector<double> lambda(linear.x.size());
    add(lambda, out.plus, 1), add(lambda, out.minus, -1);
    linear.solver.solve_transposed(lambda);
    AnalysisResult result;
    Plot plot{"Sensitivity Analysis", false, false, {}};
    EvalContext eval_context;
    eval_context.gmin = context.tolerances.gmin;
    for (const auto& d : context.system.devices()) {
        const auto value = d->principal_value();
        if (!value) continue;
        const auto v = context.system.terminal_values(*d, linear.x);
        const auto n = v.size();
        const auto currents = [&](double p) {
            std::vector<double> stamp(2 * n + 2 * n * n);
            const std::span<double> all(stamp);
            d->set_principal_value(p);
            d->eval(v, eval_context, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
            stamp.resize(n);
            return stamp;
        };
        const double h = std::max(std::abs(*value), *value == 0 ? 1.0 : 0.0) * 1e-5;
        const auto up = currents(*value + h), down = currents(*value - h);
        d->set_principal_value(*value);
        double slope = 0;
        for (std::size_t k = 0; k < n; ++k)
            if (d->unknowns[k] >= 0) slope -= lambda[static_cast<std::size_t>(d->unknowns[k])] * (up[k] - down[k]) / (2 * h);
        result.numbers.emplace_back(d->name, slope);
        plot.curves.push_back({d->name, "notype", {slope}});
    }
    result.plots.push_back(std::move(plot));
    return result;
}

}  // namespace corpuscle::circuit
