#include "recording_words.hpp"

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
        return bad_usage(fmt::format("--range {}: write LO..HI with LO below HI, such as 0..4095, in what is read", text));
    return std::pair{*low, *high};
}

/// Words that are more than one number.
Result<void> read_words(const RespondWords& w, RecordingOptions& options) {
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
            return bad_usage(fmt::format("--despike {}: write 'auto', or a limit above 0 in what is read", *w.despike));
        options.despike.emplace();
        if (*w.despike != "auto") options.despike->limit = *limit;
    }
    for (const auto& text : w.notch) {
        const auto f = parse_quantity(text, "Hz");
        if (!f) return bad_usage(fmt::format("--notch {}", f.error().sentence));
        options.notch.push_back(*f);
    }
    return {};
}

}  // namespace

Result<std::optional<double>> quantity(const std::optional<std::string>& text, std::string_view unit, std::string_view option) {
    if (!text) return std::optional<double>();
    const auto value = parse_quantity(*text, unit);
    if (!value) return bad_usage(fmt::format("{} {}", option, value.error().sentence));
    return std::optional<double>(*value);
}

Result<RecordingOptions> recording_options(const RespondWords& w) {
    RecordingOptions options{
        .table = {w.dataset, w.transpose}, .channels = w.channels, .time = w.time, .time_unit = w.time_unit, .unit = w.unit};
    options.absolute = w.absolute;
    options.layout = w.layout;
    std::optional<double> offset;
    for (const auto& [text, unit, option, to] : {std::tuple{&w.rate, "Hz", "--rate", &options.rate},
                                                 {&w.resample, "Hz", "--resample", &options.resample},
                                                 {&w.scale, "", "--scale", &options.scale},
                                                 {&w.offset, "", "--offset", &offset},
                                                 {&w.lowpass, "Hz", "--lowpass", &options.lowpass}}) {
        const auto value = quantity(*text, unit, option);
        if (!value) return value.error();
        *to = *value;
    }
    options.offset = offset.value_or(0);
    if (auto ok = read_words(w, options); !ok) return ok.error();
    return options;
}

Result<void> check_recording_words(const RespondWords& w) {
    if (!std::all_of(w.forces.begin(), w.forces.end(), [](const auto& f) { return is_stimulus(f); })) return {};
    const std::pair<const char*, bool> words[] = {{"--channel", !w.channels.empty()},       {"--dataset", w.dataset.has_value()},
                                                  {"--transpose", w.transpose.has_value()}, {"--time", w.time.has_value()},
                                                  {"--time-unit", w.time_unit.has_value()}, {"--unit", w.unit.has_value()},
                                                  {"--scale", w.scale.has_value()},         {"--abs", w.absolute},
                                                  {"--resample", w.resample.has_value()},   {"--offset", w.offset.has_value()},
                                                  {"--range", w.range.has_value()},         {"--bad-fields", w.bad_fields.has_value()},
                                                  {"--despike", w.despike.has_value()},     {"--notch", !w.notch.empty()},
                                                  {"--lowpass", w.lowpass.has_value()},     {"--layout", !w.layout.empty()}};
    for (const auto& [word, said] : words)
        if (said)
            return bad_usage(fmt::format("{} is for recordings, and {} is a stimulus; --set {}.PARAMETER=VALUE changes it", word,
                                         w.forces[0], w.forces[0]));
    return {};
}

}  // namespace corpuscle
