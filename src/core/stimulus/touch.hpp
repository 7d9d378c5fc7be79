#pragma once
// Stimuli of a single touch: press, hold, release.

#include "core/force_source.hpp"
#include "core/number/elementary.hpp"
#include "core/parameter.hpp"

namespace corpuscle {

/// The progress of a movement at time t: 0 before the time `from`, 1 after `from` + `length`, linear between. All are in s.
inline double ramp_fraction(double t, double from, double length) {
    if (t < from) return 0;
    return t < from + length ? (t - from) / length : 1;
}

/// Five consecutive phases, named as in section 1.2 of the thesis. The arguments are their durations in s.
inline std::vector<Phase> five_phases(double rest, double up, double hold, double down, double post) {
    const double a = rest, b = a + up, c = b + hold, d = c + down, e = d + post;
    return {{"rest", 0, a}, {"protraction", a, b}, {"plateau", b, c}, {"retraction", c, d}, {"post", d, e}};
}

/// The experiment of the thesis (1.2, after Birznieks et al. 2001): half a cosine up, hold, half a cosine down.
///     F = F_min + (F_max - F_min) (1 - cos(pi x)) / 2,   x = (t - t_rest) / t_up during protraction, 1 on the plateau,
///     falling from 1 to 0 during retraction
struct Press {
    struct Params {
        double F_min = 0.2, F_max = 4, t_rest = 0.25, t_up = 0.125, t_hold = 0.25, t_down = 0.125, t_post = 0.25;
    };
    static constexpr std::string_view name = "press",
                                      description = "the fingertip experiment of the thesis: half-cosine up, hold, half-cosine down";
    static constexpr std::string_view source = "thesis 1.2; Birznieks et al. 2001, J Neurosci 21:8222";
    static constexpr ParameterDef<Params> fields[] = {
        {"F_min", &Params::F_min, "N", 0, 1e3, "force at rest"},
        {"F_max", &Params::F_max, "N", 0, 1e3, "force on the plateau"},
        {"t_rest", &Params::t_rest, "s", 0, 1e5, "time before protraction"},
        {"t_up", &Params::t_up, "s", 0, 1e5, "duration of protraction"},
        {"t_hold", &Params::t_hold, "s", 0, 1e5, "duration of the plateau"},
        {"t_down", &Params::t_down, "s", 0, 1e5, "duration of retraction", "by symmetry with t_up; thesis 1.2 prints 250 ms"},
        {"t_post", &Params::t_post, "s", 0, 1e5, "time after retraction", "choice: one press lasts 1.0 s"},
    };
    Params p;
    double duration() const { return p.t_rest + p.t_up + p.t_hold + p.t_down + p.t_post; }
    std::vector<Phase> phases() const { return five_phases(p.t_rest, p.t_up, p.t_hold, p.t_down, p.t_post); }
    double at(double t) const {
        const double up = ramp_fraction(t, p.t_rest, p.t_up), down = ramp_fraction(t, p.t_rest + p.t_up + p.t_hold, p.t_down);
        const double x = down > 0 ? 1 - down : up;
        return p.F_min + (p.F_max - p.F_min) * 0.5 * (1 - num::cos_turns(0.5 * x));
    }
};

/// Linear ramps with a hold between them, as used by Kim et al. 2012 and most physiologists.
struct RampHold {
    struct Params {
        double F_min = 0, F_max = 1, t_rest = 0.25, t_up = 0.1, t_hold = 1, t_down = 0.1, t_post = 0.25;
    };
    static constexpr std::string_view name = "ramp-hold", description = "linear ramp up, hold, linear ramp down", source = "choice";
    static constexpr ParameterDef<Params> fields[] = {
        {"F_min", &Params::F_min, "N", 0, 1e3, "force at rest"},
        {"F_max", &Params::F_max, "N", 0, 1e3, "force during the hold"},
        {"t_rest", &Params::t_rest, "s", 0, 1e5, "time before the ramp"},
        {"t_up", &Params::t_up, "s", 0, 1e5, "duration of the ramp up"},
        {"t_hold", &Params::t_hold, "s", 0, 1e5, "duration of the hold"},
        {"t_down", &Params::t_down, "s", 0, 1e5, "duration of the ramp down"},
        {"t_post", &Params::t_post, "s", 0, 1e5, "time after the ramp down"},
    };
    Params p;
    double duration() const { return p.t_rest + p.t_up + p.t_hold + p.t_down + p.t_post; }
    std::vector<Phase> phases() const { return five_phases(p.t_rest, p.t_up, p.t_hold, p.t_down, p.t_post); }
    double at(double t) const {
        return p.F_min +
               (p.F_max - p.F_min) * (ramp_fraction(t, p.t_rest, p.t_up) - ramp_fraction(t, p.t_rest + p.t_up + p.t_hold, p.t_down));
    }
};

/// A step from one force to another and back (thesis fig. 3).
struct Step {
    struct Params {
        double F_min = 0, F_max = 1, t_rest = 0.25, t_hold = 0.5, t_post = 0.25;
    };
    static constexpr std::string_view name = "step", description = "force switched on and off",
                                      source = "choice; thesis fig. 3 shows the shape";
    static constexpr ParameterDef<Params> fields[] = {
        {"F_min", &Params::F_min, "N", 0, 1e3, "force at rest"},
        {"F_max", &Params::F_max, "N", 0, 1e3, "force during the hold"},
        {"t_rest", &Params::t_rest, "s", 0, 1e5, "time before the step"},
        {"t_hold", &Params::t_hold, "s", 0, 1e5, "duration of the hold"},
        {"t_post", &Params::t_post, "s", 0, 1e5, "time after the step back"},
    };
    Params p;
    double duration() const { return p.t_rest + p.t_hold + p.t_post; }
    std::vector<Phase> phases() const {
        const double on = p.t_rest, off = on + p.t_hold;
        return {{"rest", 0, on}, {"hold", on, off}, {"post", off, off + p.t_post}};
    }
    double at(double t) const {
        const double later = t + 1e-9;  // s; a sample exactly at an edge counts as after it, in spite of rounding
        return later >= p.t_rest && later < p.t_rest + p.t_hold ? p.F_max : p.F_min;
    }
};

}  // namespace corpuscle
