#pragma once
// Recordings of a fingertip of taxels that slides over surfaces, and the forces as which its readings are taken.

#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

inline constexpr double slide_frame_rate = 35.64;  ///< Hz, of the recordings: rows over time
inline constexpr double slide_force_rate = 1e3;    ///< Hz, of the force on the afferents

/// Values of each taxel over time: as recorded, and on a smooth curve through them (cubic B-spline) at slide_force_rate.
struct TaxelValues {
    std::vector<std::vector<double>> frames;  ///< [taxel][frame]
    std::vector<std::vector<double>> smooth;  ///< [taxel][sample]
};

/// A recording. Surface, grip and speed are numbers from 0 that tell recordings apart.
struct Slide {
    std::string name;  ///< of its file, without ".csv"
    std::size_t surface = 0, grip = 0, speed = 0;
    TaxelValues counts = {};
};

/// Reads the counts of a slide from FOLDER/NAME.csv. `lowpass`: the -3 dB frequency (Hz) of a filter; nothing: no filter.
Result<void> read_slide(Slide&, const std::string& folder, std::optional<double> lowpass = {});

/// The part of the readings that the forces keep.
enum class SlidePart {
    all,           ///< force = newtons_per_count times reading
    change,        ///< without the mean of each taxel in each recording: all have the mean slide_level
    change_shape,  ///< without that mean and without the depth of the changes: all have the deviation slide_depth, too
};
inline constexpr double slide_level = 2, slide_depth = 1;  ///< N; with `change`, slide_depth is the mean over the recordings

/// The forces (N) on the taxels of several slides; negative ones are 0. `newtons_per_count` is for SlidePart::all only.
std::vector<TaxelValues> slide_forces(const std::vector<Slide>&, SlidePart, double newtons_per_count);

}  // namespace corpuscle
