// afferents.csv: one row for each afferent of a skin. The column afferent_index is Spike::afferent_index, delay_ms the conduction delay,
// first_spike_s a time on the clock of the input, touched_s a duration. The rate is the number of spikes divided by the duration of the
// force. If a class responds to tangential force, direction_deg is the preferred direction from x, counter-clockwise. All values come from
// the summary, which must precede this file among the sinks.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/text/csv_field.hpp"
#include "run/sinks.hpp"
#include "run/summary/skin_summary.hpp"

namespace corpuscle {
namespace {

bool has_directions(const SkinPlan& plan) {
    return std::any_of(plan.classes.begin(), plan.classes.end(), [](const SkinClass& c) { return c.direction.gain > 0; });
}

/// The last field of a row, with the comma before it: the preferred direction in degrees from 0 to 360, or nothing if its class has none.
std::string direction_field(const SkinPlan& plan, const SkinAfferent& afferent) {
    if (!has_directions(plan)) return "";
    if (!(plan.classes[afferent.class_index].direction.gain > 0)) return ",";
    const double turns = afferent.direction / (2 * std::numbers::pi);
    return fmt::format(",{:.3f}", 360 * (turns - std::floor(turns)));
}

std::string afferent_row(const SkinSummary& summary, std::size_t u) {
    const auto& skin = *summary.skin;
    const auto& afferent = skin.afferents[u];
    const double first = summary.first_times[u], seconds = summary.seconds();
    const auto spikes = summary.counts[u];
    return fmt::format("{},{},{},{:.3f},{:.3f},{:.6f},{},{},{:.9g},{:.6g}{}\n", u, quote_csv_field(skin.afferent_name(u)),
                       quote_csv_field(skin.plan.sites.regions[afferent.region]), 1e3 * afferent.position.x, 1e3 * afferent.position.y,
                       1e3 * afferent.delay, spikes, std::isnan(first) ? "" : fmt::format("{:.9f}", summary.input.clock.t0 + first),
                       summary.touched_times[u], seconds > 0 ? static_cast<double>(spikes) / seconds : 0,
                       direction_field(skin.plan, afferent));
}

class AfferentsFile final : public FileSink {
    const SkinSummary& summary_;

public:
    explicit AfferentsFile(const OutputRequest& request) : FileSink(request), summary_(*request.skin) {}
    Result<void> open() { return create("afferents.csv"); }
    Result<void> begin(const Input& input) override {
        return files_[0].write(fmt::format("afferent_index,afferent,region,x_mm,y_mm,delay_ms,spikes,first_spike_s,touched_s,rate_Hz{}\n",
                                           has_directions(input.skin().plan) ? ",direction_deg" : ""));
    }
    Result<void> end(const Input& input, std::int64_t, std::span<const Spike>) override {
        for (std::size_t u = 0; u < input.population.size(); ++u) TRY(files_[0].write(afferent_row(summary_, u)));
        return {};
    }
};

}  // namespace

const OutputFormat afferents_format = {
    .names = {"afferents.csv"},
    .make = make_file_sink<AfferentsFile>,
    .is_written = [](const OutputRequest& request) { return request.skin != nullptr; },
};

}  // namespace corpuscle
