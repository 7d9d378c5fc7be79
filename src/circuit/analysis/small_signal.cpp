// .tf and .sens: transfer function and sensitivities at 0 Hz.

#include <algorithm>
#include <cmath>

#include "circuit/analysis/analysis_context.hpp"
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
        return error_at(c.location, ".{}: the matrix is singular at the operating point", c.name);
    return linear;
}

/// Adds a value to x[unknown]; does nothing for ground (-1).
void add(std::vector<double>& x, int unknown, double value) {
    if (unknown >= 0) x[static_cast<std::size_t>(unknown)] += value;
}

Result<AnalysisResult> analyse_tf(AnalysisContext& context, const Directive& c) {
    const auto out = TRY(read_output_variable(context.system, c, 0));
    if (c.words.size() != 2) return error_at(c.location, ".tf: {} words; expected .tf OUTPUT SOURCE", c.words.size());
    const auto* source = TRY(read_independent_source(context.system, c, 1));
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
    StampBuffer stamp;
    for (const auto& d : context.system.devices()) {
        const auto value = d->principal_value();
        if (!value) continue;
        const auto v = context.system.terminal_values(*d, linear.x);
        const auto currents = [&](double p) {
            d->set_principal_value(p);
            const auto f = stamp.eval(*d, v, eval_context).f;
            return std::vector<double>(f.begin(), f.end());
        };
        const double h = std::max(std::abs(*value), *value == 0 ? 1.0 : 0.0) * 1e-5;
        const auto up = currents(*value + h), down = currents(*value - h);
        d->set_principal_value(*value);
        double slope = 0;
        for (std::size_t k = 0; k < v.size(); ++k)
            if (d->unknowns[k] >= 0) slope -= lambda[static_cast<std::size_t>(d->unknowns[k])] * (up[k] - down[k]) / (2 * h);
        result.numbers.emplace_back(d->name, slope);
        plot.curves.push_back({d->name, "notype", {slope}});
    }
    result.plots.push_back(std::move(plot));
    return result;
}

Plot expected_tf_plot(const System&, const Directive& c) {
    Plot plot{"Transfer Function", false, false, {{"transfer_function", "notype", {}}}};
    if (c.words.size() == 2)
        for (const auto& name : {c.words[1] + "#input_impedance", "output_impedance_at_" + c.words[0]})
            plot.curves.push_back({name, "notype", {}});
    return plot;
}

Plot expected_sens_plot(const System& system, const Directive&) {
    Plot plot{"Sensitivity Analysis", false, false, {}};
    for (const auto& d : system.devices())
        if (d->principal_value()) plot.curves.push_back({d->name, "notype", {}});
    return plot;
}

}  // namespace

extern constexpr Analysis tf_analysis = {.name = "tf",
                                         .usage = ".tf v(OUT[,REF])|i(V) SOURCE",
                                         .description = "gain, input and output resistance at 0 Hz",
                                         .run = analyse_tf,
                                         .expected_plot = expected_tf_plot,
                                         .has_number_for_each_curve = true,
                                         .ngspice_order = 7};

extern constexpr Analysis sens_analysis = {.name = "sens",
                                           .usage = ".sens v(OUT[,REF])|i(V)",
                                           .description = "sensitivity of the output to each element's value",
                                           .run = analyse_sens,
                                           .expected_plot = expected_sens_plot,
                                           .has_number_for_each_curve = true,
                                           .ngspice_order = 6};

}  // namespace corpuscle::circuit
