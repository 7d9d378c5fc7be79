#pragma once
// Touch of a skin by an indenter. The indenter rests or moves on the skin; the force with which it presses is distributed over the sites.

#include "skin/skin.hpp"

namespace corpuscle {

/// A block of force on an indenter.
struct ContactForce {
    std::span<const double> force;  ///< N, normal to the skin
    std::int64_t first = 0;         ///< number of the first sample on the clock
    /// Tangential force on the skin along x and y, N, which is spread like the normal force; empty: none. A contact with a tilted force or
    /// friction of its own refuses it.
    std::span<const double> shear_x = {}, shear_y = {};
    /// The position of the indenter in each sample, m, instead of that of its path; empty: the path.
    std::span<const double> x = {}, y = {};
};

/// The contact at the last sample of force.
struct ContactState {
    double size = 0;     ///< m: the radius of a round contact, half the width of an edge's; 0: no contact
    double on_skin = 0;  ///< the fraction of the force that is on the skin
};

/// An indenter with its parameters (settings "contact.radius" ...) and its path over the skin.
class Contact {
public:
    virtual ~Contact() = default;
    virtual std::string description() const = 0;              ///< "a sphere of 5 mm pressed at (12, 160) mm"
    virtual std::vector<MetadataEntry> metadata() const = 0;  ///< the parameters that this contact uses, with their values
    virtual std::vector<std::string> notes() const = 0;  ///< limitations of the model, and which part of the force so far was off the skin
    virtual ContactState state() const = 0;
    /// The force at the sites. In the result, the sum over all sites is the force on the indenter, except for the part off the skin and the
    /// vibration by the texture of a sliding surface, which changes no mean over time. It is valid until the next call.
    virtual Result<SiteForce> press(const ContactForce&) = 0;
    Result<SiteForce> press(std::span<const double> force, std::int64_t first, std::span<const double> shear_x = {},
                            std::span<const double> shear_y = {}) {
        return press(ContactForce{force, first, shear_x, shear_y});
    }
};

/// A contact of an indenter ("flat", "sphere", "edge" or "grating") with these sites, for samples of this clock. Its parameters are set by
/// the overrides with target "contact". The sites must outlive the contact. `seed`: of rough surfaces.
Result<Applied<std::unique_ptr<Contact>>> make_contact(std::string_view indenter, std::span<const ParameterOverride> overrides,
                                                       const Sites&, const Clock&, std::uint64_t seed = 1);

/// The parameters of all contacts, for listings.
std::vector<ParameterInfo> contact_parameters();

/// A touch with a name, which can be requested instead of a force: a stimulus, an indenter and a path.
struct NamedTouch {
    std::string_view name, force, indenter, description;  ///< force: the name of the stimulus
    std::vector<Setting> settings;                        ///< the contact's parameters that differ from the defaults
    std::vector<Setting> force_settings = {};             ///< the stimulus's parameters that differ from the defaults
};
/// "stroke" (from the palm to the tip of the index finger), "texture" (the same with a rough surface) and "scan" (a grating over the
/// fingertip).
std::span<const NamedTouch> named_touches();

}  // namespace corpuscle
