#pragma once
// A skin with its afferents placed: the position and class of each, and the sites in its receptive field.

#include "skin/plan/site_grid.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {

/// One afferent of a skin.
struct SkinAfferent {
    std::uint32_t class_index = 0;  ///< index of its class
    std::uint32_t number = 0;       ///< number within its class, from 1: 17 for "sa1#17"
    std::uint32_t region = 0;       ///< index in Sites::regions
    Position position = {};         ///< m
    double delay = 0;               ///< conduction delay to the recording point, s
    double direction = 0;  ///< preferred direction of shear, rad counter-clockwise from x; unused if its class has no direction gain
};

/// The receptive fields of a class, sorted by site. Entries [begin[s], begin[s + 1]) of `afferent` and `weight` are the afferents that
/// respond to site s, and the weights with which they feel its force. Afferents are counted from 0 at the first one of the class, and are
/// in ascending order for each site. If each hot spot has a receptor of its own, `receptors` is their number per afferent, and `afferent`
/// is that of the afferent times `receptors`, plus the number of the hot spot.
struct ReceptiveFields {
    std::vector<std::size_t> begin;
    std::vector<std::uint32_t> afferent;
    std::vector<double> weight;
    std::uint32_t receptors = 1;
    bool operator==(const ReceptiveFields&) const = default;
};

/// A skin with all its afferents.
struct Innervation {
    SkinPlan plan;
    std::vector<SkinAfferent> afferents;   ///< class by class; neighbours on the skin are close together in the list of a class
    std::vector<std::size_t> class_begin;  ///< index in `afferents` of the first afferent of each class, then their total number
    std::vector<ReceptiveFields> fields;   ///< one element for each class
    std::string afferent_name(std::size_t index) const;  ///< "sa1#17"
};

/// Number of afferents of a class in each region.
std::vector<std::uint64_t> afferents_by_region(const SkinPlan&, std::uint32_t class_index);

/// Places the afferents of a plan and computes their receptive fields. The result for a plan is the same on every machine. A skin without
/// afferents or with more than 2^24 is an error.
Result<std::shared_ptr<const Innervation>> innervate(SkinPlan);

/// Returns an error if a skin needs more memory than this machine has or this process may use (ulimit -v). `sites`, `afferents` and
/// `weights` are (estimated) numbers; a weight is one site in the receptive field of one afferent.
Result<void> check_available_memory(std::string_view name, double sites, double afferents, double weights);

// The two steps of innervate(): it places the afferents of a skin and computes their receptive fields.

/// The afferents of one class, with their positions and delays. If the class has a density, they are listed region by region, and in each
/// region along a Hilbert curve through its sites, so that neighbours on the skin are close together in the list. If the class has
/// `per_site`, they are at the sites, in the order of the sites.
Result<std::vector<SkinAfferent>> place_afferents(const SkinPlan&, std::uint32_t class_index);

/// Element [from * regions + to] is 1 if a receptive field in region `from` may extend into region `to`: if the two regions touch, or
/// are the same. If the sites are separate sensors, all elements are 1.
std::vector<char> touching_regions(const Sites&, const SiteGrid&);

/// The receptive fields of the afferents of one class. `touching` is the result of touching_regions().
Result<ReceptiveFields> receptive_fields_of(const SkinPlan&, std::uint32_t class_index, std::span<const SkinAfferent>, const SiteGrid&,
                                            const std::vector<char>& touching);

/// Identifies the random numbers for one quantity of a class, such as "velocity".
std::uint32_t class_stream(const SkinClass&, std::string_view quantity);

/// Limits of a skin: afferents of all classes; sites in the receptive fields of one class, summed over afferents.
inline constexpr std::size_t max_afferents = std::size_t{1} << 24, max_weights = 200'000'000;

}  // namespace corpuscle
