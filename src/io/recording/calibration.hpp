#pragma once
// The calibration of a sensor by two readings: at zero force and under a known load.
//
//     force = scale (reading - zero),   scale = load force / (reading under load - zero)
//
// A reading is given, or is the mean over a time window of the recording itself. Each channel then has its own.

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

class RowReader;
struct Clock;
struct RecordingOptions;
struct RowClock;

struct CalibrationPoint {
    double reading = 0;                                  ///< in the unit of the file; not used with a window
    std::optional<std::pair<double, double>> window = {};  ///< s, on the clock of the recording
};

/// One --calibrate: "zero=812,load=2140@2N", "fz:zero=0s..1s,load=3s..4s@2N".
struct Calibration {
    std::string channel = {};  ///< "": every channel without one of its own
    CalibrationPoint zero = {};
    std::optional<CalibrationPoint> load = {};
    double force = 0;  ///< N, under the load
};

Result<Calibration> parse_calibration(const std::string&);

/// The calibration of a channel; null if it has none.
const Calibration* find_calibration(std::span<const Calibration>, const std::string& channel);

/// Returns an error if an option contradicts a calibration, or if a calibration names no channel.
Result<void> check_calibrations(const RecordingOptions&, std::span<const std::string> channels, const std::string& path);

/// The conversion of a channel to newtons.
struct ChannelScale {
    double gain = 1, offset = 0;  ///< N per unit of the file; the reading at zero force
};

struct CalibrationNotes {
    std::vector<std::string> notes = {}, warnings = {};
};

/// Replaces the scales of calibrated channels. `rows` reads the channels, and after them the times if each row has its own; the table is then
/// rewound by the caller.
Result<void> calibrate(const RecordingOptions&, const std::vector<std::string>& channels, RowReader rows, const RowClock&,
                       const std::string& path, std::vector<ChannelScale>&, CalibrationNotes&);

}  // namespace corpuscle
