#include "skin/innervation.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <cmath>

namespace corpuscle {
namespace {

/// Checks the sites and densities of a plan. A plan read from a file is already valid; one built by a program may not be.
Result<void> check_sites(const SkinPlan& plan) {
    const auto& s = plan.sites;
    if (s.positions.empty() || s.names.size() != s.size() || s.region.size() != s.size() || s.regions.empty() || s.size() > max_sites)
        return bad_input(fmt::format("{}: a skin needs sites, each with a name and a region ({} sites)", plan.name, s.size()));
    for (const auto& p : s.positions)
        if (!(std::abs(p.x) <= 1e3 && std::abs(p.y) <= 1e3))
            return bad_input(
                fmt::format("{}: a site at ({:g}, {:g}) m is too far away: coordinates must be within 1,000 m", plan.name, p.x, p.y));
    for (const auto r : s.region)
        if (r >= s.regions.size())
            return bad_input(fmt::format("{}: a site is in region {}, but there are {} regions", plan.name, r, s.regions.size()));
    for (const auto& c : plan.classes) {
        if (!c.density.empty() && c.density.size() != s.regions.size())
            return bad_input(fmt::format("{}: {} densities for {} regions; give one for each", c.name, c.density.size(), s.regions.size()));
        if (!c.density.empty() && !(s.area > 0))
            return bad_input(fmt::format("{}: a density needs sites that represent an area of skin", c.name));
    }
    return {};
}

/// Estimates the memory that the skin needs, before any afferent is placed, and checks that it is available.
Result<void> check_skin_memory(const SkinPlan& plan) {
    double left = plan.sites.positions[0].x, right = left, low = plan.sites.positions[0].y, high = low;
    for (const auto& p : plan.sites.positions)
        left = std::min(left, p.x), right = std::max(right, p.x), low = std::min(low, p.y), high = std::max(high, p.y);
    const auto sites = static_cast<double>(plan.sites.size());
    const double site_area = plan.sites.area > 0 ? plan.sites.area : std::max((right - left) * (high - low) / sites, 1e-12);
    double afferents = 0, weights = 0;
    for (std::uint32_t c = 0; c < plan.classes.size(); ++c) {
        const auto& k = plan.classes[c];
        double all = 0;
        for (const auto n : afferents_by_region(plan, c)) all += static_cast<double>(n);
        // m; radius that contains most of the receptive field of a receptor
        const double spread = k.hot_spots > 1 && !k.receptor_per_hot_spot ? k.hot_spot_spread : 0,
                     reach = 3 * k.sigma + (k.surround > 0 ? 8 : 4) * k.depth + spread;
        afferents += all, weights += all * k.receptors() * std::clamp(3 * reach * reach / site_area, 1.0, sites);  // 3: about pi
    }
    return check_available_memory(plan.name, sites, afferents, weights);
}

}  // namespace

std::string Innervation::afferent_name(std::size_t index) const {
    const auto& u = afferents[index];
    return fmt::format("{}#{}", plan.classes[u.class_index].name, u.number);
}

Result<std::shared_ptr<const Innervation>> innervate(SkinPlan plan) {
    TRY(check_sites(plan));
    TRY(check_skin_memory(plan));
    auto out = std::make_shared<Innervation>();
    out->plan = std::move(plan);
    const auto& p = out->plan;
    const SiteGrid grid(p.sites.positions);
    const auto touching = touching_regions(p.sites, grid);
    out->class_begin.push_back(0);
    for (std::uint32_t c = 0; c < p.classes.size(); ++c) {
        const auto afferents = TRY(place_afferents(p, c));
        auto fields = TRY(receptive_fields_of(p, c, afferents, grid, touching));
        out->afferents.insert(out->afferents.end(), afferents.begin(), afferents.end());
        out->fields.push_back(std::move(fields));
        out->class_begin.push_back(out->afferents.size());
        if (out->afferents.size() > max_afferents) return bad_input(fmt::format("{}: more than {} afferents", p.name, max_afferents));
    }
    if (out->afferents.empty()) return bad_input(fmt::format("{}: there are no afferents; raise a density, or add a class", p.name));
    return std::shared_ptr<const Innervation>(std::move(out));
}

namespace {

// Measured on grids and on the hand, with 20 thousand to 3 million afferents.
constexpr double bytes_per_site = 1600, bytes_per_afferent = 1600, bytes_per_weight = 60;

/// The memory that a skin may use on this machine in this process.
double available_bytes() {
    constexpr double fraction = 0.8;  // of the machine's memory; other programs need some
    double max_bytes = fraction * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
    struct ::rlimit limit = {};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        max_bytes = std::min(max_bytes, static_cast<double>(limit.rlim_cur));
    return max_bytes;
}

}  // namespace

Result<void> check_available_memory(std::string_view name, double sites, double afferents, double weights) {
    const double needed = sites * bytes_per_site + afferents * bytes_per_afferent + weights * bytes_per_weight,
                 max_bytes = available_bytes();
    if (needed <= max_bytes) return {};
    return bad_input(
        fmt::format("{}: {:.0f} sites and {:.0f} afferents need about {:.3g} GB of memory, but only {:.3g} GB are available; use "
                    "fewer sites",
                    name, sites, afferents, needed * 1e-9, max_bytes * 1e-9));
}

}  // namespace corpuscle
