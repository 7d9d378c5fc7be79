#pragma once
// A plot of a study: lines, points, paths or spike rasters over a common axis.

#include <string>
#include <vector>

#include "reproduction/claims/study_curve.hpp"

namespace corpuscle {

struct StudyPlot {
    enum class Style { line, points, raster, path };  ///< path: a line through the points in their order; NaN interrupts the line
    struct Series {
        std::string name;
        std::vector<double> x, y;  ///< raster: x has the spike times of one row, and y is empty
        Style style = Style::line;
    };
    std::string title, x_label, y_label;
    std::vector<Series> series;
    bool log_x = false, log_y = false;
    std::string published_shape = {};  ///< the shape of the published plot in words; "" if there is none

    /// Adds a curve as a series.
    StudyPlot& add(std::string name, StudyCurve line, Style style = Style::line) {
        series.push_back({std::move(name), std::move(line.x), std::move(line.y), style});
        return *this;
    }
    StudyPlot& points(std::string name, StudyCurve line) { return add(std::move(name), std::move(line), Style::points); }
    /// Adds a raster row with spikes at these times.
    StudyPlot& raster_row(std::string name, std::vector<double> times) {
        series.push_back({std::move(name), std::move(times), {}, Style::raster});
        return *this;
    }
    StudyPlot& describe_published(std::string text) { return published_shape = std::move(text), *this; }
};

}  // namespace corpuscle
