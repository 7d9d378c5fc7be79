#pragma once
// The force at the sites of a skin: of a contact, or of a recording with one channel for each site.

#include <memory>

#include "core/force_source.hpp"
#include "skin/contact/contact.hpp"
#include "skin/skin.hpp"
#include "skin/taxel/taxel_map.hpp"
#include "skin/taxel/taxel_texture.hpp"

namespace corpuscle {

/// The force at the sites, block after block.
class SkinForce {
public:
    /// Valid until the next block.
    struct Block {
        SiteForce force;
        std::span<const double> total_force;  ///< of all sites together, N; one value for each sample of the block
    };
    virtual ~SkinForce() = default;
    /// Returns the next block; at the end of the force, a block without samples.
    virtual Result<Block> next() = 0;
    virtual double progress() const = 0;                     ///< completed fraction, 0 to 1
    virtual RecordingQuality quality() const { return {}; }  ///< of the part of a recording that was read so far
    /// Notes for the user about the part of the force that was read so far, besides those of quality().
    virtual std::vector<std::string> notes() const { return {}; }
};

/// The force at the sites when a contact presses one channel of force onto the skin.
std::unique_ptr<SkinForce> make_pressed_force(ForceSource&, Contact&);
/// The force at the sites from a recording with one channel for each site. `sites`: the site of each channel; `all_sites`: the number of
/// sites of the skin.
std::unique_ptr<SkinForce> make_site_force(ForceSource&, std::vector<std::uint32_t> sites, std::size_t all_sites);
/// The force at the sites from a recording of taxels. `map`: of this layout. `taxels`: the taxel of each channel.
/// `texture`: of a surface that slides over the taxels; null: none.
std::unique_ptr<SkinForce> make_taxel_force(ForceSource&, const TaxelLayout&, TaxelMap map, const std::vector<std::uint32_t>& taxels,
                                            std::size_t all_sites, std::unique_ptr<TaxelTexture> texture = nullptr);
/// Returns an error if the layout says how the axes of the taxels point, but the recording has no shear.
Result<void> check_shear(const TaxelLayout&, const ForceSource&);
/// The site of each channel of a recording: by name, or by order if there are as many channels as sites.
Result<std::vector<std::uint32_t>> match_sites(const SkinPlan&, const ForceSource&);

}  // namespace corpuscle
