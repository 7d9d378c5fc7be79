#pragma once
// Texture under sliding: the vibration of the force at a site while a surface with a fine pattern slides over it.
//     F_site(t) = F(t) (1 + e(t) sum over components of a cos(2 pi (k . (p - X(t)) + phase)))
// F is the force at the site without texture, p the site's position, X(t) that of the surface's origin, k a spatial frequency of its
// pattern. The pattern is frozen to the surface. So speed v gives the temporal frequency k . v by itself, and a repeated scan gives the
// same vibration. The envelope e(t) rises from 0 over the first wavelength of the movement and falls over the last one. At rest it is 0.
// - A grating has the harmonics h of its ridges, with k = h / period and a = vibration / h. They are there for periods below the distance
//   between sites, too.
// - A rough surface is a sum of plane waves with random phases. Along the path, k is lognormal around 1 / grain, with a deviation of half
//   an octave. Across it, k is normal, with a deviation of half of 1 / grain. The root mean square is `roughness`.
// That the amplitude does not depend on speed follows Greenspon et al. 2019 (doi 10.1101/680322): with speed the spectrum shifts, and this
// shift explains the growth of intensity. That it is proportional to force is a choice.
// Components at or above half the sampling rate cannot be sampled and are left out.

#include "skin/contact/indenters.hpp"

namespace corpuscle {

class SlidingTexture {
public:
    /// The movement of the surface over the skin.
    struct Motion {
        Position velocity, origin;  ///< m/s; m: of the surface's pattern at the start
        double start = 0, end = 0;  ///< s; no end: infinite
    };

    /// Without a pattern or movement there is no vibration: is_empty(). `rate`: sampling rate, Hz; `seed`: of a rough surface.
    SlidingTexture(const Indenter&, const ContactParams&, const Sites&, const Motion&, double rate, std::uint64_t seed);

    /// A surface whose movement is not known in advance: move_to() gives its position in each sample. The waves of a rough surface then
    /// have all directions, because there is no path along which they could have their wavelength. The envelope grows over the first
    /// wavelength of a movement, and falls to 0 in `fade_time` without one (a choice).
    SlidingTexture(const Indenter&, const ContactParams&, const Sites&, std::uint64_t seed);
    static constexpr double fade_time = 0.2;  ///< s

    bool is_empty() const { return components_.empty(); }
    /// Prepares at() for a time (s).
    void move_to(double t);
    /// Prepares at() for a surface at this position, T (s) after the last call. A component that moves by more than half a wavelength in
    /// this time is left out.
    void move_to(const Position&, double T);
    void lift() { position_.reset(), envelope_ = 0; }  ///< the contact ends; the next one may be anywhere
    /// The vibration at a site, relative to the force there.
    double at(std::uint32_t site) {
        if (!(envelope_ > 0)) return 0;
        return envelope_ * sum(site);
    }
    /// The fraction of the mean square of the vibration that was left out because of the sampling rate.
    double left_out() const { return left_out_; }
    /// The frequency around which a rough surface vibrates, or of the first harmonic of a grating, Hz.
    double frequency() const { return frequency_; }

private:
    struct Component {
        double kx, ky, amplitude, phase;  // 1/m, 1/m, relative to the force, turns
    };
    static constexpr std::size_t lanes = 4;  // sums that are independent of one another

    const Sites& sites_;
    Motion motion_;
    double wavelength_ = 1;  // along the path, m: of the envelope
    double left_out_ = 0, frequency_ = 0, envelope_ = 0;
    std::optional<Position> position_;   // of a surface that move_to() moves, at the last call; empty: no contact
    std::vector<Component> components_;  // their number is a multiple of `lanes`
    std::vector<double> surface_;        // of the current time: for each component cosine, then sine of 2 pi k . X
    std::vector<double> skin_;           // [slot][2 * components]: the same of 2 pi k . p + phase, times the amplitude
    std::vector<std::uint32_t> slot_;    // of each site in skin_, plus 1; 0: not computed yet
    std::uint32_t slots_ = 0;            // number of sites in skin_

    void add(const Component&, double rate, double& all, double& kept);
    void add_grating(const ContactParams&, double rate);
    void add_rough_surface(const ContactParams&, double rate, std::uint64_t seed);
    void finish_components();
    double sum(std::uint32_t site);
    void compute_site(std::uint32_t site);
};

}  // namespace corpuscle
