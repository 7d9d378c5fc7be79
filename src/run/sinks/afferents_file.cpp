// afferents.csv: one row for each afferent of a skin. The column afferent_index is Spike::afferent_index, delay_ms the conduction delay,
// first_spike_s a time on the clock of the input, touched_s a duration. The rate is the number of spikes divided by the duration of the
// force. If a class responds to tangential force, direction_deg is the preferred direction from x, counter-clockwise. All values come from
// the summary, which must precede this file among the sinks.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/text/csv_field.hpp"
#include "core/text/fixed_number.hpp"
#include "run/sinks/file_sink.hpp"
#include "run/summary/skin_summary.hpp"

namespace corpuscle {
namespace {

bool has_directions(const SkinPlan& plan) {
    return std::any_of(plan.classes.begin(), plan.classes.end(), [](const SkinClass& c) { return c.direction.gain > 0; });
}

/// Appends the last field of a row, with the comma before it: the preferred direction in degrees from 0 to 360, or nothing if its class has
/// none.
void append_direction(const SkinPlan& plan, const SkinAfferent& afferent, fmt::memory_buffer& text) {
    text.push_back(',');
    if (!(plan.classes[afferent.class_index].direction.gain > 0)) return;
    const double turns = afferent.direction / (2 * std::numbers::pi);
    append_fixed(text, 360 * (turns - std::floor(turns)), 3);
}

void append_row(const SkinSummary& summary, std::size_t u, bool has_direction, fmt::memory_buffer& text) {
    const auto& skin = *summary.skin;
    const auto& afferent = skin.afferents[u];
    const double first = summary.first_times[u], seconds = summary.seconds();
    const auto spikes = summary.counts[u];
    const auto to = std::back_inserter(text);
    fmt::format_to(to, "{},{},{}", u, quote_csv_field(skin.afferent_name(u)), quote_csv_field(skin.plan.sites.regions[afferent.region]));
    const auto append = [&](double x, int decimals) { text.push_back(','), append_fixed(text, x, decimals); };
    append(1e3 * afferent.position.x, 3), append(1e3 * afferent.position.y, 3), append(1e3 * afferent.delay, 6);
    fmt::format_to(to, ",{},", spikes);
    if (!std::isnan(first)) append_fixed(text, summary.input.clock.t0 + first, 9);
    fmt::format_to(to, ",{:.9g},{:.6g}", summary.touched_times[u], seconds > 0 ? static_cast<double>(spikes) / seconds : 0);
    if (has_direction) append_direction(skin.plan, afferent, text);
    text.push_back('\n');
}

class AfferentsFile final : public FileSink {
    static constexpr std::size_t max_text = 1 << 16;  // bytes that are kept before they are written
    const SkinSummary& summary_;

public:
    explicit AfferentsFile(const OutputRequest& request) : FileSink(request), summary_(*request.skin) {}
    Result<void> open() { return create("afferents.csv"); }
    Result<void> begin(const Input& input) override {
        return files_[0].write(fmt::format("afferent_index,afferent,region,x_mm,y_mm,delay_ms,spikes,first_spike_s,touched_s,rate_Hz{}\n",
                                           has_directions(input.skin().plan) ? ",direction_deg" : ""));
    }
    Result<void> end(const Input& input, std::int64_t, std::span<const Spike>) override {
        const bool has_direction = has_directions(input.skin().plan);
        fmt::memory_buffer text;
        for (std::size_t u = 0; u < input.population.size(); ++u) {
            append_row(summary_, u, has_direction, text);
            if (text.size() > max_text) TRY(write_text(text));
        }
        return write_text(text);
    }
};

}  // namespace

extern const OutputFormat afferents_format = {
    .names = {"afferents.csv"},
    .make = make_file_sink<AfferentsFile>,
    .is_written = [](const OutputRequest& request) { return request.skin != nullptr; },
};

}  // namespace corpuscle
