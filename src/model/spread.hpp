#pragma once
// A population: copies of one afferent whose parameters differ, each drawn about the afferent's own (doc/populations.md).

#include "model/catalog.hpp"

namespace corpuscle {

/// How one parameter differs from copy to copy: normally about the afferent's own value.
struct Spread {
    std::string afferent;  ///< its own name
    std::string_view parameter, unit;
    double deviation = 0;              ///< standard deviation, SI
    std::optional<double> share = {};  ///< of the value, if it was said so: 0.1 of "10%"
    bool operator==(const Spread&) const = default;
};

/// What was asked for: how many copies of each afferent, and how they differ.
struct Copies {
    std::uint32_t copies = 0;  ///< 0: the afferents themselves
    std::vector<Spread> spreads;
};

inline constexpr std::uint32_t most_copies = 1'000'000;

/// The spreads among `wishes` that are for this plan ("sa1.f_B=10%", "sa1.f_B=2Hz"), which was asked for as `asked`; marks them used.
/// Refuses what copies share, a whole number, a share of nothing, and the same parameter twice.
Result<std::vector<Spread>> spreads_for(const AfferentPlan&, std::string_view asked, std::span<const Wish> wishes);

/// Copies 1 to n of a plan, each with values of its own. A value depends on the seed, the names of afferent and parameter and the
/// copy's number. One outside its row's range is drawn again, and where an order is broken the parameters that it binds are.
Result<std::vector<AfferentPlan>> copies_of(const AfferentPlan&, std::uint32_t n, std::span<const Spread>, std::uint64_t seed);

/// Where each afferent's copies begin, and behind the last the end; one that has no copies stands alone.
std::vector<std::size_t> groups_of(std::span<const AfferentPlan>);

/// What outputs call an afferent: copies by what they are copies of.
const std::string& base_name(const AfferentPlan&);

}  // namespace corpuscle
