#pragma once
// The plan of a skin, as a population file defines it (doc/skin.md): sites, classes of afferents, and how receptive fields are made.

#include "model/copies.hpp"
#include "skin/plan/sites.hpp"

namespace corpuscle {

/// The published source of a quantity in a population file.
struct SourceNote {
    std::string quantity, source;  ///< "density", "Johansson & Vallbo 1979"
};

/// How the afferents of a class respond to tangential force. Each has a preferred direction phi and feels the force
/// F = sum over its sites of w (F_n + gain (F_x cos phi + F_y sin phi)).
struct DirectionTuning {
    double gain = 0;                  ///< N of normal force for one N of tangential force in the preferred direction
    std::optional<double> mean = {};  ///< mean of the preferred directions, rad; not set: all directions are equally likely
    double spread = 0;                ///< standard deviation of the preferred directions around `mean`, rad
};

/// The contact wave that a class feels besides the force in its receptive fields (skin/wave/contact_wave.hpp).
struct WaveParams {
    double speed = 0;      ///< m/s; 0: the class feels no wave
    double decay = 60e-3;  ///< m; the distance in which the wave falls to 1/e, besides its spreading
    double radius = 5e-3;  ///< m; the wave spreads beyond this distance
    double gain = 1;       ///< force of the wave at its source, relative to the change of force there
    double corner = 20;    ///< Hz; the wave has the changes of force above this frequency
    bool operator==(const WaveParams&) const = default;
};

/// One class of afferents in a skin.
struct SkinClass {
    std::string name;                  ///< name in outputs: "sa1"
    AfferentPlan afferent;             ///< the parameters of the class's afferents are sampled around the values of this one
    std::vector<double> density = {};  ///< afferents per m2 in each of Sites::regions; empty: `per_site` is used
    std::uint32_t per_site = 0;        ///< afferents at each site, if `density` is empty
    double sigma = 0;                  ///< m, standard deviation of a hot spot, if it is a Gaussian
    double depth = 0;     ///< m, depth of the nerve ending if it feels the stress there (depth_kernel.hpp); 0: a Gaussian is used instead.
                          ///< If sigma and depth are 0, the field is only the nearest site
    double surround = 0;  ///< fraction of the mean of the surround that is subtracted, 0 to 1; that of the stress at three times the depth
    std::uint32_t hot_spots = 1;  ///< number of hot spots in one receptive field
    double hot_spot_spread = 0;   ///< m, standard deviation of the hot spots' distance from the afferent, in x and in y
    /// False: one receptor feels the mean force of all hot spots. True: each hot spot has a receptor of its own; the mean of their
    /// currents drives the neuron.
    bool receptor_per_hot_spot = false;
    std::uint32_t receptors() const { return receptor_per_hot_spot ? hot_spots : 1; }  ///< number of receptors of one afferent
    double velocity = 0, velocity_spread = 0;  ///< conduction velocity, m/s: mean and standard deviation over afferents; 0: no delay
    DirectionTuning direction = {};
    WaveParams wave = {};
    std::string afferent_name = {};  ///< the name of its afferent outside a skin, such as "sa1-nerve"; may differ from `name`
    std::vector<ParameterDistribution> distributions = {};  ///< how the parameters of its afferents vary
    std::vector<SourceNote> sources = {};
};

/// A skin before its afferents are placed.
struct SkinPlan {
    std::string name;  ///< "hand": the name of the built-in population, or of the file without its extension
    std::string description = {};
    Sites sites;
    std::vector<SkinClass> classes;
    std::uint64_t seed = 1;  ///< of all random values: positions, parameters, hot spots, velocities
    /// Area in m2. If sites represent an area of skin, the force on an afferent is the weighted mean pressure in its receptive field times
    /// felt_area: if an area of this size is pressed evenly with 4 N, the afferent responds as to 4 N. If felt_area is 0, the force on an
    /// afferent is the weighted mean of the forces at its sites.
    double felt_area = 0;
    std::vector<SourceNote> sources = {};
    /// True for a plan made of named afferents, one on every channel, instead of a population. An afferent is then named after its class
    /// and channel, without a number.
    bool is_by_channel = false;
    std::optional<Position> nerve = {};  ///< the recording point: a spike arrives there after distance / velocity; not set: without delay
};

/// The plan of a population, by its name ("hand", "fingertip", "grid 8x8") or file. `channels` are the channels of the force input, which a
/// file with sites = "channels" needs. Errors name file, line and column.
Result<SkinPlan> load_skin_plan(std::string_view name, std::span<const Channel> channels = {});
/// The plan of a grid or built-in population. Any other name is an error; no file is read.
Result<SkinPlan> load_built_in_skin_plan(std::string_view name);
/// The plan from the text of a population file; `file` is its name for messages.
Result<SkinPlan> parse_skin_plan(std::string_view text, const std::string& file, std::span<const Channel> channels = {});

/// A built-in population.
struct NamedSkin {
    std::string name, description;
};
/// All built-in populations except grids.
std::span<const NamedSkin> named_skins();

/// Applies the overrides whose target is a class of the plan: "sa1.f_B=25Hz" sets the value around which f_B is sampled in the class sa1.
/// A parameter that the class does not have, and a value outside its range, are errors.
Result<Applied<SkinPlan>> apply_overrides(SkinPlan, std::span<const ParameterOverride>);

/// The targets of overrides in a run of this skin: its classes, and `others`.
std::vector<std::string_view> override_targets(const SkinPlan&, std::vector<std::string_view> others = {});

/// Prepares a plan for an indenter, or for taxels: a sensor array that defines no area of its sites is treated as skin. Each site then
/// represents a cell of the lattice of sites. A plan without a `felt_area` gets that of the built-in skins. Returns a note that says so. If
/// the plan defines a felt_area, or if sites without an area are not on a lattice, nothing is changed, and the result is "".
std::string treat_as_skin(SkinPlan&);

inline constexpr double default_felt_area = 1e-4;  ///< m2, as in the built-in skins

}  // namespace corpuscle
