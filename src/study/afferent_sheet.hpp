#pragma once
// A sheet of afferents over the sensors of a recording: rows by columns, each afferent driven by the sensors near it. Also the centroid of
// the spikes of such a sheet.

#include <map>
#include <string>
#include <vector>

#include "signal/force_source.hpp"

namespace corpuscle {

/// Afferents in rows along y, row after row towards larger x; numbered from 0.
struct AfferentSheet {
    std::size_t rows = 30, columns = 30;
    double pitch = 4.5e-3;  ///< m
    Position corner = {};   ///< the smallest x and y of the sheet, m

    Position position(std::size_t afferent_index) const {
        return {corner.x + (static_cast<double>(afferent_index / columns) + 0.5) * pitch,
                corner.y + (static_cast<double>(afferent_index % columns) + 0.5) * pitch};
    }
};

/// A spike of a sheet.
struct SheetSpike {
    double time = 0;  ///< s
    std::size_t afferent_index = 0;
};

/// Force of every sensor at equal time steps, N.
struct SheetForce {
    double T = 0;  ///< s
    std::vector<Position> positions;
    std::vector<std::vector<double>> force;  ///< [sensor][sample]
    double time(std::size_t sample) const { return static_cast<double>(sample) * T; }
};

/// The response of a sheet of one afferent type ("sa1"). The force of each afferent is the sum over the sensors of their force times
/// exp(-d^2 / (2 sigma^2)), where d is the distance between sensor and afferent; sigma in m.
Result<std::vector<SheetSpike>> simulate_sheet(const AfferentSheet&, const std::string& afferent, const SheetForce&, double sigma);

/// The weighted centroid (m) in each time bin (s); NaN in an empty bin.
struct CentroidTrack {
    std::vector<double> t, x, y, weight;
};
CentroidTrack centroid_track(const AfferentSheet&, const std::vector<SheetSpike>&, double from, double to, double bin);
CentroidTrack centroid_track(const SheetForce&, double from, double to, double bin);

/// Pearson's r over the pairs in which both values are numbers.
double correlation(const std::vector<double>&, const std::vector<double>&);

}  // namespace corpuscle
