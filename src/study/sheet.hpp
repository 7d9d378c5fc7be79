#pragma once
// A sheet of afferents over the sensors of a recording: rows by columns, each afferent feeling the sensors near it. And where on a sheet
// spikes are, whoever fired them.

#include <map>
#include <string>
#include <vector>

#include "signal/source.hpp"

namespace corpuscle {

/// Units in rows along y, row after row to larger x; from 0.
struct Sheet {
    std::size_t rows = 30, columns = 30;
    double pitch = 4.5e-3;  ///< m
    Position corner = {};   ///< the sheet's least x and y, m

    Position at(std::size_t unit) const {
        return {corner.x + (static_cast<double>(unit / columns) + 0.5) * pitch,
                corner.y + (static_cast<double>(unit % columns) + 0.5) * pitch};
    }
};

/// A spike of a sheet.
struct SheetSpike {
    double time = 0;  ///< s
    std::size_t unit = 0;
};

/// Force of every sensor at even instants, N.
struct SheetForce {
    double T = 0;  ///< s
    std::vector<Position> at;
    std::vector<std::vector<double>> force;  ///< [sensor][sample]
    double time(std::size_t sample) const { return static_cast<double>(sample) * T; }
};

/// What a sheet of one afferent ("sa1") answers. Each unit feels the sum over the sensors of their force, each times exp(-d^2 / 2 sigma^2).
Result<std::vector<SheetSpike>> sheet_answer(const Sheet&, const std::string& afferent, const SheetForce&, double sigma);

/// The mean place of what is told in each stretch of time, weighted; NaN where nothing is.
struct Track {
    std::vector<double> t, x, y, weight;
};
Track track_of(const Sheet&, const std::vector<SheetSpike>&, double from, double to, double bin);
Track track_of(const SheetForce&, double from, double to, double bin);

/// Pearson's r over the pairs in which both are numbers.
double correlation(const std::vector<double>&, const std::vector<double>&);

}  // namespace corpuscle
