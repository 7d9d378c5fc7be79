#pragma once
// Vibrations and textures: force that varies continuously around a mean.

#include "core/force_source.hpp"
#include "core/parameter.hpp"
#include "core/random.hpp"

namespace corpuscle {

/// F = F_mean + F_amp sin(2 pi f t)
struct Sine {
    struct Params {
        double F_mean = 1, F_amp = 0.5, f = 30, duration = 1;
    };
    static constexpr std::string_view name = "sine", description = "a sinusoid around a mean force", source = "choice";
    static constexpr ParameterDef<Params> fields[] = {
        {"F_mean", &Params::F_mean, "N", 0, 1e3, "mean force; use 0 to add the sinusoid to another stimulus"},
        {"F_amp", &Params::F_amp, "N", 0, 1e3, "amplitude, half of the peak-to-peak value"},
        {"f", &Params::f, "Hz", 0, 1e6, "frequency"},
        {"duration", &Params::duration, "s", 0, 1e6, "duration"},
    };
    Params p;
    double duration() const { return p.duration; }
    double cycle() const { return p.f; }
    double at(double t) const { return p.F_mean + p.F_amp * num::sin_turns(p.f * t); }
};

/// A logarithmic frequency sweep, f = f_from (f_to / f_from)^(t / duration).
struct Chirp {
    struct Params {
        double F_mean = 1, F_amp = 0.2, f_from = 1, f_to = 500, duration = 5;
    };
    static constexpr std::string_view name = "chirp", description = "a sinusoid with a logarithmic frequency sweep", source = "choice";
    static constexpr ParameterDef<Params> fields[] = {
        {"F_mean", &Params::F_mean, "N", 0, 1e3, "mean force; use 0 to add the sweep to another stimulus"},
        {"F_amp", &Params::F_amp, "N", 0, 1e3, "amplitude, half of the peak-to-peak value"},
        {"f_from", &Params::f_from, "Hz", 1e-3, 1e6, "first frequency"},
        {"f_to", &Params::f_to, "Hz", 1e-3, 1e6, "last frequency"},
        {"duration", &Params::duration, "s", 1e-3, 1e6, "duration"},
    };
    Params p;
    double duration() const { return p.duration; }
    double at(double t) const {
        const double sweep_rate = num::log(p.f_to / p.f_from) / p.duration;  // 1/s
        const double turns = p.f_from * t * num::exprel(sweep_rate * t);
        return p.F_mean + p.F_amp * num::sin_turns(turns);
    }
};

/// Gaussian noise: independent deviates at intervals of 1 / (2 f_max), linearly interpolated. It does not depend on the sample rate.
struct Noise {
    struct Params {
        double F_mean = 1, F_sd = 0.2, f_max = 100, duration = 1;
    };
    static constexpr std::string_view name = "noise", description = "Gaussian noise up to about f_max; see --seed", source = "choice";
    static constexpr ParameterDef<Params> fields[] = {
        {"F_mean", &Params::F_mean, "N", 0, 1e3, "mean force; use 0 to add the noise to another stimulus"},
        {"F_sd", &Params::F_sd, "N", 0, 1e3, "standard deviation of the deviates"},
        {"f_max", &Params::f_max, "Hz", 1e-3, 1e6, "upper frequency; the deviates are 1/(2 f_max) apart"},
        {"duration", &Params::duration, "s", 0, 1e6, "duration"},
    };
    Params p;
    std::uint64_t seed = 0;
    double duration() const { return p.duration; }
    double at(double t) const {
        constexpr std::uint32_t purpose = 0x6e6f6973;  // "nois" in ASCII: separates these random numbers from those of other purposes
        const double position = t * 2 * p.f_max;
        const auto k = static_cast<std::uint64_t>(position);
        const double x = position - static_cast<double>(k);  // position between deviates k and k + 1
        const double a = normal(seed, 0, purpose, k), b = normal(seed, 0, purpose, k + 1);
        return p.F_mean + p.F_sd * (a + (b - a) * x);
    }
};

/// A grating of rounded ridges that moves over the skin. 3/8 is the mean of the squared term, so the mean force is F_contact.
///     F = F_contact + F_ridge (((1 + cos(2 pi v t / period)) / 2)^2 - 3/8)
struct Grating {
    struct Params {
        double F_contact = 1, F_ridge = 0.5, period = 2e-3, speed = 40e-3, duration = 1;
    };
    static constexpr std::string_view name = "grating", description = "ridges moving over the skin; speed / period is the frequency",
                                      source = "choice";
    static constexpr ParameterDef<Params> fields[] = {
        {"F_contact", &Params::F_contact, "N", 0, 1e3, "mean contact force"},
        {"F_ridge", &Params::F_ridge, "N", 0, 1e3, "force difference between ridge and groove"},
        {"period", &Params::period, "m", 1e-6, 1, "distance between ridges"},
        {"speed", &Params::speed, "m/s", 0, 100, "speed over the skin"},
        {"duration", &Params::duration, "s", 0, 1e6, "duration"},
    };
    Params p;
    double duration() const { return p.duration; }
    double cycle() const { return p.speed / p.period; }
    double at(double t) const {
        const double ridge = 0.5 * (1 + num::cos_turns(p.speed * t / p.period));
        return p.F_contact + p.F_ridge * (ridge * ridge - 0.375);
    }
};

}  // namespace corpuscle
