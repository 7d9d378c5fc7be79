#include "run/sinks/skin_afferents_file.hpp"

#include <fmt/format.h>
#include <cmath>
#include <iterator>

#include "io/spikes/spike_files.hpp"

namespace corpuscle {
namespace {

std::string afferent_row(const SkinSummary& summary, std::size_t u) {
    const auto& skin = summary.skin();
    const auto& afferent = skin.afferents[u];
    const double first = summary.first_times()[u], seconds = summary.seconds();
    const auto spikes = summary.counts()[u];
    return fmt::format("{},{},{},{:.3f},{:.3f},{:.6f},{},{},{:.9g},{:.6g}\n", u, quote_csv_field(skin.afferent_name(u)),
                       quote_csv_field(skin.plan.sites.regions[afferent.region]), 1e3 * afferent.position.x, 1e3 * afferent.position.y,
                       1e3 * afferent.delay, spikes, std::isnan(first) ? "" : fmt::format("{:.9f}", summary.clock().t0 + first),
                       summary.touched_times()[u], seconds > 0 ? static_cast<double>(spikes) / seconds : 0);
}

}  // namespace

Result<void> SkinAfferentsFile::end(const SkinInput&, std::int64_t, std::span<const Spike>) {
    if (auto ok = file_.write("afferent_index,afferent,region,x_mm,y_mm,delay_ms,spikes,first_spike_s,touched_s,rate_Hz\n"); !ok) return ok;
    for (std::size_t u = 0; u < summary_.skin().afferents.size(); ++u)
        if (auto ok = file_.write(afferent_row(summary_, u)); !ok) return ok;
    return {};
}

}  // namespace corpuscle
