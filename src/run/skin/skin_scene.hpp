#pragma once
// A skin and what touches it: the population is placed, and the force is directed at its sites.

#include "run/skin/skin_force.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {

/// A population and the touch on it. Names and texts are those of the command line.
struct SkinSceneRequest {
    std::string population;
    std::string contact = {};           ///< the indenter; "": not given
    std::string taxels = {};            ///< path of a layout of taxels; "": the channels are not those of taxels
    bool has_layout = false;            ///< the recording was opened with a layout of its sensors
    const NamedTouch* touch = nullptr;  ///< null: none
    std::span<const ParameterOverride> overrides = {};
    std::uint64_t seed = 0;  ///< 0: that of the population
};

struct SkinScene {
    std::shared_ptr<const Innervation> innervation = {};
    std::unique_ptr<Contact> contact = {};  ///< null: each channel is the force at one site, or on one taxel
    std::unique_ptr<SkinForce> force = {};
    std::vector<std::string> notes = {};           ///< for the user
    std::vector<ParameterOverride> unused = {};    ///< of the overrides

    /// The force must outlive the scene.
    static Result<SkinScene> make(const SkinSceneRequest&, ForceSource&);
};

/// Adds the settings of a touch as overrides. Those that are already there take precedence.
void add_touch_overrides(std::vector<ParameterOverride>&, const NamedTouch&);

}  // namespace corpuscle
