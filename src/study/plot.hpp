#pragma once
// A plot of a study: lines, points, paths or spike rasters over a common axis.

#include <string>
#include <vector>

#include "study/line.hpp"

namespace corpuscle {

struct Plot {
    enum class Style { line, points, raster, path };  ///< path: a line through the points in their order; NaN interrupts the line
    struct Series {
        std::string name;
        std::vector<double> x, y;
        Style style = Style::line;
    };
    std::string title, x_label, y_label;
    std::vector<Series> series;
    bool log_x = false, log_y = false;
    std::string printed = {};  ///< describes the shape of the published plot

    Plot& add(std::string name, Line line, Style style = Style::line) {
        series.push_back({std::move(name), std::move(line.x), std::move(line.y), style});
        return *this;
    }
    Plot& points(std::string name, Line line) { return add(std::move(name), std::move(line), Style::points); }
    /// A raster row with spikes at these times.
    Plot& row(std::string name, std::vector<double> times) {
        series.push_back({std::move(name), std::move(times), {}, Style::raster});
        return *this;
    }
    Plot& shape(std::string text) { return printed = std::move(text), *this; }
};

}  // namespace corpuscle
