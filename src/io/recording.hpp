#pragma once
// A recording as a source of force: its columns, units and clock.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/repair.hpp"
#include "io/table.hpp"
#include "signal/force_source.hpp"

namespace corpuscle {

/// The treatment of non-numeric fields and of samples outside the range.
enum class BadFields { error, drop, interpolate };

struct RecordingOptions {
    TableOptions table = {};
    std::vector<std::string> channels = {};               ///< names, numbers or ranges ("fbg11", "3", "2-5"); empty: all except the time
    std::optional<std::string> time = {};                 ///< name or number of the time column, or "none"; default: as in the file
    std::optional<std::string> time_unit = {};            ///< default: the unit in the header, or seconds
    std::optional<double> rate = {};                      ///< Hz; takes the samples as evenly spaced and ignores the times
    std::optional<double> resample = {};                  ///< Hz; interpolates linearly to this rate
    std::optional<std::string> unit = {};                 ///< "N", "mN", "gf", "kgf" or "raw"; default: the unit in the header
    std::optional<double> scale = {};                     ///< newtons per unit of the values in the file
    bool absolute = false;                                ///< takes the absolute value of the values in the file
    double offset = 0;                                    ///< the value in the file at zero force
    std::optional<std::pair<double, double>> range = {};  ///< valid values in the file; others are bad
    std::optional<BadFields> bad_fields = {};             ///< default: a non-numeric field is an error, other bad values are interpolated
    std::optional<DespikeOptions> despike = {};
    std::vector<double> notch = {};      ///< Hz
    std::optional<double> lowpass = {};  ///< Hz
    std::string layout = {};             ///< path of a file with the names and positions of the sensors; "": none
    /// Called for each block of the first pass through the file, with the fraction done. If it returns false, the pass stops.
    std::function<bool(double)> should_continue = [](double) { return true; };
};

/// Opens a recording in one of the formats of recording_formats.hpp. A unit that is not a force requires a scale. An uneven clock
/// requires `rate` or `resample`. A file with a time column is read twice, first to determine its clock.
Result<std::unique_ptr<ForceSource>> open_recording(const std::string& path, const RecordingOptions&);

}  // namespace corpuscle
