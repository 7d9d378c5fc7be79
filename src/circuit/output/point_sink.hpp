#pragma once
// The result of an analysis: named columns of numbers, as in the result files of SPICE simulators. Points are passed on one after
// another, since a plot may be too long to be kept in memory.

#include <complex>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle::circuit {

/// A named column of values; the imaginary part of a real value is 0.
struct Curve {
    std::string name;  ///< "v(out)", "i(v1)", "frequency"
    std::string type;  ///< as in ngspice: "voltage", "current", "frequency", "notype" ...
    std::vector<std::complex<double>> values;
};

/// One plot. If `has_sweep` is true, the first curve is the swept quantity, and curves[k + has_sweep] is the k-th other curve.
struct Plot {
    std::string name;  ///< "DC transfer characteristic"
    bool is_complex = false, has_sweep = true;
    std::vector<Curve> curves;
    /// Number of points of each inner sweep of a .dc with two sources. Between two inner sweeps the curves are not continuous. 0: one
    /// sweep.
    std::size_t inner_points = 0;

    std::size_t point_count() const { return curves.empty() ? 0 : curves[0].values.size(); }
    /// The curve of this name; null if there is none.
    const Curve* find_curve(std::string_view curve_name) const {
        for (const auto& c : curves)
            if (c.name == curve_name) return &c;
        return nullptr;
    }
};

/// One point of a plot. The values are in `complex` if the plot is complex, otherwise in `real`; the other is empty.
struct PlotRow {
    std::span<const double> real{};
    std::span<const std::complex<double>> complex{};

    PlotRow(std::span<const double> values) : real(values) {}
    PlotRow(std::span<const std::complex<double>> values) : complex(values) {}
    bool is_complex() const { return !complex.empty(); }
    std::size_t size() const { return is_complex() ? complex.size() : real.size(); }
    std::complex<double> operator[](std::size_t k) const { return is_complex() ? complex[k] : real[k]; }
};

/// Receives one plot point by point. An error that it returns stops the analysis.
class PointSink {
public:
    virtual ~PointSink() = default;
    virtual Result<void> begin(const Plot& head) = 0;        ///< names and types of the curves, no values yet
    virtual Result<void> add_point(const PlotRow& row) = 0;  ///< a value for each curve, in their order
    virtual Result<void> end() { return {}; }                ///< also called if the analysis was interrupted
};

/// Stores all points in a plot.
class PlotRecorder final : public PointSink {
public:
    Plot plot;
    Result<void> begin(const Plot& head) override { return plot = head, Result<void>(); }
    Result<void> add_point(const PlotRow& row) override {
        for (std::size_t k = 0; k < row.size(); ++k) plot.curves[k].values.push_back(row[k]);
        return {};
    }
};

/// The points of a stored plot, which must outlive it.
class PlotPoints {
    const Plot& plot_;
    std::vector<double> real_;
    std::vector<std::complex<double>> complex_;

public:
    explicit PlotPoints(const Plot& plot) : plot_(plot) {}
    /// Valid until the next call.
    PlotRow operator[](std::size_t point) {
        real_.clear(), complex_.clear();
        for (const auto& c : plot_.curves) plot_.is_complex ? complex_.push_back(c.values[point]) : real_.push_back(c.values[point].real());
        return plot_.is_complex ? PlotRow(complex_) : PlotRow(real_);
    }
    /// Passes them to a sink. Calls prepare(k), if it is not empty, before point k.
    Result<void> send_to(PointSink&, const std::function<void(std::size_t)>& prepare = {});
};

}  // namespace corpuscle::circuit
