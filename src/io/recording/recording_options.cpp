// The options for reading a recording, for the command line and for programs.

#include "io/recording/recording_options.hpp"

#include <fmt/format.h>

namespace corpuscle {
namespace {

/// Newtons per unit of the readings: "0.002", "10%", or with a unit, "2mN".
Result<double> parse_scale(const std::string& text) {
    auto plain = parse_quantity(text, ""), scale = plain ? plain : parse_quantity(text, "N");
    return scale ? scale : bad_usage(fmt::format("'{}': write newtons per unit of the readings: 0.002, or 2mN", text));
}

/// "LO..HI".
Result<std::pair<double, double>> parse_range(const std::string& text) {
    const auto dots = text.find("..");
    const auto low = parse_quantity(text.substr(0, dots), ""),
               high = dots == std::string::npos ? low : parse_quantity(text.substr(dots + 2), "");
    if (dots == std::string::npos || !low || !high || !(*low < *high))
        return bad_usage(fmt::format("{}: write LO..HI with LO below HI, in the unit of the readings, such as 0..4095", text));
    return std::pair(*low, *high);
}

Result<BadFields> parse_bad_fields(const std::string& text) {
    return text == "error" ? BadFields::error : text == "drop" ? BadFields::drop : BadFields::interpolate;
}

Result<DespikeOptions> parse_despike(const std::string& text) {
    if (text == "auto") return DespikeOptions{};
    const auto limit = parse_quantity(text, "");
    if (!limit || !(*limit > 0)) return bad_usage(fmt::format("{}: write 'auto', or a limit above 0 in the unit of the readings", text));
    return DespikeOptions{*limit};
}

/// Half the width of the band, N.
Result<DeadbandOptions> parse_deadband(const std::string& text) {
    if (text == "auto") return DeadbandOptions{};
    const auto band = parse_quantity(text, "N");
    if (!band || !(*band > 0)) return bad_usage(fmt::format("{}: write 'auto', or a force above 0, such as 20mN", text));
    return DeadbandOptions{*band};
}

Result<Interpolation> parse_interpolation(const std::string& text) {
    return text == "smooth" ? Interpolation::smooth : Interpolation::linear;
}

/// The text has been checked to be an integer; it may also be "1k".
Result<std::size_t> parse_count(const std::string& text) { return static_cast<std::size_t>(TRY(parse_quantity(text, ""))); }

}  // namespace

OptionGroup recording_option_group(RecordingOptions& options) {
    return {
        "Recordings",
        {{"--channel,-c", &options.channels, "CHANNEL",
          "channels of a recording: names, or numbers and ranges (2-5) that count all columns except time"},
         {"--dataset", &options.table.dataset, "NAME", "array to read from a file with several (HDF5, NPZ), by path or name"},
         {"--transpose", &options.table.transpose, "", "rows of a recording are channels"},
         excluding("--transpose", {"--no-transpose", &options.table.transpose, "",
                                   "rows of a recording are samples, even if there are fewer rows than channels"}),
         {"--skip", value_reader(options.table.skip_lines, parse_count), "LINES", "number of lines to skip at the beginning of a text file",
          std::pair(0U, 1'000'000U)},
         {"--time", &options.time, "COLUMN", "time column of a recording by name or number, or 'none'"},
         {"--time-unit", &options.time_unit, "UNIT", "unit of the time column, if the header has none: s, ms, us, ns"},
         {"--unit", &options.unit, "UNIT", "unit of the recording: N, mN, gf, kgf, or raw (with --scale)"},
         {"--scale", value_reader(options.scale, parse_scale), "S", "newtons per unit of the recording: 0.002, 2mN"},
         {"--abs", &options.absolute, "", "use the absolute value of each reading"},
         {"--offset", quantity_reader(options.offset, ""), "X", "reading at zero force, subtracted before --scale"},
         repeatable({"--calibrate", list_reader(options.calibrations, parse_calibration), "zero=COUNT,load=COUNT@FORCE",
                     "instead of --offset and --scale: the readings at zero force and under a known load, zero=812,load=2140@2N, or the "
                     "times at which the recording has them, zero=0s..1s,load=3s..4s@2N (repeatable: fz:zero=...)"}),
         {"--range", value_reader(options.range, parse_range), "LO..HI",
          "valid range of readings; --bad-fields says what happens to others"},
         {"--bad-fields", value_reader(options.bad_fields, parse_bad_fields), "WHAT",
          "what to do with fields that are not numbers and readings out of --range: error (default for fields), drop the row, "
          "interpolate (default for readings)",
          one_of("error", "drop", "interpolate")},
         {"--despike", value_reader(options.despike, parse_despike), "LIMIT",
          "outlier limit: readings further than this from the median of 25 neighbours are bad (auto is 6 standard deviations)"},
         repeatable({"--notch", list_reader(options.notch, quantity_of("Hz")), "FREQUENCY",
                     "remove mains hum: 50Hz, with a bandwidth of 4 Hz (repeatable)"}),
         {"--lowpass", quantity_reader(options.lowpass, "Hz"), "FREQUENCY",
          "low-pass filter at this frequency (Butterworth, second order)"},
         {"--zero", refuse_if([&options] { return !(*options.zero > 0); }, "must be above 0", quantity_reader(options.zero, "s")), "TIME",
          "subtract the level of each channel at rest: its median during the first TIME, in which the force is taken as 0"},
         {"--deadband", value_reader(options.deadband, parse_deadband), "BAND",
          "remove the sensor's noise: the force follows changes beyond +-BAND only, such as 20mN (auto: 4 times the noise of each "
          "channel during --zero TIME)"},
         {"--layout", &options.layout, "FILE", "CSV table of sensor names and positions: channel,name,x_mm,y_mm"},
         {"--resample", quantity_reader(options.resample, "Hz"), "FREQUENCY", "resample a recording to this rate by interpolation"},
         {"--interpolation", value_reader(options.interpolation, parse_interpolation), "CURVE",
          "between the samples for --resample: linear (straight lines, the default), or smooth (a curve without corners, which excite "
          "FA-I and FA-II)",
          one_of("linear", "smooth")}}};
}

OptionGroup named_recording_options(RecordingOptions& options) {
    auto group = recording_option_group(options);
    group.rows.push_back({"--rate", value_reader(options.rate, quantity_of("Hz")), "HZ", "sampling rate"});
    return group;
}

}  // namespace corpuscle
