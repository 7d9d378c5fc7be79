#pragma once
// Touch without a sensor: an indenter pressed with a force, standing or moved over the skin, becomes force at the sites.

#include <optional>
#include <string_view>

#include "signal/settings.hpp"
#include "skin/skin.hpp"

namespace corpuscle {

/// What touches: which indenter, its measures (rows of settings "contact.radius" ...), and the path it takes.
class Contact {
public:
    virtual ~Contact() = default;
    virtual std::string sentence() const = 0;              ///< "a sphere of 5 mm pressed at (12, 160) mm"
    virtual std::vector<Fact> facts() const = 0;           ///< its measures as used
    virtual std::vector<std::string> remarks() const = 0;  ///< what it leaves out, what of the contact was off the skin
    /// Force at the sites for `force.size()` samples of normal force (N), the first of them number `first`. Valid until the next call.
    /// The sum over all sites is the force, but for what lies off the skin.
    virtual Result<SiteForce> press(std::span<const double> force, std::int64_t first) = 0;
};

/// "flat", "sphere", "edge", "grating" of this skin; wishes set "contact.PARAMETER". For samples of this clock.
Result<std::unique_ptr<Contact>> make_contact(std::string_view indenter, std::span<const Wish> wishes, const Sites&, const Clock&);

/// One parameter's row, for listings.
std::vector<Row> contact_rows();

/// What can be asked for in the place of a force: "stroke" (from the palm to the tip of the index finger), "scan" (a grating over the
/// fingertip). A touch is a force, an indenter and a path.
struct NamedTouch {
    std::string_view name, force, indenter, sentence;
    std::vector<Setting> settings;             ///< of the contact, where they differ from the rows'
    std::vector<Setting> force_settings = {};  ///< of the force
};
std::span<const NamedTouch> named_touches();

}  // namespace corpuscle
