// Computes the receptive fields of the afferents of one class.

#include <fmt/format.h>
#include <numeric>

#include "core/random.hpp"
#include "skin/contact/skin_cells.hpp"
#include "skin/depth_kernel.hpp"
#include "skin/innervation.hpp"
#include "skin/lanes/kernel.hpp"

namespace corpuscle {
namespace {

constexpr double cutoff = 3;                         // a Gaussian hot spot ends at this distance, in standard deviations
constexpr double surround_depth = 3;                 // depth at which the surround is felt, in depths of the class; choice
constexpr double surround_cutoff = 0.05;             // the fraction of the surround that is left out
constexpr double centre_cutoff = 0.01;               // the same for the stress at the depth of the class
constexpr std::size_t max_expected_sites = 1 << 22;  // for which memory is reserved at once

/// Rounds to a multiple of 2^-40, about 1e-12, so that sites at equal distances have equal weights in spite of round-off in their
/// positions. Equal fields can then be stored once.
double rounded_to_picounits(double x) {
    constexpr double units = 1099511627776.0;  // 2^40
    return std::floor(x * units + 0.5) / units;
}

/// The receptive fields, receptor after receptor.
struct FieldTable {
    std::vector<std::size_t> end;     ///< for each receptor: one past the index of its last entry in `site` and `weight`
    std::vector<std::uint32_t> site;  ///< a site of a receptive field
    std::vector<double> weight;       ///< the weight of that site's force
};

/// Weights of sites for one receptor. Those of all its hot spots are added.
class SiteWeights {
    std::vector<double> weights_;         // of each site
    std::vector<std::uint32_t> reached_;  // the sites whose weight is not 0

public:
    explicit SiteWeights(std::size_t sites) : weights_(sites) {}
    std::span<const std::uint32_t> reached() const { return reached_; }
    double operator[](std::uint32_t site) const { return weights_[site]; }
    void add(std::uint32_t site, double weight) {
        if (weights_[site] == 0 && weight != 0) reached_.push_back(site);
        weights_[site] += weight;
    }
    double sum() const {
        double sum = 0;
        for (const auto s : reached_) sum += weights_[s];
        return sum;
    }
    void clear() {
        for (const auto s : reached_) weights_[s] = 0;
        reached_.clear();
    }
};

/// Computes the receptive fields of the afferents of one class. Each hot spot is a Gaussian over the sites, or the stress at a depth. The
/// weights of all hot spots of a receptor are added. They are then scaled so that their sum is 1 or, if the plan has a felt_area,
/// felt_area / (area of a site). Those of the surround are scaled in the same way, and this fraction of them is subtracted.
class FieldsOfClass {
    const SkinPlan& plan_;
    const SkinClass& class_;
    const SiteGrid& grid_;
    const std::vector<char>& touching_;         // result of touching_regions()
    const double per_square_, scale_;           // 1 / (2 sigma^2), 1/m2; sum of a receptor's weights
    const std::uint32_t stream_;                // random stream of the hot spots
    SiteWeights weights_, surround_;            // for the current receptor
    const DepthKernel centre_, wide_;           // of the class and of the surround, if the class has a depth
    double centre_reach_ = 0, wide_reach_ = 0;  // m, of these kernels
    std::optional<SkinCells> cells_;            // if the class has a depth
    const lanes::FieldKernels& lanes_;
    std::vector<double> edges_;             // y of the edges of a column of cells, m, from the hot spot
    std::vector<double> corners_, before_;  // integrals of a kernel at the corners of a column of cells, and at those of the column before
    // Sites within reach of the current hot spot, with their squared distances from it (m2), which are then replaced by weights.
    std::vector<std::pair<std::uint32_t, double>> near_spot_;

    /// True if the afferent may respond to the site: no field reaches into regions that do not touch the afferent's region.
    bool may_feel(const SkinAfferent& afferent, std::uint32_t site) const {
        return touching_[afferent.region * plan_.sites.regions.size() + plan_.sites.region[site]] != 0;
    }

    /// Adds the weights of a Gaussian hot spot at (x, y).
    void add_gaussian(const SkinAfferent& afferent, double x, double y) {
        near_spot_.clear();
        grid_.for_each_within(x, y, cutoff * class_.sigma, [&](std::uint32_t site, double d2) {
            if (may_feel(afferent, site)) near_spot_.emplace_back(site, d2);
        });
        // A separate loop, so that the exponentials overlap in the processor's pipeline.
        for (auto& s : near_spot_) s.second = num::exp(-rounded_to_picounits(s.second * per_square_));
        for (const auto& [site, w] : near_spot_) weights_.add(site, w);
    }

    /// Adds to `to` the weights of a hot spot at (x, y) that feels the stress at a depth: the integral of the kernel over the cell of each
    /// site, up to cells at the distance `reach` in x and in y.
    void add_stress(const SkinAfferent& afferent, double x, double y, const DepthKernel& kernel, double reach, SiteWeights& to) {
        double end = -INFINITY;  // of the column before, m; columns that follow each other share corners
        cells_->for_each_column(x, y, reach, reach, [&](double left, auto edges, auto sites) {
            const auto compute = [&](double edge, std::vector<double>& corners) {
                corners.resize(edges_.size());
                lanes_.stress_corners(kernel.depth(), edge - x, edges_.data(), edges_.size(), corners.data());
            };
            if (cells_->is_lattice() && end != -INFINITY) {
                std::swap(before_, corners_);
            } else {
                edges_.assign(edges.begin(), edges.end());
                for (double& at : edges_) at -= y;
                compute(left, before_);
            }
            compute(end = left + cells_->side(), corners_);
            for (std::size_t k = 0; k < sites.size(); ++k)
                if (sites[k] != SkinCells::no_site && may_feel(afferent, sites[k]))
                    to.add(sites[k], rounded_to_picounits((corners_[k + 1] - corners_[k]) - (before_[k + 1] - before_[k])));
        });
    }

    /// Adds the weights of the hot spot at (x, y), and of its surround.
    void add_spot(const SkinAfferent& afferent, double x, double y) {
        if (!cells_) return add_gaussian(afferent, x, y);
        add_stress(afferent, x, y, centre_, centre_reach_, weights_);
        if (class_.surround > 0) add_stress(afferent, x, y, wide_, wide_reach_, surround_);
    }

    /// The position of hot spot `number` of an afferent. A single hot spot is at the afferent.
    Position spot_position(const SkinAfferent& afferent, std::uint32_t number) const {
        if (class_.hot_spots <= 1) return afferent.position;
        const auto [dx, dy] = normal_pair(plan_.seed, afferent.number, stream_, number);
        return {afferent.position.x + class_.hot_spot_spread * dx, afferent.position.y + class_.hot_spot_spread * dy};
    }

    /// Appends the field of a receptor whose weights have been added. It is the site nearest to `at` if no site is within reach.
    void append(const Position& at, FieldTable& out) {
        if (weights_.reached().empty()) weights_.add(grid_.nearest(at.x, at.y), 1), surround_.clear();
        const double scale = scale_ / weights_.sum();
        const double surround = surround_.reached().empty() ? 0 : class_.surround * scale_ / surround_.sum();
        for (const auto s : weights_.reached()) out.site.push_back(s), out.weight.push_back(weights_[s] * scale - surround_[s] * surround);
        for (const auto s : surround_.reached())
            if (weights_[s] == 0) out.site.push_back(s), out.weight.push_back(-surround_[s] * surround);
        weights_.clear(), surround_.clear();
        out.end.push_back(out.site.size());
    }

public:
    FieldsOfClass(const SkinPlan& plan, const SkinClass& c, const SiteGrid& grid, const std::vector<char>& touching, InstructionSet set)
        : plan_(plan), class_(c), grid_(grid), touching_(touching), per_square_(c.sigma > 0 ? 0.5 / (c.sigma * c.sigma) : 0),
          scale_(plan.felt_area > 0 && plan.sites.area > 0 ? plan.felt_area / plan.sites.area : 1), stream_(class_stream(c, "hot spots")),
          weights_(plan.sites.size()), surround_(plan.sites.size()), centre_(c.depth), wide_(surround_depth * c.depth),
          lanes_(lanes::field_kernels(set)) {
        if (!(c.depth > 0)) return;
        cells_.emplace(plan.sites);
        centre_reach_ = centre_.reach(centre_cutoff), wide_reach_ = wide_.reach(surround_cutoff);
    }

    /// About the number of sites in the receptive fields of one afferent, usually an upper bound.
    std::size_t expected_sites() const {
        const double sites = static_cast<double>(plan_.sites.size()), spots = std::max(class_.hot_spots, 1U);
        if (!cells_) return class_.receptors();
        const double side = 2 * (std::max(centre_reach_, class_.surround > 0 ? wide_reach_ : 0) / cells_->side() + 1);
        return static_cast<std::size_t>(std::min(spots * side * side, class_.receptors() * sites));
    }

    /// Appends the receptive fields of one afferent: one, or one for each hot spot.
    void add(const SkinAfferent& afferent, FieldTable& out) {
        const bool has_spots = class_.sigma > 0 || class_.depth > 0;
        for (std::uint32_t h = 0; has_spots && h < std::max(class_.hot_spots, 1U); ++h) {
            const auto at = spot_position(afferent, h);
            add_spot(afferent, at.x, at.y);
            if (class_.receptor_per_hot_spot) append(at, out);
        }
        if (!class_.receptor_per_hot_spot) append(afferent.position, out);
    }
};

/// The receptive fields of a table, sorted by site. `receptors`: of one afferent.
ReceptiveFields sorted_by_site(const FieldTable& table, std::size_t sites, std::uint32_t receptors) {
    ReceptiveFields out{std::vector<std::size_t>(sites + 1), std::vector<std::uint32_t>(table.site.size()),
                        std::vector<double>(table.site.size()), receptors};
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

Result<ReceptiveFields> receptive_fields_of(const SkinPlan& plan, std::uint32_t class_index, std::span<const SkinAfferent> afferents,
                                            const SiteGrid& grid, const std::vector<char>& touching) {
    const auto& c = plan.classes[class_index];
    FieldsOfClass fields(plan, c, grid, touching, TRY(instruction_set()));
    FieldTable table;
    table.end.reserve(afferents.size() * c.receptors());
    // Growing arrays would be copied, and take new pages of memory each time.
    const auto expected = std::min(afferents.size() * fields.expected_sites(), max_expected_sites);
    table.site.reserve(expected), table.weight.reserve(expected);
    for (const auto& u : afferents) {
        fields.add(u, table);
        if (table.site.size() > max_weights)
            return bad_input(
                fmt::format("{}: its receptive fields have more than {} weights in total; use a smaller sigma or depth, or fewer sites",
                            c.name, max_weights));
    }
    return sorted_by_site(table, plan.sites.size(), c.receptors());
}

}  // namespace corpuscle
