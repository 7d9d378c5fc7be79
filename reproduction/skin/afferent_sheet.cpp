#include "reproduction/skin/afferent_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "core/number/elementary.hpp"
#include "skin/skin.hpp"

namespace corpuscle {
namespace {

std::shared_ptr<const Innervation> sheet_innervation(const AfferentSheet& sheet, const std::string& afferent, AfferentPlan plan,
                                                     const SheetForce& force, double sigma) {
    auto out = std::make_shared<Innervation>();
    const std::size_t sensors = force.positions.size(), afferents = sheet.rows * sheet.columns;
    auto& p = out->plan;
    p.name = "sheet";
    p.sites.positions = force.positions;
    for (std::size_t s = 0; s < sensors; ++s) p.sites.names.push_back(std::to_string(s + 1));
    p.sites.region.assign(sensors, 0);
    p.sites.regions = {"sheet"};
    p.classes.push_back({.name = afferent, .afferent = std::move(plan), .sigma = sigma});
    // class 0, number from 1, region 0, position, no delay
    for (std::size_t k = 0; k < afferents; ++k) out->afferents.push_back({0, static_cast<std::uint32_t>(k) + 1, 0, sheet.position(k), 0});
    out->class_begin = {0, afferents};
    auto& fields = out->fields.emplace_back();
    fields.begin.push_back(0);
    for (std::size_t s = 0; s < sensors; ++s) {
        for (std::size_t k = 0; k < afferents; ++k) {
            const double dx = out->afferents[k].position.x - force.positions[s].x, dy = out->afferents[k].position.y - force.positions[s].y;
            const double distance_squared = (dx * dx + dy * dy) / (sigma * sigma);
            if (distance_squared > 16) continue;  // farther than 4 sigma
            fields.afferent.push_back(static_cast<std::uint32_t>(k)), fields.weight.push_back(num::exp(-0.5 * distance_squared));
        }
        fields.begin.push_back(fields.afferent.size());
    }
    return out;
}

/// Computes the centroid in each time bin. Until mean() is called, `track` has the sums of weight, and of weight times position.
struct CentroidSums {
    CentroidTrack track;
    double from, bin;  ///< s: start of the first bin, and bin width

    CentroidSums(double first, double to, double width) : from(first), bin(width) {
        const auto bins = static_cast<std::size_t>(std::round((to - first) / width));
        for (auto* v : {&track.x, &track.y, &track.weight}) v->assign(bins, 0);
        for (std::size_t b = 0; b < bins; ++b) track.t.push_back(first + (static_cast<double>(b) + 0.5) * width);
    }
    /// Adds a position at the time t, s. Times outside all bins are ignored.
    void add(double t, const Position& at, double weight) {
        const double b = std::floor((t - from) / bin);
        if (!(b >= 0 && b < static_cast<double>(track.t.size()))) return;
        const auto k = static_cast<std::size_t>(b);
        track.weight[k] += weight, track.x[k] += weight * at.x, track.y[k] += weight * at.y;
    }
    CentroidTrack mean() {
        for (std::size_t b = 0; b < track.t.size(); ++b) track.x[b] /= track.weight[b], track.y[b] /= track.weight[b];
        return std::move(track);
    }
};

}  // namespace

Result<std::vector<SheetSpike>> simulate_sheet(const AfferentSheet& sheet, const std::string& afferent, const SheetForce& force,
                                               double sigma) {
    const auto plan = TRY(plan_afferent(afferent));
    const auto set = TRY(instruction_set());
    auto skin = TRY(Skin::make(sheet_innervation(sheet, afferent, plan, force, sigma), {.dt = force.T}, set));
    const std::size_t steps = force.force.front().size();
    std::vector<double> all;
    for (const auto& f : force.force) all.insert(all.end(), f.begin(), f.end());
    std::vector<Spike> spikes;
    ThreadPool pool(1);
    TRY(skin->respond({all.data(), steps}, steps, spikes, pool));
    skin->finish(spikes);
    std::vector<SheetSpike> out;
    for (const auto& s : spikes) out.push_back({(static_cast<double>(s.step) - 1 + s.offset) * force.T, s.afferent_index});
    return out;
}

CentroidTrack centroid_track(const AfferentSheet& sheet, const std::vector<SheetSpike>& spikes, double from, double to, double bin) {
    CentroidSums sums(from, to, bin);
    for (const auto& s : spikes) sums.add(s.time, sheet.position(s.afferent_index), 1);
    return sums.mean();
}

CentroidTrack centroid_track(const SheetForce& force, double from, double to, double bin) {
    CentroidSums sums(from, to, bin);
    for (std::size_t s = 0; s < force.positions.size(); ++s)
        for (std::size_t k = 0; k < force.force[s].size(); ++k) sums.add(force.time(k), force.positions[s], force.force[s][k]);
    return sums.mean();
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    double n = 0, sa = 0, sb = 0, aa = 0, bb = 0, ab = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (std::isfinite(a[k]) && std::isfinite(b[k])) n += 1, sa += a[k], sb += b[k];
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (!std::isfinite(a[k]) || !std::isfinite(b[k])) continue;
        const double x = a[k] - sa / n, y = b[k] - sb / n;
        aa += x * x, bb += y * y, ab += x * y;
    }
    return ab / num::sqrt(aa * bb);
}

}  // namespace corpuscle
