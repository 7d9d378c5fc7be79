#pragma once
// Finds curves of a plot by the names that netlists use: v(a,b), vdb(out), vp(out), i(v1), par('v(a)*i(v1)').

#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "circuit/netlist/expression.hpp"
#include "circuit/point_sink.hpp"

namespace corpuscle::circuit {

/// Index of each curve of a plot by name, for many look-ups. The plot must outlive it.
class CurveIndex {
    std::unordered_map<std::string_view, int> indices_;

public:
    explicit CurveIndex(const Plot&);
    int index_of(std::string_view name) const;  ///< -1 if there is none
};

/// A name looked up once in a plot: a curve, v(a,b), or a view of a complex curve. The views are vm (magnitude), vdb, vp (phase in
/// radians, as in ngspice), vr, vi, and the same of currents: im, idb, ip ... A real plot also has par('EXPRESSION') of voltages,
/// currents and time.
class CurveView {
    static constexpr int ground = -1;
    int plus_ = ground, minus_ = ground;  // indices in the plot's curves
    std::string_view view_{};             // "" or one of view_names
    bool has_no_view_ = true;             // v(a), i(x), v(a,b)
    std::shared_ptr<const Expression> expression_{};
    std::vector<CurveView> inputs_{};  // the curves that the expression uses

    std::complex<double> apply_view(std::complex<double> difference) const;
    double evaluate_expression(const PlotRow&) const;
    static std::optional<CurveView> find_expression(const Plot&, std::string_view name);

public:
    /// Returns nothing if the plot has no such curve.
    static std::optional<CurveView> find(const Plot&, std::string_view name, const CurveIndex* = nullptr);

    std::complex<double> value(const PlotRow& row) const {
        if (expression_) return evaluate_expression(row);
        return apply_view((plus_ < 0 ? 0 : row[static_cast<std::size_t>(plus_)]) -
                          (minus_ < 0 ? 0 : row[static_cast<std::size_t>(minus_)]));
    }
    /// The value for .meas. For a complex curve without a view this is the magnitude, as in ngspice.
    double measured_value(const PlotRow& row) const {
        const auto x = value(row);
        return row.is_complex && has_no_view_ ? std::abs(x) : x.real();
    }
    std::vector<std::complex<double>> all_values(const Plot&) const;
};

/// Parses the expression in "par('...')"; an error is reported at `location`.
Result<Expression> parse_par_expression(std::string_view name, const SourceLocation& location);

/// All values of the named curve or view in a plot; nothing if there is no such curve.
std::optional<std::vector<std::complex<double>>> find_curve_values(const Plot&, std::string_view name);

}  // namespace corpuscle::circuit
