#include "recording_arguments.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "signal/quantity.hpp"
#include "signal/stimuli.hpp"

namespace corpuscle {
namespace {

/// "LO..HI"
Result<std::pair<double, double>> range_of(const std::string& text) {
    const auto dots = text.find("..");
    const auto low = parse_quantity(text.substr(0, dots), ""),
               high = dots == std::string::npos ? low : parse_quantity(text.substr(dots + 2), "");
    if (dots == std::string::npos || !low || !high || !(*low < *high))
        return bad_usage(fmt::format("--range {}: write LO..HI with LO below HI, in the unit of the readings, such as 0..4095", text));
    return std::pair{*low, *high};
}

/// Reads the options that are not a single quantity.
Result<void> read_structured_options(const RecordingArguments& w, RecordingOptions& options) {
    if (w.range) {
        const auto range = range_of(*w.range);
        if (!range) return range.error();
        options.range = *range;
    }
    if (w.bad_fields)
        options.bad_fields = *w.bad_fields == "error"  ? BadFields::error
                             : *w.bad_fields == "drop" ? BadFields::drop
                                                       : BadFields::interpolate;
    if (w.despike) {
        const auto limit = *w.despike == "auto" ? Result<double>(1) : parse_quantity(*w.despike, "");
        if (!limit || !(*limit > 0))
            return bad_usage(fmt::format("--despike {}: write 'auto', or a limit above 0 in the unit of the readings", *w.despike));
        options.despike.emplace();
        if (*w.despike != "auto") options.despike->limit = *limit;
    }
    for (const auto& text : w.notch) {
        const auto f = parse_quantity(text, "Hz");
        if (!f) return bad_usage(fmt::format("--notch {}", f.error().message));
        options.notch.push_back(*f);
    }
    return {};
}

/// Newtons per unit of the readings: "0.002", "10%", or with a unit, "2mN".
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

Result<RecordingOptions> recording_options(const RecordingArguments& w) {
    RecordingOptions options;
    options.table.dataset = w.dataset;
    options.table.skip_lines = w.skip.value_or(0);
    options.table.transpose = w.transpose;
    options.channels = w.channels, options.time = w.time, options.time_unit = w.time_unit, options.unit = w.unit;
    options.absolute = w.absolute;
    options.layout = w.layout;
    std::optional<double> offset;
    for (const auto& [text, unit, option, to] : {std::tuple{&w.rate, "Hz", "--rate", &options.rate},
                                                 {&w.resample, "Hz", "--resample", &options.resample},
                                                 {&w.offset, "", "--offset", &offset},
                                                 {&w.lowpass, "Hz", "--lowpass", &options.lowpass}}) {
        const auto value = optional_quantity(*text, unit, option);
        if (!value) return value.error();
        *to = *value;
    }
    const auto scale = scale_of(w.scale);
    if (!scale) return scale.error();
    options.scale = *scale;
    options.offset = offset.value_or(0);
    if (auto ok = read_structured_options(w, options); !ok) return ok.error();
    return options;
}

std::string_view first_recording_option(const RecordingArguments& w) {
    const std::pair<std::string_view, bool> options[] = {{"--channel", !w.channels.empty()},
                                                         {"--dataset", w.dataset.has_value()},
                                                         {"--skip", w.skip.has_value()},
                                                         {"--transpose", w.transpose.has_value()},
                                                         {"--time", w.time.has_value()},
                                                         {"--time-unit", w.time_unit.has_value()},
                                                         {"--unit", w.unit.has_value()},
                                                         {"--scale", w.scale.has_value()},
                                                         {"--abs", w.absolute},
                                                         {"--resample", w.resample.has_value()},
                                                         {"--offset", w.offset.has_value()},
                                                         {"--range", w.range.has_value()},
                                                         {"--bad-fields", w.bad_fields.has_value()},
                                                         {"--despike", w.despike.has_value()},
                                                         {"--notch", !w.notch.empty()},
                                                         {"--lowpass", w.lowpass.has_value()},
                                                         {"--layout", !w.layout.empty()}};
    for (const auto& [option, given] : options)
        if (given) return option;
    return "";
}

Result<void> check_recording_arguments(const RespondArguments& w) {
    if (!std::all_of(w.forces.begin(), w.forces.end(), [](const auto& f) { return is_stimulus(f); })) return {};
    const auto option = first_recording_option(w);
    if (option.empty()) return {};
    return bad_usage(
        fmt::format("{} is for recordings, but {} is a stimulus; change it by --set {}.PARAMETER=VALUE", option, w.forces[0], w.forces[0]));
}

}  // namespace corpuscle
