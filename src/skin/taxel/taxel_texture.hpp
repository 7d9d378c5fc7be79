#pragma once
// The vibration of a textured surface that slides over taxels. Taxels are usually too slow to record it, so it is computed from the speed
// of the surface (sliding_texture.hpp), and multiplied with the force that the taxels measure.

#include <algorithm>

#include "skin/contact/sliding_texture.hpp"

namespace corpuscle {

class TaxelTexture {
    SlidingTexture texture_;
    double T_;                 // s, period of the frames
    std::int64_t frames_ = 0;  // number of frames so far
    std::string description_;

public:
    TaxelTexture(const Indenter&, const ContactParams&, const Sites&, const SlidingTexture::Motion&, double rate, std::uint64_t seed);

    /// Moves on to the next frame. The first one is at 0 s.
    void next() { texture_.move_to(static_cast<double>(frames_++) * T_); }
    /// The factor of the force at a site.
    double factor(std::uint32_t site) { return std::max(0.0, 1 + texture_.at(site)); }
    /// Notes for the user: that the vibration is computed, and the part of it that these frames cannot contain.
    std::vector<std::string> notes() const;
};

/// The texture that the overrides with target "contact" describe: roughness and grain of a rough surface, or vibration, period and ridge of
/// a grating; speed, t_start and t_move (the duration of the slide; 0: to the end); angle, the direction of the slide. Null: there are
/// none. `rate`: of the frames, Hz. The sites must outlive the texture.
Result<Applied<std::unique_ptr<TaxelTexture>>> make_taxel_texture(std::span<const ParameterOverride>, const Sites&, double rate,
                                                                  std::uint64_t seed);

}  // namespace corpuscle
