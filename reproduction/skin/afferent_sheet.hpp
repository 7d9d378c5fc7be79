#pragma once
// A sheet of afferents over the sensors of a recording: rows by columns, each afferent driven by the sensors near it. Also the centroid of
// the spikes of such a sheet.

#include <map>
#include <string>
#include <vector>

#include "core/force_source.hpp"

namespace corpuscle {

/// Positions of the afferents of a sheet. A row is parallel to the y axis; the next row is at a larger x. Afferents are numbered row by
/// row, from 0.
struct AfferentSheet {
    std::size_t rows = 30, columns = 30;
    double pitch = 4.5e-3;  ///< m, between neighbours in both directions
    Position corner = {};   ///< the smallest x and y of the sheet, m; afferent 0 is half a pitch from it in both directions

    Position position(std::size_t afferent_index) const {
        return {corner.x + (static_cast<double>(afferent_index / columns) + 0.5) * pitch,
                corner.y + (static_cast<double>(afferent_index % columns) + 0.5) * pitch};
    }
};

/// A spike of a sheet.
struct SheetSpike {
    double time = 0;                 ///< s since the first sample
    std::size_t afferent_index = 0;  ///< as in AfferentSheet::position
};

/// Force of every sensor at equal time steps.
struct SheetForce {
    double T = 0;                            ///< s, time step
    std::vector<Position> positions;         ///< of each sensor, m
    std::vector<std::vector<double>> force;  ///< N, [sensor][sample]; at least one sensor
    double time(std::size_t sample) const { return static_cast<double>(sample) * T; }
};

/// The spikes of a sheet of afferents of one type ("sa1"), in order of time. The force on an afferent is the sum of force times
/// exp(-d^2 / (2 sigma^2)) over the sensors within 4 sigma, where d is the distance between sensor and afferent; sigma in m.
Result<std::vector<SheetSpike>> simulate_sheet(const AfferentSheet&, const std::string& afferent, const SheetForce&, double sigma);

/// The weighted centroid in each time bin; NaN in a bin without weight.
struct CentroidTrack {
    std::vector<double> t, x, y, weight;  ///< centre of each bin, s; centroid, m; sum of the weights in the bin
};
/// The centroids of the positions of the afferents that fire, each spike with weight 1. `from`, `to` and the bin width `bin` in s.
CentroidTrack centroid_track(const AfferentSheet&, const std::vector<SheetSpike>&, double from, double to, double bin);
/// The centroids of the positions of the sensors, each sample weighted with its force.
CentroidTrack centroid_track(const SheetForce&, double from, double to, double bin);

/// Pearson's r of two lists of equal length, over the entries that are finite in both.
double correlation(const std::vector<double>&, const std::vector<double>&);

}  // namespace corpuscle
