#pragma once
// Opens a recording file as a source of force. The options select its columns, units and clock, and the repair of its samples.

#include "core/force_source.hpp"
#include "io/quality/filters.hpp"
#include "io/recording/calibration.hpp"
#include "io/table/table.hpp"

namespace corpuscle {

/// The treatment of bad fields, which are not numbers or are outside RecordingOptions::range: an error, dropping their row, or
/// interpolation.
enum class BadFields { error, drop, interpolate };

/// The curve between two rows: a straight line, or a cubic B-spline, which has no corners and stays between the largest and the smallest
/// of four rows around it.
enum class Interpolation { linear, smooth };

struct RecordingOptions {
    TableOptions table = {};
    std::vector<std::string> channels = {};     ///< names, numbers (from 1) or ranges ("fbg11", "3", "2-5"); empty: all force columns
    std::optional<std::string> time = {};       ///< name or number of the time column, or "none"; default: as in the file
    std::optional<std::string> time_unit = {};  ///< unit of the time column; default: as in the header, otherwise seconds
    std::optional<double> rate = {};            ///< Hz; treats the rows as evenly spaced at this rate and ignores their times
    std::optional<double> resample = {};        ///< Hz; interpolates the samples to this rate
    std::optional<std::string> unit = {};       ///< of the channels: "N", "mN", "gf", "kgf" or "raw"; default: as in the header
    std::optional<double> scale = {};           ///< newtons per unit of the values in the file
    bool absolute = false;                      ///< takes the absolute value of the values in the file
    double offset = 0;                          ///< the value in the file at zero force
    std::vector<Calibration> calibrations = {};           ///< instead of scale and offset
    std::optional<std::pair<double, double>> range = {};  ///< lowest and highest valid value in the file; others are bad fields
    std::optional<BadFields> bad_fields = {};             ///< default: an error for a field that is not a number, otherwise interpolation
    std::optional<DespikeOptions> despike = {};           ///< removes outliers; nullopt: keeps them
    std::vector<double> notch = {};                       ///< Hz, frequencies to remove
    std::optional<double> lowpass = {};                   ///< Hz, -3 dB frequency; nullopt: no low-pass filter
    std::optional<double> zero = {};                      ///< s, length of the rest period at the beginning; see RestLevel; nullopt: none
    std::optional<DeadbandOptions> deadband = {};         ///< removes the noise of the sensor; nullopt: none
    /// The curve through the rows from which `resample` takes its samples. Smooth needs evenly spaced rows.
    std::optional<Interpolation> interpolation = {};
    std::string layout = {};  ///< path of a file with the names and positions of the sensors; "": none
    /// Called for each block while the file is read to determine its clock, with the fraction read so far. If it returns false, opening
    /// stops with an error.
    std::function<bool(double)> should_continue = [](double) { return true; };
};

/// Opens the table of a recording.
Result<std::unique_ptr<Table>> open_recording_table(const std::string& path, const RecordingOptions&);
/// A table as a source of force. `name`: of the source; "": that of the file.
Result<std::unique_ptr<ForceSource>> make_recording(std::unique_ptr<Table>, const std::string& path, const std::string& name,
                                                    const RecordingOptions&);

/// Opens a recording in one of the formats of recording_formats.hpp. A unit that is not a force requires a scale. An uneven clock
/// requires `rate` or `resample`. A file with a time column is read completely when it is opened, to determine its clock, and again by
/// read().
Result<std::unique_ptr<ForceSource>> open_recording(const std::string& path, const RecordingOptions&);

}  // namespace corpuscle
