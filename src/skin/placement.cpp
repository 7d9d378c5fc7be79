#include "skin/innervation.hpp"

#include <fmt/format.h>
#include <numbers>

#include "core/random.hpp"

namespace corpuscle {
namespace {

/// The position of cell (x, y) along a Hilbert curve through 2^16 x 2^16 cells.
std::uint32_t along_curve(std::uint32_t x, std::uint32_t y) {
    std::uint32_t d = 0;
    for (std::uint32_t side = 1U << 15; side > 0; side >>= 1) {
        const std::uint32_t right = (x & side) > 0, up = (y & side) > 0;
        d += side * side * ((3 * right) ^ up);
        if (up == 0) {  // rotates the quadrant, so that the quadrants connect
            if (right == 1) x = 0xffff - x, y = 0xffff - y;
            std::swap(x, y);
        }
    }
    return d;
}

/// The sites of each region, in the order of a Hilbert curve through all sites.
std::vector<std::vector<std::uint32_t>> sites_along(const Sites& sites) {
    double left = sites.positions[0].x, low = sites.positions[0].y, extent = 0;
    for (const auto& p : sites.positions) left = std::min(left, p.x), low = std::min(low, p.y);
    for (const auto& p : sites.positions) extent = std::max({extent, p.x - left, p.y - low});
    const double scale = extent > 0 ? 65535 / extent : 0;
    std::vector<std::uint64_t> keys(sites.size());  // position along the curve in the upper 32 bits, site in the lower
    for (std::size_t s = 0; s < sites.size(); ++s) {
        const auto cell = [&](double from) { return static_cast<std::uint32_t>(from * scale); };
        keys[s] = std::uint64_t{along_curve(cell(sites.positions[s].x - left), cell(sites.positions[s].y - low))} << 32 | s;
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::vector<std::uint32_t>> out(sites.regions.size());
    for (const auto key : keys) out[sites.region[key & 0xffffffff]].push_back(static_cast<std::uint32_t>(key));
    return out;
}

/// Two random numbers in (0, 1) for afferent `number` of a class: draw number `draw` from random stream `stream`.
std::pair<double, double> two_random(std::uint64_t seed, std::uint32_t stream, std::uint32_t number, std::uint32_t draw) {
    const auto w = philox({draw, 0, number, stream}, seed);
    return {unit_interval(w[0], w[1]), unit_interval(w[2], w[3])};
}

Error too_many(const SkinClass& c, double afferents) {
    return bad_input(fmt::format("{}: {:.6g} afferents are more than the {} that one skin may have", c.name, afferents, max_afferents));
}

/// Places `per_site` afferents at each site.
void place_on_sites(const Sites& sites, const SkinClass& c, std::uint32_t class_index, std::vector<SkinAfferent>& out) {
    for (std::size_t s = 0; s < sites.size(); ++s)
        for (std::uint32_t k = 0; k < c.per_site; ++k)
            out.push_back({class_index, static_cast<std::uint32_t>(out.size()) + 1, sites.region[s], sites.positions[s], 0});
}

/// Places `afferents` afferents of one region: one in each of as many equal sections of the list of its sites (`along`), at a random site
/// of that section and a random position in the site's cell. `afferent` has the class and the region; its other members are set here.
void place_in_region(const SkinPlan& plan, const std::vector<std::uint32_t>& along, std::size_t afferents, SkinAfferent afferent,
                     std::vector<SkinAfferent>& out) {
    const auto stream = class_stream(plan.classes[afferent.class_index], "place");
    const double side = num::sqrt(plan.sites.area), sites_per_afferent = static_cast<double>(along.size()) / static_cast<double>(afferents);
    for (std::size_t k = 0; k < afferents; ++k) {
        afferent.number = static_cast<std::uint32_t>(out.size()) + 1;
        // Position in the list of sites.
        const double where = (static_cast<double>(k) + two_random(plan.seed, stream, afferent.number, 0).first) * sites_per_afferent;
        const auto& site = plan.sites.positions[along[std::min(static_cast<std::size_t>(where), along.size() - 1)]];
        const auto [x, y] = two_random(plan.seed, stream, afferent.number, 1);
        afferent.position = {site.x + (x - 0.5) * side, site.y + (y - 0.5) * side, site.z};
        out.push_back(afferent);
    }
}

/// Sets the conduction delays of a class's afferents, each with a random velocity.
void set_delays(const SkinPlan& plan, const SkinClass& c, std::vector<SkinAfferent>& afferents) {
    if (!plan.nerve || !(c.velocity > 0)) return;
    const auto stream = class_stream(c, "velocity");
    for (auto& u : afferents) {
        double velocity = c.velocity;
        for (std::uint64_t sample = 0; c.velocity_spread > 0 && sample < 100; ++sample) {
            const double v = c.velocity + c.velocity_spread * normal(plan.seed, u.number, stream, sample);
            if (v < 0.25 * c.velocity || v > 4 * c.velocity) continue;  // too extreme for an axon of this class; drawn again
            velocity = v;
            break;
        }
        const double dx = u.position.x - plan.nerve->x, dy = u.position.y - plan.nerve->y;
        u.delay = num::sqrt(dx * dx + dy * dy) / velocity;
    }
}

/// Sets the preferred directions of shear of a class's afferents.
void set_directions(const SkinPlan& plan, const SkinClass& c, std::vector<SkinAfferent>& afferents) {
    const auto& tuning = c.direction;
    if (tuning.gain == 0) return;
    const auto stream = class_stream(c, "direction");
    for (auto& u : afferents)
        u.direction = tuning.mean ? *tuning.mean + tuning.spread * normal(plan.seed, u.number, stream, 0)
                                  : two_random(plan.seed, stream, u.number, 0).first * 2 * std::numbers::pi;
}

}  // namespace

std::uint32_t class_stream(const SkinClass& c, std::string_view quantity) {
    return static_cast<std::uint32_t>(stream_id(fmt::format("skin.{}.{}", c.name, quantity)));
}

std::vector<std::uint64_t> afferents_by_region(const SkinPlan& plan, std::uint32_t class_index) {
    const auto& c = plan.classes[class_index];
    std::vector<std::uint64_t> counts(plan.sites.regions.size());  // of each region: first its sites, then its afferents
    for (const auto r : plan.sites.region) ++counts[r];
    for (std::size_t r = 0; r < counts.size(); ++r) {
        const double n = static_cast<double>(counts[r]),
                     afferents = c.density.empty() ? n * c.per_site : c.density[r] * plan.sites.area * n;
        counts[r] = static_cast<std::uint64_t>(std::round(std::clamp(afferents, 0.0, 1e15)));
    }
    return counts;
}

Result<std::vector<SkinAfferent>> place_afferents(const SkinPlan& plan, std::uint32_t class_index) {
    const auto& c = plan.classes[class_index];
    const auto counts = afferents_by_region(plan, class_index);
    double all = 0;
    for (const auto n : counts) all += static_cast<double>(n);
    if (!(all <= static_cast<double>(max_afferents))) return too_many(c, all);
    std::vector<SkinAfferent> out;
    out.reserve(static_cast<std::size_t>(all));
    if (c.density.empty()) {
        place_on_sites(plan.sites, c, class_index, out);
    } else {
        const auto along = sites_along(plan.sites);
        for (std::uint32_t r = 0; r < along.size(); ++r) place_in_region(plan, along[r], counts[r], {class_index, 0, r}, out);
    }
    set_delays(plan, c, out);
    set_directions(plan, c, out);
    return out;
}

std::vector<char> touching_regions(const Sites& sites, const SiteGrid& grid) {
    const std::size_t n = sites.regions.size();
    if (!(sites.area > 0)) return std::vector<char>(n * n, 1);
    std::vector<char> out(n * n, 0);
    for (std::size_t r = 0; r < n; ++r) out[r * n + r] = 1;
    if (n == 1) return out;
    const double reach = 1.5 * num::sqrt(sites.area);  // m; includes the diagonal neighbours of a site
    for (std::size_t s = 0; s < sites.size(); ++s)
        grid.for_each_within(sites.positions[s].x, sites.positions[s].y, reach,
                             [&](std::uint32_t other, double) { out[sites.region[s] * n + sites.region[other]] = 1; });
    return out;
}

}  // namespace corpuscle
