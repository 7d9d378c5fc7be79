#include "skin/contact/sliding_texture.hpp"

#include <algorithm>

#include "core/random.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t rough_components = 32, max_harmonics = 32;
constexpr double half_octave = 0.34657359027997264;  // ln(2) / 2
constexpr double min_slope = 1e-3;                   // smaller k . v / (|k| |v|): the pattern slides along itself

constexpr auto rough_purpose = static_cast<std::uint32_t>(stream_id("rough surface"));

}  // namespace

SlidingTexture::SlidingTexture(const Indenter& indenter, const ContactParams& p, const Sites& sites, const Motion& motion, double rate,
                               std::uint64_t seed)
    : sites_(sites), motion_(motion) {
    if (motion.velocity.x == 0 && motion.velocity.y == 0) return;
    if (indenter.name == "grating" && p.vibration > 0) add_grating(p, rate);
    if (indenter.name != "grating" && p.roughness > 0) add_rough_surface(p, rate, seed);
    finish_components();
}

SlidingTexture::SlidingTexture(const Indenter& indenter, const ContactParams& p, const Sites& sites, std::uint64_t seed)
    : sites_(sites), motion_{} {
    const bool is_grating = indenter.name == "grating";
    wavelength_ = is_grating ? p.period : p.grain;
    const double turns = p.angle / 360;
    for (std::size_t n = 1; is_grating && p.vibration > 0 && n <= max_harmonics; ++n) {
        const auto h = static_cast<double>(n);
        components_.push_back(
            {h * num::cos_turns(turns) / p.period, h * num::sin_turns(turns) / p.period, p.vibration / h, -0.5 * h * p.ridge / p.period});
    }
    for (std::uint32_t n = 0; !is_grating && p.roughness > 0 && n < rough_components; ++n) {
        const double k = num::exp(half_octave * normal_pair(seed, n, rough_purpose, 0).first) / p.grain;
        const auto w = philox({1, 0, n, rough_purpose}, seed);
        const double direction = unit_interval(w[2], w[3]);
        components_.push_back({k * num::cos_turns(direction), k * num::sin_turns(direction),
                               p.roughness * num::sqrt(2.0 / rough_components), unit_interval(w[0], w[1])});
    }
    finish_components();
}

void SlidingTexture::finish_components() {
    while (components_.size() % lanes != 0) components_.push_back({});
    surface_.resize(2 * components_.size());
    if (!components_.empty()) slot_.resize(sites_.size());
}

/// Adds a component if its frequency can be sampled. `all` and `kept`: sums of squares of the amplitudes.
void SlidingTexture::add(const Component& c, double rate, double& all, double& kept) {
    const double frequency = num::abs(c.kx * motion_.velocity.x + c.ky * motion_.velocity.y);
    all += c.amplitude * c.amplitude;
    if (!(frequency < 0.5 * rate)) return;
    kept += c.amplitude * c.amplitude;
    components_.push_back(c);
}

void SlidingTexture::add_grating(const ContactParams& p, double rate) {
    const double turns = p.angle / 360, kx = num::cos_turns(turns) / p.period, ky = num::sin_turns(turns) / p.period;
    const auto& v = motion_.velocity;
    const double per_second = num::abs(kx * v.x + ky * v.y), speed = num::sqrt(v.x * v.x + v.y * v.y);
    if (per_second * p.period < min_slope * speed) return;
    frequency_ = per_second, wavelength_ = speed / per_second;
    double all = 0, kept = 0;
    // The middle of the first ridge is at ridge / 2, and the force is largest there.
    for (std::size_t n = 1; n <= max_harmonics; ++n) {
        const auto h = static_cast<double>(n);
        add({h * kx, h * ky, p.vibration / h, -0.5 * h * p.ridge / p.period}, rate, all, kept);
    }
    left_out_ = 1 - kept / all;
}

void SlidingTexture::add_rough_surface(const ContactParams& p, double rate, std::uint64_t seed) {
    const auto& v = motion_.velocity;
    const double speed = num::sqrt(v.x * v.x + v.y * v.y), ex = v.x / speed, ey = v.y / speed;  // ex, ey: direction of the path
    frequency_ = speed / p.grain, wavelength_ = p.grain;
    double all = 0, kept = 0;
    for (std::uint32_t n = 0; n < rough_components; ++n) {
        const auto random = normal_pair(seed, n, rough_purpose, 0);
        const double along = num::exp(half_octave * random.first) / p.grain, across = 0.5 * random.second / p.grain;
        const auto w = philox({1, 0, n, rough_purpose}, seed);
        add({along * ex - across * ey, along * ey + across * ex, p.roughness * num::sqrt(2.0 / rough_components),
             unit_interval(w[0], w[1])},
            rate, all, kept);
    }
    left_out_ = 1 - kept / all;
}

void SlidingTexture::move_to(double t) {
    envelope_ = 0;
    if (is_empty() || !(t > motion_.start && t < motion_.end)) return;
    const auto& v = motion_.velocity;
    const double since = t - motion_.start, speed = num::sqrt(v.x * v.x + v.y * v.y);
    envelope_ = std::min({1.0, speed * since / wavelength_, speed * (motion_.end - t) / wavelength_});
    for (std::size_t n = 0; n < components_.size(); ++n) {
        const double turns = (components_[n].kx * v.x + components_[n].ky * v.y) * since;
        surface_[2 * n] = num::cos_turns(turns), surface_[2 * n + 1] = num::sin_turns(turns);
    }
}

void SlidingTexture::move_to(const Position& at, double T) {
    const auto last = position_.value_or(at);
    position_ = at;
    if (is_empty()) return;
    const double dx = at.x - last.x, dy = at.y - last.y;
    const double moved = num::sqrt(dx * dx + dy * dy) / wavelength_;
    envelope_ = std::min(1.0, std::max(0.0, envelope_ + moved - T / fade_time));
    if (!(envelope_ > 0)) return;
    for (std::size_t n = 0; n < components_.size(); ++n) {
        const auto& c = components_[n];
        const double turns = c.kx * at.x + c.ky * at.y;
        const bool can_be_sampled = num::abs(c.kx * dx + c.ky * dy) < 0.5;
        surface_[2 * n] = can_be_sampled ? num::cos_turns(turns) : 0, surface_[2 * n + 1] = can_be_sampled ? num::sin_turns(turns) : 0;
    }
}

void SlidingTexture::compute_site(std::uint32_t site) {
    const double x = sites_.positions[site].x - motion_.origin.x, y = sites_.positions[site].y - motion_.origin.y;
    skin_.resize((slots_ + 1) * surface_.size());
    double* const out = skin_.data() + slots_ * surface_.size();
    for (std::size_t n = 0; n < components_.size(); ++n) {
        const auto& c = components_[n];
        const double turns = c.kx * x + c.ky * y + c.phase;
        out[2 * n] = c.amplitude * num::cos_turns(turns), out[2 * n + 1] = c.amplitude * num::sin_turns(turns);
    }
    slot_[site] = ++slots_;
}

/// The sum of all components by cos(a - b) = cos a cos b + sin a sin b.
double SlidingTexture::sum(std::uint32_t site) {
    if (slot_[site] == 0) compute_site(site);
    const double* const skin = skin_.data() + (slot_[site] - 1) * surface_.size();
    double sums[lanes] = {};
    for (std::size_t n = 0; n < surface_.size(); n += lanes)
        for (std::size_t l = 0; l < lanes; ++l) sums[l] += skin[n + l] * surface_[n + l];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace corpuscle
