#pragma once
// Touch by an indenter, without a sensor. The indenter rests or moves on the skin; the force on it is distributed over the sites.

#include <optional>
#include <string_view>

#include "signal/parameter_override.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// A contact: its indenter, the parameters of the indenter (settings "contact.radius" ...), and its path.
class Contact {
public:
    virtual ~Contact() = default;
    virtual std::string description() const = 0;              ///< "a sphere of 5 mm pressed at (12, 160) mm"
    virtual std::vector<MetadataEntry> metadata() const = 0;  ///< the parameters that it uses, with their values
    virtual std::vector<std::string> notes() const = 0;       ///< limitations of the model, and how much of the force was off the skin
    /// Force at the sites for `force.size()` samples of normal force (N); the first has number `first`. Valid until the next call. The sum
    /// over all sites is the force, except for the part off the skin.
    virtual Result<SiteForce> press(std::span<const double> force, std::int64_t first) = 0;
};

/// "flat", "sphere", "edge" or "grating" on this skin, for samples of this clock. Overrides set "contact.PARAMETER".
Result<std::unique_ptr<Contact>> make_contact(std::string_view indenter, std::span<const ParameterOverride> overrides, const Sites&,
                                              const Clock&);

/// The parameters of all contacts, for listings.
std::vector<ParameterInfo> contact_parameters();

/// Named touches, which can be requested instead of a force: "stroke" (from the palm to the tip of the index finger), "scan" (a grating
/// over the fingertip). A touch consists of a force, an indenter and a path.
struct NamedTouch {
    std::string_view name, force, indenter, description;
    std::vector<Setting> settings;             ///< of the contact, where they differ from the defaults
    std::vector<Setting> force_settings = {};  ///< of the force
};
std::span<const NamedTouch> named_touches();

}  // namespace corpuscle
