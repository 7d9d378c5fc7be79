// .tf and .sens: transfer function and sensitivities at 0 Hz.

#include <algorithm>
#include <cmath>

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {
namespace {

/// The conductances of a circuit at its operating point x, factored.
struct LinearCircuit {
    std::vector<double> x;
    LinearSolver<double> solver;

    /// The changes of the unknowns when 1 A flows into `plus` and out of `minus` (-1: ground), or an equation of a branch changes by 1 V.
    std::vector<double> response(int plus, int minus) const {
        auto out = difference(plus, minus);
        solver.solve(out);
        return out;
    }
    /// 1 at `plus` and -1 at `minus`.
    std::vector<double> difference(int plus, int minus) const {
        std::vector<double> out(x.size());
        if (plus >= 0) out[static_cast<std::size_t>(plus)] += 1;
        if (minus >= 0) out[static_cast<std::size_t>(minus)] -= 1;
        return out;
    }
};

/// `c` is the directive that messages name.
Result<LinearCircuit> linearize(AnalysisContext& context, const Directive& c) {
    const auto operating_point = TRY(context.operating_point());
    LinearCircuit linear{operating_point.x, LinearSolver<double>(context.system.pattern())};
    const auto evaluation = evaluate_operating_point(context, operating_point.x);
    if (!linear.solver.factor(std::span<const double>(evaluation.G).first(context.system.pattern().entries())))
        return error_at(c.location, ".{}: the matrix is singular at the operating point", c.name);
    return linear;
}

/// The values of the curves of a plot, which are the numbers of the analysis, too.
AnalysisResult result_of(Plot plot, const std::vector<double>& values) {
    AnalysisResult out;
    for (std::size_t k = 0; k < values.size(); ++k) {
        plot.curves[k].values = {values[k]};
        out.numbers.emplace_back(plot.curves[k].name, values[k]);
    }
    out.plots.push_back(std::move(plot));
    return out;
}

Plot expected_tf_plot(const System&, const Directive& c) {
    Plot plot{"Transfer Function", false, false, {{"transfer_function", "notype", {}}}};
    if (c.words.size() == 2)
        for (const auto& name : {c.words[1] + "#input_impedance", "output_impedance_at_" + c.words[0]})
            plot.curves.push_back({name, "notype", {}});
    return plot;
}

Result<AnalysisResult> analyse_tf(AnalysisContext& context, const Directive& c) {
    const auto out = TRY(read_output_variable(context.system, c, 0));
    if (c.words.size() != 2) return error_at(c.location, ".tf: {} words; expected .tf OUTPUT SOURCE", c.words.size());
    const auto* source = TRY(read_independent_source(context.system, c, 1));
    const auto linear = TRY(linearize(context, c));
    const auto resistance = [](double g) { return g == 0 ? 1e20 : std::abs(1 / g); };  // 1e20 is printed for an infinite resistance
    const auto& u = source->unknowns;
    const bool is_voltage_source = u.size() == 3;
    const auto response = is_voltage_source ? linear.response(u[2], -1) : linear.response(u[1], u[0]);  // to 1 V or 1 A of the source
    const double input_resistance =
        is_voltage_source ? resistance(value_of(response, u[2])) : std::abs(OutputVariable{u[0], u[1]}.value(response));
    const auto at_output = linear.response(out.plus, out.minus);
    const double output_resistance =
        context.system.is_voltage(out.plus) ? std::abs(out.value(at_output)) : resistance(value_of(at_output, out.plus));
    return result_of(expected_tf_plot(context.system, c), {out.value(response), input_resistance, output_resistance});
}

Plot expected_sens_plot(const System& system, const Directive&) {
    Plot plot{"Sensitivity Analysis", false, false, {}};
    for (const auto& d : system.devices())
        if (d->principal_value()) plot.curves.push_back({d->name, "notype", {}});
    return plot;
}

/// The derivative of the output with respect to the principal value p of each device is -lambda . df/dp, where G^T lambda is 1 at `plus`
/// and -1 at `minus` of the output. df/dp is a difference quotient.
Result<AnalysisResult> analyse_sens(AnalysisContext& context, const Directive& c) {
    const auto out = TRY(read_output_variable(context.system, c, 0));
    const auto linear = TRY(linearize(context, c));
    auto lambda = linear.difference(out.plus, out.minus);
    linear.solver.solve_transposed(lambda);
    EvalContext eval_context;
    eval_context.gmin = context.tolerances.gmin;
    StampBuffer stamp;
    std::vector<double> slopes;
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
        double& slope = slopes.emplace_back(0);
        for (std::size_t k = 0; k < v.size(); ++k) slope -= value_of(lambda, d->unknowns[k]) * (up[k] - down[k]) / (2 * h);
    }
    return result_of(expected_sens_plot(context.system, c), slopes);
}

}  // namespace

extern constexpr Analysis tf_analysis = {.name = "tf",
                                         .usage = ".tf v(OUT[,REF])|i(V) SOURCE",
                                         .description = "gain, input and output resistance at 0 Hz",
                                         .run = analyse_tf,
                                         .expected_plot = expected_tf_plot,
                                         .has_number_for_each_curve = true,
                                         .ngspice_order = 8};

extern constexpr Analysis sens_analysis = {.name = "sens",
                                           .usage = ".sens v(OUT[,REF])|i(V)",
                                           .description = "sensitivity of the output to each element's value",
                                           .run = analyse_sens,
                                           .expected_plot = expected_sens_plot,
                                           .has_number_for_each_curve = true,
                                           .ngspice_order = 7};

}  // namespace corpuscle::circuit
