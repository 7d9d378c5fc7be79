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

std::string_view first_recording_option(const RecordingArguments& args) {
    const std::pair<std::string_view, bool> options[] = {{"--channel", !args.channels.empty()},
                                                         {"--dataset", args.dataset.has_value()},
                                                         {"--skip", args.skip.has_value()},
                                                         {"--transpose", args.transpose.has_value()},
                                                         {"--time", args.time.has_value()},
                                                         {"--time-unit", args.time_unit.has_value()},
                                                         {"--unit", args.unit.has_value()},
                                                         {"--scale", args.scale.has_value()},
                                                         {"--abs", args.absolute},
                                                         {"--resample", args.resample.has_value()},
                                                         {"--offset", args.offset.has_value()},
                                                         {"--range", args.range.has_value()},
                                                         {"--bad-fields", args.bad_fields.has_value()},
                                                         {"--despike", args.despike.has_value()},
                                                         {"--notch", !args.notch.empty()},
                                                         {"--lowpass", args.lowpass.has_value()},
                                                         {"--layout", !args.layout.empty()}};
    for (const auto& [option, given] : options)
        if (given) return option;
    return "";
}

Result<void> check_recording_arguments(const RespondArguments& args) {
    if (!std::all_of(args.forces.begin(), args.forces.end(), [](const auto& f) { return is_stimulus(f); })) return {};
    const auto option = first_recording_option(args);
    if (option.empty()) return {};
    return bad_usage(fmt::format("{} is for recordings, but {} is a stimulus; change it by --set {}.PARAMETER=VALUE", option,
                                 args.forces[0], args.forces[0]));
}

}  // namespace corpuscle
