#pragma once
// Passes on the points of a plot one after another, for plots that are too long to be kept in memory.

#include <span>

#include "circuit/output/analysis_plot.hpp"
#include "core/error.hpp"

namespace corpuscle::circuit {

/// Receives one plot point by point. An error that it returns stops the analysis.
class PointSink {
public:
    virtual ~PointSink() = default;
    virtual Result<void> begin(const Plot& head) = 0;                 ///< names and types of the curves, no values yet
    virtual Result<void> add_point(std::span<const double> row) = 0;  ///< a value for each curve, in their order
    virtual Result<void> end() = 0;                                   ///< also called if the analysis was interrupted
};

/// Stores all points in a plot.
class PlotRecorder final : public PointSink {
public:
    Plot plot;
    Result<void> begin(const Plot& head) override { return plot = head, Result<void>(); }
    Result<void> add_point(std::span<const double> row) override {
        for (std::size_t k = 0; k < row.size(); ++k) plot.curves[k].values.emplace_back(row[k]);
        return {};
    }
    Result<void> end() override { return {}; }
};

/// One point of a plot. The values are in `real` or in `complex`; the other is empty.
struct PlotRow {
    std::span<const double> real{};
    std::span<const std::complex<double>> complex{};
    bool is_complex = false;  ///< true if the plot is complex; the points of a stored real plot are in `complex`, too

    PlotRow(std::span<const double> values) : real(values) {}
    PlotRow(std::span<const std::complex<double>> values, bool are_complex) : complex(values), is_complex(are_complex) {}
    std::size_t size() const { return complex.empty() ? real.size() : complex.size(); }
    std::complex<double> operator[](std::size_t k) const { return complex.empty() ? real[k] : complex[k]; }
};

}  // namespace corpuscle::circuit
