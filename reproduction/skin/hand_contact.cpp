#include "reproduction/skin/hand_contact.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/median.hpp"
#include "skin/contact/contact.hpp"

namespace corpuscle {
namespace {

constexpr double before_contact = 50e-3;  // s

Result<Position> middle_of(const Sites& sites, const std::string& region) {
    Position sum;
    double n = 0;
    for (std::size_t s = 0; s < sites.size(); ++s)
        if (sites.regions[sites.region[s]] == region) sum.x += sites.positions[s].x, sum.y += sites.positions[s].y, n += 1;
    if (n == 0) return bad_input(fmt::format("the skin has no region '{}'", region));
    return Position{sum.x / n, sum.y / n, 0};
}

/// Afferents of one kind, and the latencies of those that fire, s.
struct Counted {
    std::size_t all = 0;
    std::vector<double> latencies = {};

    void add(const SpikeTimes& train) {
        ++all;
        const auto first = std::lower_bound(train.begin(), train.end(), before_contact);
        if (first != train.end() && *first < before_contact + contact_felt_within) latencies.push_back(*first - before_contact);
    }
    double fraction() const { return static_cast<double>(latencies.size()) / static_cast<double>(all); }
    double latency() { return latencies.empty() ? std::numeric_limits<double>::quiet_NaN() : median_of(latencies); }
};

/// The settings of a touch with a name, such as "texture".
std::vector<std::string> settings_of(const NamedTouch& touch) {
    std::vector<std::string> out;
    for (const auto& s : touch.settings) out.push_back(fmt::format("contact.{}={}", s.name, s.value));
    for (const auto& s : touch.force_settings) out.push_back(fmt::format("{}.{}={}", touch.force, s.name, s.value));
    return out;
}

}  // namespace

Result<ContactResponse> measure_contact(const std::shared_ptr<const Innervation>& hand, const std::string& region, double force) {
    const auto at = TRY(middle_of(hand->plan.sites, region));
    const auto trains =
        TRY(simulate_touch(hand, {"ramp-hold",
                                  "sphere",
                                  {fmt::format("ramp-hold.F_max={}", force), fmt::format("ramp-hold.t_rest={}", before_contact),
                                   fmt::format("ramp-hold.t_up={}", contact_rise), "ramp-hold.t_hold=0.1", "ramp-hold.t_down=0",
                                   "ramp-hold.t_post=0", fmt::format("contact.x={}", at.x), fmt::format("contact.y={}", at.y)},
                                  5e3}));
    Counted fa1_under, fa2_near, fa2_hand;
    for (std::size_t u = 0; u < trains.size(); ++u) {
        const auto& afferent = hand->afferents[u];
        const auto& name = hand->plan.classes[afferent.class_index].name;
        const double distance = std::hypot(afferent.position.x - at.x, afferent.position.y - at.y);
        if (name == "fa1" && distance <= contact_under) fa1_under.add(trains[u]);
        if (name == "fa2" && distance <= contact_near_radius) fa2_near.add(trains[u]);
        if (name == "fa2") fa2_hand.add(trains[u]);
    }
    return ContactResponse{fa1_under.fraction(), fa2_near.fraction(), fa2_hand.fraction(), fa1_under.latency(),
                           fa2_near.latency(),   fa1_under.all,       fa2_near.all};
}

Result<std::vector<SlidingResponse>> measure_sliding(const std::shared_ptr<const Innervation>& hand, double roughness) {
    const auto touches = named_touches();
    const auto& texture = *std::find_if(touches.begin(), touches.end(), [](const auto& t) { return t.name == "texture"; });
    auto settings = settings_of(texture);
    settings.push_back(fmt::format("contact.roughness={}", roughness));
    const auto trains = TRY(simulate_touch(hand, {std::string(texture.force), std::string(texture.indenter), std::move(settings), 2e3}));
    constexpr double begin = 0.2, end = 1.7, bin = 20e-3;  // s: the movement takes 1.58 s from 0.2 s on
    std::vector<SlidingResponse> out;
    for (const auto& c : hand->plan.classes) out.push_back({.afferent = c.name});
    std::vector<std::vector<double>> bins(out.size(), std::vector<double>(static_cast<std::size_t>((end - begin) / bin)));
    for (std::size_t u = 0; u < trains.size(); ++u)
        for (const double t : trains[u]) {
            const auto k = static_cast<std::size_t>(std::max(0.0, (t - begin) / bin));
            if (t >= begin && k < bins.front().size()) bins[hand->afferents[u].class_index][k] += 1;
        }
    for (std::size_t c = 0; c < out.size(); ++c) {
        for (const double n : bins[c]) out[c].spikes += n;
        out[c].rate = out[c].spikes / (end - begin) / static_cast<double>(hand->class_begin[c + 1] - hand->class_begin[c]);
        out[c].silent_fraction = static_cast<double>(std::count(bins[c].begin(), bins[c].end(), 0.0)) / static_cast<double>(bins[c].size());
    }
    return out;
}

}  // namespace corpuscle
