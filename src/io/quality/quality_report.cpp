#include "io/quality/quality_report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>

#include "core/text/ascii_text.hpp"

#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

// Above these fractions a fault is reported, or is a warning: of the samples for outliers, of the variance for hum.
constexpr double min_outliers_note = 1e-3, min_outliers_warning = 0.01, min_hum_note = 0.02, min_hum_warning = 0.1;
constexpr double max_plausible_force = 40;  // N, ten times the upper end of the range to which the models are fitted

std::string percent(double fraction) { return fmt::format("{:.3g} %", 100 * fraction); }

double outlier_fraction(const ChannelPipeline& p) {
    const auto examined = p.outliers.examined();
    return examined > 0 ? static_cast<double>(p.outliers.count()) / static_cast<double>(examined) : 0;
}

/// The channels that have a fault, and the worst of them.
struct AffectedChannels {
    std::vector<std::size_t> channels;  ///< indices
    std::size_t worst = 0;              ///< index of the worst channel
    std::string names;                  ///< for messages: "'fz'", "'ch3' (the worst of 5 channels)"
};

/// Implements assess_quality().
class ReportWriter {
    const std::vector<Channel>& channels_;
    const std::vector<ChannelPipeline>& pipelines_;
    RecordingQuality out_;

    /// The channels for which `severity` is above 0. The channel with the highest severity is the worst one.
    AffectedChannels affected_channels(const std::function<double(const ChannelPipeline&)>& severity) const {
        AffectedChannels c;
        for (std::size_t k = 0; k < pipelines_.size(); ++k) {
            if (!(severity(pipelines_[k]) > 0)) continue;
            if (c.channels.empty() || severity(pipelines_[k]) > severity(pipelines_[c.worst])) c.worst = k;
            c.channels.push_back(k);
        }
        if (!c.channels.empty())
            c.names = pipelines_.size() == 1   ? "the force"
                      : c.channels.size() == 1 ? fmt::format("'{}'", channels_[c.worst].name)
                                               : fmt::format("'{}' (the worst of {} channels)", channels_[c.worst].name, c.channels.size());
        return c;
    }

    void add(bool is_warning, std::string message) { (is_warning ? out_.warnings : out_.descriptions).push_back(std::move(message)); }

    void add_metric(std::size_t channel, std::string_view name, double value, std::string_view unit = "") {
        out_.metrics.push_back({channels_[channel].id, name, value, unit});
    }

    // Each of the following functions adds the messages about one kind of fault.

    void outliers() {
        const auto c = affected_channels([](const auto& p) { return outlier_fraction(p) > min_outliers_note ? outlier_fraction(p) : 0; });
        if (c.channels.empty()) return;
        const auto& worst = pipelines_[c.worst];
        add(outlier_fraction(worst) > min_outliers_warning,
            fmt::format(
                "{}: {} of {} samples ({}) are isolated outliers, probably transmission errors; consecutive ones are not counted. Use "
                "--range LO..HI or --despike LIMIT to remove them",
                c.names, worst.outliers.count(), worst.outliers.examined(), percent(outlier_fraction(worst))));
    }

    void hum() {
        const auto c =
            affected_channels([](const auto& p) { return p.hum.result().fraction > min_hum_note ? p.hum.result().fraction : 0; });
        if (c.channels.empty()) return;
        const auto found = pipelines_[c.worst].hum.result();
        add(found.fraction > min_hum_warning,
            fmt::format("{}: mains hum at {:g} Hz is {} of the variance within a second, and afferents that respond to the derivative "
                        "amplify it; use --notch {:g}Hz to remove it",
                        c.names, found.frequency, percent(found.fraction), found.frequency));
    }

    void saturation() {
        const auto c = affected_channels([](const auto& p) { return p.saturation.is_likely() ? p.saturation.fraction() : 0; });
        if (c.channels.empty()) return;
        const auto& s = pipelines_[c.worst].saturation;
        add(false, fmt::format("{}: repeatedly stays at its maximum, {:.4g} N ({} of the samples); the sensor or its converter may be "
                               "saturated",
                               c.names, s.highest(), percent(s.fraction())));
    }

    /// Warns if the highest value in the file is 255, 1023, 4095 ..., the full-scale code of a converter, and occurs at least three times.
    void full_scale() {
        // The number of codes of the converter, 256, 1024 ...; 0 if the highest value is not its full-scale code.
        const auto codes = [](const ChannelPipeline& p) {
            const double raw = p.saturation.highest() / p.gain() + p.offset(), next = std::round(raw) + 1;  // raw: value in the file
            const bool power = next >= 256 && next <= 0x1p32 && std::exp2(std::round(std::log2(next))) == next;
            return power && std::abs(raw - (next - 1)) < 1e-6 * next && p.saturation.fraction() * static_cast<double>(p.levels.count) >= 3
                       ? next
                       : 0;
        };
        const auto c = affected_channels(codes);
        if (c.channels.empty()) return;
        const auto& worst = pipelines_[c.worst];
        add(true, fmt::format("{} is {:g}, the full scale of a {:g}-bit converter, for {} of the time; it is saturated, or not a force. "
                              "Use --channel to select other columns",
                              c.names, codes(worst) - 1, std::log2(codes(worst)), percent(worst.saturation.fraction())));
    }

    void sums(const SumDetector& sum_detector) {
        for (const auto& s : sum_detector.find_sums())
            add(false, fmt::format("'{}' is the sum of '{}' to '{}', not a sensor of its own; use --channel or --layout to exclude it",
                                   channels_[s.channel].name, channels_[s.from].name, channels_[s.to].name));
    }

    void levels() {
        const auto high = affected_channels([](const auto& p) { return p.levels.max > max_plausible_force ? p.levels.max : 0; });
        if (!high.channels.empty())
            add(true, fmt::format("{}: up to {:.4g} N, but the thesis's models are fitted to 0.2 to 4 N; use --scale S to convert to the "
                                  "force on one receptor",
                                  high.names, pipelines_[high.worst].levels.max));
        low_levels();
        const auto negative = affected_channels([](const auto& p) {
            return !p.is_component && p.levels.min < -0.2 && -p.levels.min > p.levels.max ? -p.levels.min : 0;
        });
        if (!negative.channels.empty())
            add(true, fmt::format("{}: mostly negative, down to {:.4g} N, but a press must be positive; use --abs or a negative --scale",
                                  negative.names, pipelines_[negative.worst].levels.min));
        constant_levels();
    }

    void low_levels() {
        double largest = 0;
        bool changes = false;
        for (const auto& p : pipelines_)
            largest = std::max({largest, p.levels.max, p.is_component ? -p.levels.min : 0}), changes |= p.levels.max > p.levels.min;
        if (changes && largest < 0.2)
            add(false, fmt::format("all forces are below 0.2 N (maximum {:.3g} N): the thesis's models hardly respond, those calibrated to "
                                   "nerves respond from millinewtons on; check the unit",
                                   largest));
    }

    void constant_levels() {
        const auto constant = affected_channels([](const auto& p) { return p.levels.max == p.levels.min ? 1 : 0; });
        if (constant.channels.empty()) return;
        const bool all = constant.channels.size() == pipelines_.size();
        if (pipelines_.size() == 1) {
            if (const auto& only = pipelines_[0].levels; only.count > 1)
                add(true, fmt::format("the force is constant, {:.4g} N; check the file and the channel", only.max));
        } else if (all || !pipelines_[0].is_component) {
            constexpr std::size_t max_names = 4;
            std::vector<std::string> names;
            for (const auto k : std::span(constant.channels).first(std::min(constant.channels.size(), max_names)))
                names.push_back(fmt::format("'{}'", channels_[k].name));
            if (constant.channels.size() > max_names) names.push_back("...");
            add(all, all ? fmt::format("all {} channels are constant; check the file and the channels", constant.channels.size())
                         : fmt::format("{} of {} channels are constant: {}", constant.channels.size(), pipelines_.size(), joined(names)));
        }
    }

    /// Reports the levels at rest that --zero subtracts.
    void rest_levels() {
        const auto rest = [](const ChannelPipeline& p) -> const RestLevel& { return p.filters().rest; };
        if (!rest(pipelines_[0]).is_used()) return;
        if (!rest(pipelines_[0]).is_known())
            return add(true, "the recording is shorter than the rest period of --zero, so the force is 0 throughout");
        double low = rest(pipelines_[0]).level(), high = low;
        for (const auto& p : pipelines_) low = std::min(low, rest(p).level()), high = std::max(high, rest(p).level());
        add(false, low == high ? fmt::format("--zero: the level at rest, {:.4g} N, was subtracted", low)
                               : fmt::format("--zero: levels at rest from {:.4g} to {:.4g} N were subtracted", low, high));
    }

    /// Reports the band of --deadband.
    void deadbands() {
        const auto band = [](const ChannelPipeline& p) { return p.filters().deadband.band(); };
        if (!pipelines_[0].filters().deadband.is_used()) return;  // not requested, or not measured because the recording is too short
        double low = band(pipelines_[0]), high = low;
        for (const auto& p : pipelines_) low = std::min(low, band(p)), high = std::max(high, band(p));
        const auto bands = low == high ? format_quantity(low, "N") : format_quantity(low, "N") + " to " + format_quantity(high, "N");
        add(false, fmt::format("--deadband: changes within +-{}{} were removed; forces up to twice that are 0, and rising forces are "
                               "smaller by as much",
                               bands,
                               pipelines_[0].filters().measures_deadband
                                   ? fmt::format(" ({:g} times the noise of each channel in the rest period)", Deadband::max_noise)
                                   : ""));
    }

    void repaired(const RowReader& rows) {
        std::int64_t outliers = 0, filled = 0;  // numbers of samples, summed over all channels
        for (const auto& p : pipelines_) outliers += p.outliers_removed(), filled += p.filled();
        if (rows.dropped > 0) add(false, fmt::format("{} rows with a bad field were dropped", rows.dropped));
        std::int64_t samples = 0;  // of all channels
        for (const auto& p : pipelines_) samples += p.levels.count;
        constexpr std::int64_t min_warning = 20;  // warn if more than one sample in this number was interpolated
        if (filled > 0)
            add(filled * min_warning > samples, fmt::format("{} of {} samples were interpolated ({} outside --range, {} outliers)", filled,
                                                            samples, rows.out_of_range, outliers));
        if (filled * 2 > samples) add(true, "more than half of the samples were interpolated; the response is not meaningful");
    }

    void clock(const RowClock& rows) {
        if (rows.gap_count > 0 && !rows.uses_row_times && rows.time_column)
            add(false, fmt::format("{} time steps are longer than 1.5 times the median step", rows.gap_count));
    }

    void add_metrics() {
        for (std::size_t k = 0; k < pipelines_.size(); ++k) {
            const auto& p = pipelines_[k];
            add_metric(k, "force_min", p.levels.min, "N");
            add_metric(k, "force_max", p.levels.max, "N");
            add_metric(k, "below_0.2N", p.levels.fraction(p.levels.below_range));
            add_metric(k, "above_4N", p.levels.fraction(p.levels.above_range));
            add_metric(k, "negative", p.levels.fraction(p.levels.negative));
            add_metric(k, "outliers", outlier_fraction(p));
            add_metric(k, "at_highest", p.saturation.fraction());
            add_metric(k, "hum", p.hum.result().fraction);
            add_metric(k, "hum_frequency", p.hum.result().frequency, "Hz");
            add_metric(k, "filled", static_cast<double>(p.filled()));
            add_metric(k, "noise", p.noise.deviation(), "N");
            if (p.filters().deadband.is_used()) add_metric(k, "deadband", p.filters().deadband.band(), "N");
        }
    }

public:
    ReportWriter(const std::vector<Channel>& channels, const std::vector<ChannelPipeline>& pipelines)
        : channels_(channels), pipelines_(pipelines) {}

    RecordingQuality write(const ForceRows& rows, const RowClock& row_clock) {
        clock(row_clock);
        sums(rows.sums());
        repaired(rows.rows());
        outliers();
        hum();
        saturation();
        full_scale();
        levels();
        rest_levels();
        deadbands();
        add_metrics();
        return std::move(out_);
    }
};

}  // namespace

RecordingQuality assess_quality(const std::vector<Channel>& channels, const ForceRows& rows, const RowClock& row_clock) {
    return ReportWriter(channels, rows.pipelines()).write(rows, row_clock);
}

}  // namespace corpuscle
