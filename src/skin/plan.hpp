#pragma once
// What a population file says (doc/skin.md): sites, classes of afferents, and what they feel.

#include <optional>
#include <string_view>

#include "model/spread.hpp"
#include "skin/sites.hpp"

namespace corpuscle {

/// Where a number of a population is from.
struct Sourced {
    std::string of, source;  ///< "density", "Johansson & Vallbo 1979"
};

/// One class of afferents in a skin.
struct SkinClass {
    std::string name;                          ///< what outputs call it: "sa1"
    AfferentPlan afferent;                     ///< about which its units are drawn
    std::vector<double> density = {};          ///< units a m2, of each region; empty: `per_site`
    std::uint32_t per_site = 0;                ///< units at each site
    double sigma = 0;                          ///< of each hot spot of a receptive field, a Gaussian; m. 0: the nearest site alone
    std::uint32_t hot_spots = 1;               ///< of one receptive field
    double hot_spot_spread = 0;                ///< standard deviation of their places about the unit's, each way; m
    double velocity = 0, velocity_spread = 0;  ///< conduction, m/s: mean and standard deviation; 0: spikes are told where they begin
    std::vector<Spread> spreads = {};          ///< how its units differ
    std::vector<Sourced> sources = {};
};

/// A skin before its afferents are placed.
struct SkinPlan {
    std::string name;  ///< "hand", or the file's
    std::string sentence = {};
    Sites sites;
    std::vector<SkinClass> classes;
    std::uint64_t seed = 1;
    /// Where a site stands for an area of skin, its force is a pressure: a unit feels the weighted mean of its field times this area (m2),
    /// so that pressing so much skin evenly with 4 N is felt as 4 N. Else it feels the mean of what its sensors read.
    double felt_area = 0;
    std::vector<Sourced> sources = {};
    /// Afferents by name, each on every channel: a unit is told as its class and its channel's name, without a number.
    bool is_by_channel = false;
    std::optional<Position> nerve = {};  ///< where spikes are listened to: they arrive after (distance to it) / velocity; none: at once
};

/// A population by its name ("hand", "fingertip", "grid 8x8") or file. `channels`: of what it will feel, for a file that says
/// sites = "channels". Errors name file, line and column.
Result<SkinPlan> plan_skin(std::string_view name, std::span<const Channel> channels = {});
/// The same of a file's text.
Result<SkinPlan> read_skin_plan(std::string_view text, const std::string& file, std::span<const Channel> channels = {});

/// The names of those that are built in, with a sentence each.
struct NamedSkin {
    std::string_view name, sentence;
};
std::span<const NamedSkin> named_skins();

}  // namespace corpuscle
