#pragma once
// Copies of one afferent whose parameters vary: each value is sampled from a distribution around the original's value (doc/populations.md).

#include "model/catalog.hpp"

namespace corpuscle {

/// The normal distribution of one parameter over the copies; its mean is the value of the original afferent.
struct ParameterDistribution {
    std::string afferent;  ///< AfferentPlan::name
    std::string_view parameter, unit;
    double deviation = 0;                 ///< standard deviation, SI
    std::optional<double> fraction = {};  ///< deviation over the mean, if it was given as a percentage: 0.1 for "10%"
    bool operator==(const ParameterDistribution&) const = default;
};

/// The requested copies: how many of each afferent, and how their parameters vary.
struct CopySpec {
    std::uint32_t count = 0;  ///< 0: only the afferents themselves
    std::vector<ParameterDistribution> distributions;
};

inline constexpr std::uint32_t max_copies = 1'000'000;

/// Selects the overrides of --spread that belong to this plan ("sa1.f_B=10%", "sa1.f_B=2Hz"), which was requested as `requested`, and marks
/// them used. Refuses a parameter that all copies share, an integer, a percentage of 0, and the same parameter twice.
Result<std::vector<ParameterDistribution>> distributions_for(const AfferentPlan&, std::string_view requested,
                                                             std::span<const ParameterOverride> overrides);

/// Copies 1 to n of a plan, each with its own values. A value depends only on the seed, the names of afferent and parameter, and the number
/// of the copy. A value outside the parameter's range is sampled again, and so are the parameters of a violated order constraint.
Result<std::vector<AfferentPlan>> make_copies(const AfferentPlan&, std::uint32_t n, std::span<const ParameterDistribution>,
                                              std::uint64_t seed);

/// Index of the first copy of each afferent, then the total. An afferent without copies counts as a single copy.
std::vector<std::size_t> copy_group_starts(std::span<const AfferentPlan>);

/// The name of an afferent in outputs; for a copy, the name of the original.
const std::string& base_name(const AfferentPlan&);

}  // namespace corpuscle
