#pragma once
// A recording as a source of force: which columns, in which unit, on which clock.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/mend.hpp"
#include "io/table.hpp"
#include "signal/source.hpp"

namespace corpuscle {

/// What becomes of a field that is no number, and of a reading outside the range.
enum class BadFields { error, drop, interpolate };

struct RecordingOptions {
    TableOptions table = {};                              ///< which array of the file
    std::vector<std::string> channels = {};               ///< names, numbers or ranges ("fbg11", "3", "2-5"); empty: all but the time
    std::optional<std::string> time = {};                 ///< the time column's name or number, or "none"; else as the file shows it
    std::optional<std::string> time_unit = {};            ///< of the time column; else the header's, else seconds
    std::optional<double> rate = {};                      ///< Hz: samples are this evenly spaced, whatever the time column says
    std::optional<double> resample = {};                  ///< Hz: interpolated to this rate by straight lines
    std::optional<std::string> unit = {};                 ///< "N", "mN", "gf", "kgf" or "raw"; else the header's
    std::optional<double> scale = {};                     ///< what is read, times this, is newtons
    bool absolute = false;                                ///< of what is read, before all else
    double offset = 0;                                    ///< what is read where there is no force
    std::optional<std::pair<double, double>> range = {};  ///< what may be read; the rest is bad
    std::optional<BadFields> bad_fields = {};             ///< none said: fields that are no numbers are errors, the rest is interpolated
    std::optional<Despike> despike = {};
    std::vector<double> notch = {};      ///< Hz
    std::optional<double> lowpass = {};  ///< Hz
    std::string layout = {};             ///< a file that names the sensors and says where they sit; "": none
    /// Called once a block of a first pass through the file with the share done; false stops it.
    std::function<bool(double)> keep_on = [](double) { return true; };
};

/// Opens a file in one of the formats (formats.hpp). A unit that is no force needs a scale; an uneven clock needs `rate` or
/// `resample`. The file is read twice if it has a time column: once for its clock.
Result<std::unique_ptr<Source>> open_recording(const std::string& path, const RecordingOptions&);

}  // namespace corpuscle
