// Computes receptive fields. Each hot spot is a Gaussian over the sites. The weights of all hot spots of an afferent are added. They are
// then scaled so that their sum is 1 or, if the plan has a felt_area, felt_area / (area of a site).

#include <fmt/format.h>
#include <numeric>

#include "core/random.hpp"
#include "skin/placement.hpp"

namespace corpuscle {
namespace {

constexpr double cutoff = 3;  // a hot spot ends at this distance, in standard deviations

/// Rounds to a multiple of 2^-40, about 1e-12, so that sites at equal distances have equal weights in spite of round-off in their
/// positions. Equal fields can then be stored once.
double rounded_to_picounits(double x) {
    constexpr double units = 1099511627776.0;  // 2^40
    return std::floor(x * units + 0.5) / units;
}

/// The receptive fields, afferent after afferent.
struct FieldTable {
    std::vector<std::size_t> end;     ///< for each afferent: one past the index of its last entry in `site` and `weight`
    std::vector<std::uint32_t> site;  ///< a site of a receptive field
    std::vector<double> weight;       ///< the weight of that site's force
};

/// Computes the receptive fields of the afferents of one class.
class FieldsOfClass {
    const SkinPlan& plan_;
    const SkinClass& class_;
    const SiteGrid& grid_;
    const std::vector<char>& touching_;   // result of touching_regions()
    const double per_square_, scale_;     // 1 / (2 sigma^2), 1/m2; sum of an afferent's weights
    const std::uint32_t stream_;          // random stream of the hot spots
    std::vector<double> weights_;         // weight of each site for the current afferent
    std::vector<std::uint32_t> reached_;  // the sites whose weight is not 0
    // Sites within reach of the current hot spot, with their squared distances from it (m2), which are then replaced by weights.
    std::vector<std::pair<std::uint32_t, double>> near_spot_;

    /// Adds the weights of a hot spot at (x, y). It does not reach into regions that do not touch the afferent's region.
    void add_spot(const SkinAfferent& afferent, double x, double y) {
        const char* reaches = touching_.data() + afferent.region * plan_.sites.regions.size();
        near_spot_.clear();
        grid_.for_each_within(x, y, cutoff * class_.sigma, [&](std::uint32_t site, double d2) {
            if (reaches[plan_.sites.region[site]]) near_spot_.emplace_back(site, d2);
        });
        // A separate loop, so that the exponentials overlap in the processor's pipeline.
        for (auto& s : near_spot_) s.second = num::exp(-rounded_to_picounits(s.second * per_square_));
        for (const auto& [site, w] : near_spot_) {
            if (weights_[site] == 0) reached_.push_back(site);
            weights_[site] += w;
        }
    }

    /// Adds the weights of all hot spots of an afferent.
    void add_spots(const SkinAfferent& afferent) {
        if (class_.hot_spots <= 1) return add_spot(afferent, afferent.position.x, afferent.position.y);
        for (std::uint32_t h = 0; h < class_.hot_spots; ++h) {
            const auto [dx, dy] = normal_pair(plan_.seed, afferent.number, stream_, h);
            add_spot(afferent, afferent.position.x + class_.hot_spot_spread * dx, afferent.position.y + class_.hot_spot_spread * dy);
        }
    }

public:
    FieldsOfClass(const SkinPlan& plan, const SkinClass& c, const SiteGrid& grid, const std::vector<char>& touching)
        : plan_(plan), class_(c), grid_(grid), touching_(touching), per_square_(c.sigma > 0 ? 0.5 / (c.sigma * c.sigma) : 0),
          scale_(plan.felt_area > 0 && plan.sites.area > 0 ? plan.felt_area / plan.sites.area : 1), stream_(class_stream(c, "hot spots")),
          weights_(plan.sites.size()) {}

    /// Appends the receptive field of one afferent. It is the nearest site if sigma is 0, or if no site is within reach of a hot spot.
    void add(const SkinAfferent& afferent, FieldTable& out) {
        reached_.clear();
        if (class_.sigma > 0) add_spots(afferent);
        if (reached_.empty()) reached_.push_back(grid_.nearest(afferent.position.x, afferent.position.y)), weights_[reached_[0]] = 1;
        double sum = 0;
        for (const auto s : reached_) sum += weights_[s];
        for (const auto s : reached_) {
            out.site.push_back(s), out.weight.push_back(weights_[s] * (scale_ / sum));
            weights_[s] = 0;
        }
        out.end.push_back(out.site.size());
    }
};

/// The receptive fields of a table, sorted by site.
ReceptiveFields sorted_by_site(const FieldTable& table, std::size_t sites) {
    ReceptiveFields out{std::vector<std::size_t>(sites + 1), std::vector<std::uint32_t>(table.site.size()),
                        std::vector<double>(table.site.size())};
    for (const auto s : table.site) ++out.begin[s + 1];
    std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
    std::vector<std::size_t> next(out.begin.begin(), out.begin.end() - 1);
    for (std::size_t afferent = 0, k = 0; afferent < table.end.size(); ++afferent)
        for (; k < table.end[afferent]; ++k) {
            const auto to = next[table.site[k]]++;
            out.afferent[to] = static_cast<std::uint32_t>(afferent), out.weight[to] = table.weight[k];
        }
    return out;
}

}  // namespace

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

Result<ReceptiveFields> receptive_fields_of(const SkinPlan& plan, std::uint32_t class_index, std::span<const SkinAfferent> afferents,
                                            const SiteGrid& grid, const std::vector<char>& touching) {
    const auto& c = plan.classes[class_index];
    FieldsOfClass fields(plan, c, grid, touching);
    FieldTable table;
    table.end.reserve(afferents.size());
    for (const auto& u : afferents) {
        fields.add(u, table);
        if (table.site.size() > max_weights)
            return bad_input(fmt::format("{}: its receptive fields have more than {} weights in total; use a smaller sigma or fewer sites",
                                         c.name, max_weights));
    }
    return sorted_by_site(table, plan.sites.size());
}

}  // namespace corpuscle
