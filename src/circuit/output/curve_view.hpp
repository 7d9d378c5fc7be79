#pragma once
// Finds curves of a plot by the names that netlists use: v(a,b), vdb(out), vp(out), i(v1), par('v(a)*i(v1)').

#include "circuit/device/device.hpp"
#include "circuit/output/point_sink.hpp"

namespace corpuscle::circuit {

/// Finds the index of a curve in a plot by its name, fast enough for many look-ups. The plot must outlive it.
class CurveIndex {
    std::unordered_map<std::string_view, int> indices_;

public:
    explicit CurveIndex(const Plot&);
    int index_of(std::string_view name) const;  ///< -1 if no curve has this name
};

/// A quantity that was looked up once in a plot by its name. It is a curve, a difference v(a,b), or one part of a complex curve. The parts
/// are vm (magnitude), vdb (magnitude in dB), vp (phase in radians, as in ngspice), vr (real part) and vi (imaginary part), and im, idb,
/// ip, ir, ii of currents. It may also be an expression of these and of time: par('EXPRESSION'), {EXPRESSION}, 'EXPRESSION' or, if it has
/// an operator, EXPRESSION alone. In a complex plot each input must be a part, such as vm(a) or db(v(a)/v(b)), unless the expression has
/// only
/// + - * /. Other spellings: v1#branch for i(v1), NODE for v(NODE), x1:a for x1.a, freq for frequency, and onoise or v(onoise) for
/// onoise_spectrum.
class CurveView {
    static constexpr int ground = -1;
    int plus_ = ground, minus_ = ground;              // the value is curve plus_ minus curve minus_; indices of the plot's curves
    std::string_view part_{};                         // "m", "db", "p", "r" or "i"; "" is the complex value itself
    bool is_complex_value_ = true;                    // the name has no part: v(a), i(x), v(a,b)
    std::shared_ptr<const Expression> expression_{};  // of par('...'), otherwise null
    std::vector<CurveView> inputs_{};                 // the curves for the inputs of the expression, in their order
    bool is_complex_expression_ = false;              // it is evaluated with complex numbers

    std::complex<double> part_of_value(std::complex<double> difference) const;
    std::complex<double> evaluate_expression(const PlotRow&) const;
    static std::optional<CurveView> find_named(const Plot&, std::string_view name, const CurveIndex* index);

public:
    /// Returns nothing if the plot has no such curve. `index` is the plot's CurveIndex; if it is null, all curves are searched.
    static std::optional<CurveView> find(const Plot&, std::string_view name, const CurveIndex* index = nullptr);
    /// The value of an expression, which must have been parsed with curve_scope(). Nothing if the plot does not have all of its inputs.
    static std::optional<CurveView> of_expression(const Plot&, Expression, const CurveIndex* index = nullptr);

    std::complex<double> value(const PlotRow& row) const {
        if (expression_) return part_of_value(evaluate_expression(row));
        return part_of_value(value_of(row, plus_) - value_of(row, minus_));
    }
    /// The value for .meas. It is the magnitude if the name does not select a part of a complex curve, as in ngspice.
    double measured_value(const PlotRow& row) const {
        const auto x = value(row);
        return row.is_complex() && is_complex_value_ ? std::abs(x) : x.real();
    }
};

/// The text of an expression of curves without par(), braces or quotes around it. Nothing if `name` is a plain name, such as v(a).
std::optional<std::string_view> curve_expression_text(std::string_view name);
/// A scope with the functions that are the inputs of such an expression.
ExpressionScope curve_scope();
/// The name of the curve that is an input of an expression: "vdb(a,b)".
std::string curve_name(const ExpressionInput&);

/// The values of the named curve (as in CurveView) at all points of a plot; nothing if the plot has no such curve.
std::optional<std::vector<std::complex<double>>> find_curve_values(const Plot&, std::string_view name);

/// Passes the swept quantity and the named curves of a plot to a sink. If `names` is empty, or the plot has none of them (noise, transfer
/// function), all curves.
class CurveSelector final : public PointSink {
    const std::vector<std::string>& names_;
    PointSink& sink_;
    std::vector<CurveView> views_;  // empty: all curves
    bool has_sweep_ = true;
    std::vector<double> row_;
    std::vector<std::complex<double>> complex_row_;

public:
    CurveSelector(const std::vector<std::string>& names, PointSink& sink) : names_(names), sink_(sink) {}
    Result<void> begin(const Plot& head) override;
    Result<void> add_point(const PlotRow&) override;
    Result<void> end() override { return sink_.end(); }
};

/// The plot with only the named curves.
Plot select_curves(const Plot&, const std::vector<std::string>& names);

}  // namespace corpuscle::circuit
