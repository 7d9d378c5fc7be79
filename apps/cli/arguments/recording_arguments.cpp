#include "cli/arguments/recording_arguments.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/stimulus/stimuli.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

/// Parses "LO..HI".
Result<std::pair<double, double>> range_of(const std::string& text) {
    const auto dots = text.find("..");
    const auto low = parse_quantity(text.substr(0, dots), ""),
               high = dots == std::string::npos ? low : parse_quantity(text.substr(dots + 2), "");
    if (dots == std::string::npos || !low || !high || !(*low < *high))
        return bad_usage(fmt::format("--range {}: write LO..HI with LO below HI, in the unit of the readings, such as 0..4095", text));
    return std::pair{*low, *high};
}

/// Reads the options that are not a single quantity.
Result<void> read_structured_options(const RecordingArguments& args, RecordingOptions& options) {
    if (args.range) {
        const auto range = range_of(*args.range);
        if (!range) return range.error();
        options.range = *range;
    }
    if (args.bad_fields)
        options.bad_fields = *args.bad_fields == "error"  ? BadFields::error
                             : *args.bad_fields == "drop" ? BadFields::drop
                                                          : BadFields::interpolate;
    if (args.despike) {
        const auto limit = *args.despike == "auto" ? Result<double>(1) : parse_quantity(*args.despike, "");
        if (!limit || !(*limit > 0))
            return bad_usage(fmt::format("--despike {}: write 'auto', or a limit above 0 in the unit of the readings", *args.despike));
        options.despike.emplace();
        if (*args.despike != "auto") options.despike->limit = *limit;
    }
    for (const auto& text : args.notch) {
        const auto f = parse_quantity(text, "Hz");
        if (!f) return bad_usage(fmt::format("--notch {}", f.error().message));
        options.notch.push_back(*f);
    }
    return {};
}

/// Parses newtons per unit of the readings: "0.002", "10%", or with a unit, "2mN".
Result<std::optional<double>> scale_of(const std::optional<std::string>& text) {
    const auto plain = optional_quantity(text, "", "--scale");
    const auto force = plain ? plain : optional_quantity(text, "N", "--scale");
    if (force) return force;
    return bad_usage(fmt::format("--scale '{}': write newtons per unit of the readings: 0.002, or 2mN", *text));
}

}  // namespace

OptionGroup recording_option_group(RecordingArguments& args) {
    return {"Recordings",
            {{"--channel,-c", &args.channels, "CHANNEL",
              "channels of a recording: names, or numbers and ranges (2-5) that count all columns except time"},
             {"--dataset", &args.dataset, "NAME", "array to read from a file with several (HDF5, NPZ), by path or name"},
             {"--transpose", &args.transpose, "", "rows of a recording are channels"},
             excluding("--transpose", {"--no-transpose", &args.transpose, "",
                                       "rows of a recording are samples, even if there are fewer rows than channels"}),
             {"--skip", &args.skip, "LINES", "number of lines to skip at the beginning of a text file", std::pair(0U, 1'000'000U)},
             {"--time", &args.time, "COLUMN", "time column of a recording by name or number, or 'none'"},
             {"--time-unit", &args.time_unit, "UNIT", "unit of the time column, if the header has none: s, ms, us, ns"},
             {"--unit", &args.unit, "UNIT", "unit of the recording: N, mN, gf, kgf, or raw (with --scale)"},
             {"--scale", &args.scale, "S", "newtons per unit of the recording: 0.002, 2mN"},
             {"--abs", &args.absolute, "", "use the absolute value of each reading"},
             {"--offset", &args.offset, "X", "reading at zero force, subtracted before --scale"},
             {"--range", &args.range, "LO..HI", "valid range of readings; --bad-fields says what happens to others"},
             {"--bad-fields", &args.bad_fields, "WHAT",
              "what to do with fields that are not numbers and readings out of --range: error (default for fields), drop the row, "
              "interpolate (default for readings)",
              one_of("error", "drop", "interpolate")},
             {"--despike", &args.despike, "LIMIT",
              "outlier limit: readings further than this from the median of 25 neighbours are bad (auto is 6 standard deviations)"},
             {"--notch", &args.notch, "FREQUENCY", "remove mains hum: 50Hz, with a bandwidth of 4 Hz (repeatable)"},
             {"--lowpass", &args.lowpass, "FREQUENCY", "low-pass filter at this frequency (Butterworth, second order)"},
             {"--layout", &args.layout, "FILE", "CSV table of sensor names and positions: channel,name,x_mm,y_mm"},
             {"--resample", &args.resample, "FREQUENCY", "resample a recording to this rate by interpolation"}}};
}

Result<std::optional<double>> optional_quantity(const std::optional<std::string>& text, std::string_view unit, std::string_view option) {
    if (!text) return std::optional<double>();
    const auto value = parse_quantity(*text, unit);
    if (!value) return bad_usage(fmt::format("{} {}", option, value.error().message));
    return std::optional<double>(*value);
}

Result<RecordingOptions> recording_options(const RecordingArguments& args) {
    RecordingOptions options;
    options.table.dataset = args.dataset;
    options.table.skip_lines = args.skip.value_or(0);
    options.table.transpose = args.transpose;
    options.channels = args.channels, options.time = args.time, options.time_unit = args.time_unit, options.unit = args.unit;
    options.absolute = args.absolute;
    options.layout = args.layout;
    std::optional<double> offset;
    for (const auto& [text, unit, option, to] : {std::tuple{&args.rate, "Hz", "--rate", &options.rate},
                                                 {&args.resample, "Hz", "--resample", &options.resample},
                                                 {&args.offset, "", "--offset", &offset},
                                                 {&args.lowpass, "Hz", "--lowpass", &options.lowpass}}) {
        const auto value = optional_quantity(*text, unit, option);
        if (!value) return value.error();
        *to = *value;
    }
    const auto scale = scale_of(args.scale);
    if (!scale) return scale.error();
    options.scale = *scale;
    options.offset = offset.value_or(0);
    if (auto ok = read_structured_options(args, options); !ok) return ok.error();
    return options;
}

std::vector<std::string_view> given_recording_options(const RecordingArguments& args) {
    const std::pair<std::string_view, bool> options[] = {
        {"--channel", !args.channels.empty()},       {"--dataset", args.dataset.has_value()},
        {"--skip", args.skip.has_value()},           {"--transpose", args.transpose == true},
        {"--no-transpose", args.transpose == false}, {"--time", args.time.has_value()},
        {"--time-unit", args.time_unit.has_value()}, {"--unit", args.unit.has_value()},
        {"--scale", args.scale.has_value()},         {"--abs", args.absolute},
        {"--resample", args.resample.has_value()},   {"--offset", args.offset.has_value()},
        {"--range", args.range.has_value()},         {"--bad-fields", args.bad_fields.has_value()},
        {"--despike", args.despike.has_value()},     {"--notch", !args.notch.empty()},
        {"--lowpass", args.lowpass.has_value()},     {"--layout", !args.layout.empty()}};
    std::vector<std::string_view> given;
    for (const auto& [option, is_given] : options)
        if (is_given) given.push_back(option);
    return given;
}

Result<void> check_recording_arguments(const RecordingArguments& args, std::span<const std::string> forces) {
    if (!std::all_of(forces.begin(), forces.end(), [](const auto& f) { return is_stimulus(f); })) return {};
    const auto options = given_recording_options(args);
    if (options.empty()) return {};
    return bad_usage(
        fmt::format("{} is for recordings, but {} is a stimulus; change it by --set {}.PARAMETER=VALUE", options[0], forces[0], forces[0]));
}

}  // namespace corpuscle
