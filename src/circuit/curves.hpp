#pragma once
// Curves by the names that netlists give them: v(a,b), vdb(out), vp(out), i(v1), par('v(a)*i(v1)').

#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "circuit/netlist/formula.hpp"
#include "circuit/points.hpp"

namespace corpuscle::circuit {

/// Where each curve of a plot stands, for many look-ups. The plot must outlive it.
class CurveNames {
    std::unordered_map<std::string_view, int> at_;

public:
    explicit CurveNames(const Plot&);
    int index_of(std::string_view name) const;  ///< -1: none
};

/// What a name means in a plot, looked up once: a curve, v(a,b), or a view of a complex one: vm (magnitude), vdb, vp (phase, radians, as
/// ngspice has it), vr, vi, and the same of currents: im, idb, ip ... Of a real plot also par('FORMULA') of voltages, currents and time.
class CurveView {
    static constexpr int ground = -1;
    int plus_ = ground, minus_ = ground;  // in the plot's curves
    std::string_view view_{};             // "", or what seen_as() knows
    bool plain_ = true;                   // v(a), i(x), v(a,b)
    std::shared_ptr<const Formula> formula_{};
    std::vector<CurveView> inputs_{};  // of the formula

    std::complex<double> seen(std::complex<double> difference) const;
    double worked_out(const PlotRow&) const;
    static std::optional<CurveView> par(const Plot&, std::string_view name);

public:
    /// Nothing: the plot has no such curve.
    static std::optional<CurveView> of(const Plot&, std::string_view name, const CurveNames* = nullptr);

    std::complex<double> in(const PlotRow& row) const {
        if (formula_) return worked_out(row);
        return seen((plus_ < 0 ? 0 : row[static_cast<std::size_t>(plus_)]) - (minus_ < 0 ? 0 : row[static_cast<std::size_t>(minus_)]));
    }
    /// As it is measured: of a complex curve its magnitude, as ngspice does, unless a view is named.
    double measured(const PlotRow& row) const {
        const auto x = in(row);
        return row.is_complex && plain_ ? std::abs(x) : x.real();
    }
    std::vector<std::complex<double>> along(const Plot&) const;
};

/// The formula in "par('...')"; the error is at `place`.
Result<Formula> par_formula(std::string_view name, const Place& place);

/// The values along a plot of what is named.
std::optional<std::vector<std::complex<double>>> values_of(const Plot&, std::string_view name);

}  // namespace corpuscle::circuit
