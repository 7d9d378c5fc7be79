#include "io/recording/calibration.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "io/recording/force_rows.hpp"
#include "io/recording/row_clock.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_notes = 6;  // about single channels

Error usage(std::string_view text) {
    return bad_usage(fmt::format("'{}': write zero=COUNT,load=COUNT@FORCE, such as zero=812,load=2140@2N, or with times of the recording "
                                 "zero=0s..1s,load=3s..4s@2N, after CHANNEL: if it is for one channel",
                                 text));
}

/// "812", or a window "0s..1s".
std::optional<CalibrationPoint> parse_point(std::string_view text) {
    const auto dots = text.find("..");
    if (dots == text.npos) {
        const auto reading = parse_quantity(text, "");
        return reading ? std::optional(CalibrationPoint{*reading}) : std::nullopt;
    }
    const auto from = parse_quantity(text.substr(0, dots), "s"), to = parse_quantity(text.substr(dots + 2), "s");
    if (!from || !to || !(*from < *to)) return {};
    return CalibrationPoint{0, std::pair(*from, *to)};
}

/// Mean and deviation of readings, as in Welford (1962).
struct Reading {
    double mean = 0, squares = 0, count = 0;
    void add(double x) {
        const double distance = x - mean;
        mean += distance / ++count;
        squares += distance * (x - mean);
    }
    double deviation() const { return count > 1 ? std::sqrt(squares / (count - 1)) : 0; }
    double variance_of_mean() const { return count > 1 ? squares / (count - 1) / count : 0; }
};

/// The readings of one channel. With a given reading, its count is 1.
struct ChannelReadings {
    const Calibration* calibration = nullptr;  // null: the channel is not calibrated
    Reading zero = {}, load = {};
};

void add_to(Reading& reading, const CalibrationPoint& point, double t, double x) {
    if (point.window && t >= point.window->first && t < point.window->second && !std::isnan(x)) reading.add(x);
}

/// Reads the windows of all channels. Returns the first and last time, s.
Result<std::pair<double, double>> read_windows(RowReader& rows, const RowClock& clock, std::vector<ChannelReadings>& channels) {
    std::vector<std::vector<double>> block;
    double first = 0, last = 0;
    for (std::int64_t row = 0;;) {
        const auto count = TRY(rows.next(block));
        if (count == 0) return std::pair(first, last);
        for (std::size_t k = 0; k < count; ++k, ++row) {
            last = clock.uses_row_times ? clock.seconds(block.back()[k]) : clock.clock.time(row);
            if (row == 0) first = last;
            for (std::size_t c = 0; c < channels.size(); ++c) {
                auto& channel = channels[c];
                if (!channel.calibration) continue;
                add_to(channel.zero, channel.calibration->zero, last, block[c][k]);
                if (channel.calibration->load) add_to(channel.load, *channel.calibration->load, last, block[c][k]);
            }
        }
    }
}

/// Checks that a window contains readings.
Result<void> check_window(const CalibrationPoint& point, const Reading& reading, std::string_view name, std::pair<double, double> recorded,
                          const std::string& path) {
    if (!point.window || reading.count > 0) return {};
    const auto [from, to] = *point.window;
    return bad_input(fmt::format("--calibrate {}={:g}s..{:g}s: there is no reading in this window; the recording lasts from {:g} s to {:g} s",
                                 name, from, to, recorded.first, recorded.second),
                     {path});
}

/// Sets the scale of a channel from its readings.
Result<void> set_scale(const std::string& name, const ChannelReadings& channel, const std::string& path, ChannelScale& scale,
                       CalibrationNotes& out) {
    const auto& [calibration, zero, load] = channel;
    scale.offset = zero.mean;
    if (!calibration->load) return {};
    const double step = load.mean - zero.mean;
    if (step == 0)
        return bad_input(fmt::format("--calibrate: '{}' reads {:g} both at zero and under the load; the readings must differ, so correct "
                                     "them, or leave the channel out with --channel",
                                     name, zero.mean),
                         {path});
    scale.gain = calibration->force / step;
    const double error = std::abs(scale.gain / step) * std::sqrt(zero.variance_of_mean() + load.variance_of_mean());
    if (std::max(zero.deviation(), load.deviation()) > std::abs(step))
        out.warnings.push_back(fmt::format("'{}': the noise of the readings, {:.4g}, is larger than the step of {:.4g} from zero to load; the "
                                           "scale {:.4g} has a standard error of {:.2g}. Use longer windows or a larger load",
                                           name, std::max(zero.deviation(), load.deviation()), std::abs(step), scale.gain, error));
    return {};
}

std::string note_of(const std::string& name, const ChannelReadings& channel, const ChannelScale& scale) {
    auto text = fmt::format("'{}' was calibrated: the same as --offset {:.6g}", name, scale.offset);
    if (!channel.calibration->load) return text;
    const double step = channel.load.mean - channel.zero.mean;
    const double error = std::abs(scale.gain / step) * std::sqrt(channel.zero.variance_of_mean() + channel.load.variance_of_mean());
    return text + fmt::format(" --scale {:.6g}{}", scale.gain, error > 0 ? fmt::format(" (standard error {:.2g})", error) : "");
}

}  // namespace

Result<Calibration> parse_calibration(const std::string& text) {
    Calibration out;
    std::string_view rest = text;
    const auto first_value = rest.find('=');
    if (const auto colon = rest.substr(0, first_value).rfind(':'); colon != rest.npos) {
        out.channel = rest.substr(0, colon);
        rest.remove_prefix(colon + 1);
        if (out.channel.empty()) return usage(text);
    }
    bool has_zero = false;
    for (const auto part : split(rest, ',')) {
        const auto equals = part.find('=');
        const auto name = trimmed(part.substr(0, equals)), value = equals == part.npos ? std::string_view() : trimmed(part.substr(equals + 1));
        const auto at = value.rfind('@');
        const auto point = parse_point(trimmed(value.substr(0, at)));
        if (!point) return usage(text);
        if (name == "zero" && at == value.npos && !has_zero) {
            out.zero = *point, has_zero = true;
        } else if (name == "load" && at != value.npos && !out.load) {
            const auto force = parse_quantity(value.substr(at + 1), "N");
            if (!force || *force == 0) return usage(text);
            out.load = *point, out.force = *force;
        } else {
            return usage(text);
        }
    }
    return has_zero ? Result<Calibration>(std::move(out)) : usage(text);
}

const Calibration* find_calibration(std::span<const Calibration> all, const std::string& channel) {
    const Calibration* found = nullptr;
    for (const auto& c : all)
        if (c.channel == channel || (c.channel.empty() && !found)) found = &c;
    return found;
}

Result<void> check_calibrations(const RecordingOptions& options, std::span<const std::string> channels, const std::string& path) {
    if (options.calibrations.empty()) return {};
    if (options.offset != 0) return bad_usage("--offset and --calibrate exclude each other: both give the reading at zero force");
    const std::vector<std::string_view> names(channels.begin(), channels.end());
    for (const auto& c : options.calibrations) {
        if (c.load && (options.scale || options.unit))
            return bad_usage(fmt::format("{} and the load of --calibrate exclude each other: both give newtons per unit; write --calibrate zero=... "
                                         "alone, or remove {}",
                                         options.scale ? "--scale" : "--unit", options.scale ? "--scale" : "--unit"));
        if (!c.channel.empty() && std::find(names.begin(), names.end(), c.channel) == names.end())
            return bad_input(fmt::format("--calibrate {}: there is no such channel{} (channels: {})", c.channel, did_you_mean(c.channel, names),
                                         joined(std::span(names).first(std::min<std::size_t>(names.size(), 12)))),
                             {path});
    }
    return {};
}

Result<void> calibrate(const RecordingOptions& options, const std::vector<std::string>& channels, RowReader rows, const RowClock& clock,
                       const std::string& path, std::vector<ChannelScale>& scales, CalibrationNotes& out) {
    std::vector<ChannelReadings> readings(channels.size());
    bool has_windows = false;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        auto& channel = readings[c];
        channel.calibration = find_calibration(options.calibrations, channels[c]);
        if (!channel.calibration) continue;
        const auto& [name, zero, load, force] = *channel.calibration;
        has_windows = has_windows || zero.window || (load && load->window);
        if (!zero.window) channel.zero.add(zero.reading);
        if (load && !load->window) channel.load.add(load->reading);
    }
    const auto recorded = has_windows ? TRY(read_windows(rows, clock, readings)) : std::pair(0.0, 0.0);
    std::size_t calibrated = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const auto* calibration = readings[c].calibration;
        if (!calibration) continue;
        TRY(check_window(calibration->zero, readings[c].zero, "zero", recorded, path));
        if (calibration->load) TRY(check_window(*calibration->load, readings[c].load, "load", recorded, path));
        TRY(set_scale(channels[c], readings[c], path, scales[c], out));
        if (++calibrated <= max_notes) out.notes.push_back(note_of(channels[c], readings[c], scales[c]));
    }
    if (calibrated > max_notes)
        out.notes.push_back(fmt::format("{} more channels were calibrated; summary.json has their scales", calibrated - max_notes));
    return {};
}

}  // namespace corpuscle
