#pragma once
// The contents of a population file (doc/skin.md): sites, classes of afferents, receptive fields.

#include <optional>
#include <string_view>

#include "model/copies.hpp"
#include "skin/sites.hpp"

namespace corpuscle {

/// The source of a number in a population file.
struct SourceNote {
    std::string quantity, source;  ///< "density", "Johansson & Vallbo 1979"
};

/// One class of afferents in a skin.
struct SkinClass {
    std::string name;                          ///< name in outputs: "sa1"
    AfferentPlan afferent;                     ///< the original: parameters of the class's afferents are sampled around its values
    std::vector<double> density = {};          ///< afferents per m2 in each region; empty: use `per_site`
    std::uint32_t per_site = 0;                ///< afferents at each site
    double sigma = 0;                          ///< standard deviation of a hot spot, a Gaussian; m. 0: only the nearest site
    std::uint32_t hot_spots = 1;               ///< number in one receptive field
    double hot_spot_spread = 0;                ///< m, standard deviation of hot spots around the afferent's position, in x and in y
    double velocity = 0, velocity_spread = 0;  ///< conduction velocity, m/s: mean and standard deviation; 0: no delay
    std::vector<ParameterDistribution> distributions = {};  ///< how the parameters of its afferents vary
    std::vector<SourceNote> sources = {};
};

/// A skin before its afferents are placed.
struct SkinPlan {
    std::string name;  ///< "hand", or the name of the file without its extension
    std::string description = {};
    Sites sites;
    std::vector<SkinClass> classes;
    std::uint64_t seed = 1;
    /// m2. If a site represents an area of skin, an afferent responds to the weighted mean pressure in its receptive field times this area:
    /// if the area is pressed evenly with 4 N, the afferent responds as to 4 N. If felt_area is 0, an afferent responds to the weighted
    /// mean of the forces at its sites.
    double felt_area = 0;
    std::vector<SourceNote> sources = {};
    /// Named afferents, one on every channel. An afferent is then named after its class and channel, without a number.
    bool is_by_channel = false;
    std::optional<Position> nerve = {};  ///< the recording point: spikes arrive after (distance to it) / velocity, or at once if not set
};

/// A population by its name ("hand", "fingertip", "grid 8x8") or file. `channels` are the channels of the force input, for files with
/// sites = "channels". Errors name file, line and column.
Result<SkinPlan> load_skin_plan(std::string_view name, std::span<const Channel> channels = {});
/// The same from the text of a file.
Result<SkinPlan> parse_skin_plan(std::string_view text, const std::string& file, std::span<const Channel> channels = {});

/// Names of the built-in populations, each with a description.
struct NamedSkin {
    std::string_view name, description;
};
std::span<const NamedSkin> named_skins();

}  // namespace corpuscle
