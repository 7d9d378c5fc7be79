#pragma once
// The noise currents of the devices in a transient.

#include "circuit/solve/state_archive.hpp"
#include "circuit/solve/system.hpp"

namespace corpuscle::circuit {

/// The noise that a transient adds: the band of the noise, and the seed of its random numbers.
struct NoisePlan {
    double fmax = 0;           ///< Hz: upper end of the band; 0: no noise
    double fmin = 1;           ///< Hz: below it, flicker noise is no longer proportional to 1/f
    double scale = 1;          ///< factor of all noise currents
    std::uint64_t seed = 1;    ///< equal seeds give equal noise
    std::uint64_t stream = 0;  ///< 0 for the nominal circuit; others for chips and copies of this seed, whose noise is independent
    bool is_on() const { return fmax > 0; }
    double interval() const { return 0.5 / fmax; }  ///< s between two samples of the noise, the longest time step
};

/// The noise of all devices as charges: the integrals of the noise currents over a step.
///
/// White noise of density S (A^2/Hz) is a current that is constant for each interval 1 / (2 fmax), with a normal deviate of variance
/// S fmax. Its density is S sinc^2(f / (2 fmax)): 0.99 S at a tenth of fmax, 0.81 S at half of it, 0.41 S at fmax.
///
/// Flicker noise of density K / f is the sum of currents that are piecewise linear between normal deviates at 1, 2, 4, 8 ... intervals,
/// up to 1 / fmin. The sum is within 0.5 % of K / f from fmin to a tenth of fmax. It replaces what intervals shorter than the first would
/// add by doubling the variance of the first.
///
/// A deviate is a function of seed, source and time, not of the steps. So a transient with other steps has the same noise. The densities
/// are those at the newest point, as in Ito's integral.
class TransientNoise {
    struct Source {
        int from, to;                     // unknowns; -1: ground
        double white = 0, flicker = 0;    // A: factors of its deviates
        double deviate = 0;               // of white noise in the cell
        double at_start = 0, growth = 0;  // flicker deviate: at_start at the start of the cell, at_start + growth at its end
    };
    struct NoisyDevice {
        const Device* device;
        std::size_t first, count;  // its sources
        std::vector<double> v;     // unknowns at which its densities were computed
    };
    struct Level {  // deviates at every 2^shift intervals, of all sources with flicker noise
        int shift;
        std::int64_t offset;  // of its first interval, in cells
        std::int64_t index;   // number of the present interval
        double weight;
        std::vector<double> low, high;  // deviates at its start and its end
    };
    const System& system_;
    NoisePlan plan_;
    std::uint64_t key_ = 0;   // of all deviates
    double origin_ = 0;       // s: time of the noise at the time 0 of the transient
    std::int64_t cell_ = -1;  // interval of the noise whose deviates are loaded; -1: none
    std::vector<Source> sources_;
    std::vector<std::size_t> flicker_sources_;  // indices in sources_
    std::vector<NoisyDevice> devices_;
    std::vector<Level> levels_;

    std::int64_t cell_at(double t) const;
    void add_device(const Device&, std::span<const NoiseSource>);
    void set_densities(const NoisyDevice&, std::span<const NoiseSource>);
    void load_cell(std::int64_t cell);
    void load_level(Level&, std::int64_t index);
    void draw_level(const Level&, std::int64_t index, std::vector<double>& out) const;

public:
    static constexpr int best_order = 2;          ///< of the integration formula
    static constexpr long steps_per_measure = 8;  ///< accepted steps between two calls of NodeNoise::measure() for all unknowns

    /// The devices keep their unknowns; their densities are those at x until the first update().
    TransientNoise(const System&, const NoisePlan&);
    void begin(std::span<const double> x, std::uint64_t stream);

    /// Computes the densities at x again, of all devices or of those whose unknowns have changed by more than a small part of a volt.
    void update(std::span<const double> x, bool all = false);
    /// The end (s) of the interval of the noise in which t is. A step must not go beyond it.
    double next_sample(double t) const;
    /// Writes to `out` the charge that the noise currents carry out of each node (or add to each other equation) from t0 to t1, C.
    void charges(double t0, double t1, std::span<double> out);
    void shift_origin(double t) { origin_ += t; }  ///< moves the origin of time to t, s
    void archive(StateArchive&);                   ///< writes or reads the state
};

/// How the noise of one step changes an unknown, and the charge of the noise in its equation.
///
/// A node that is slower than the steps integrates the noise: the charge of a step is that of the noise currents. A faster node follows the
/// current of each step. The formula of order 2 would multiply its variance by 2.5, since it extrapolates the current from two steps. There
/// the charge is such that the formula gives the current of the step. `slow` weighs the two.
struct NodeNoise {
    double slow = 1;   ///< a C / (G + a C) of the node in a step with dq/dt = a q + history
    double power = 0;  ///< V^2 or A^2: mean square of the change of the unknown by the noise of a step

    /// Call for some of the steps, with the change of the unknown by the noise of the step.
    void measure(double change, double capacitive, double diagonal) {
        constexpr double memory = 0.8;
        power = power > 0 ? memory * power + (1 - memory) * change * change : change * change;
        slow = diagonal > capacitive ? std::max(capacitive, 0.0) / diagonal : 1;
    }
    /// Added to the allowed error: a fast node follows each sample of the noise, and no step is short enough to predict that.
    double allowed_error() const { return (1 - slow) * std::sqrt(power); }
    /// The charge of a step of length h (s) whose noise currents carry `charge`, C. `previous`: the result for the step before; the formula
    /// is dq/dt = a q + ... + weight * (the charge before that step).
    double charge(double charge, double previous, double h, double a, double weight) const {
        return slow * charge + (1 - slow) * (charge / h + weight * previous) / a;
    }
    void archive(StateArchive& archive) {
        archive.number(slow), archive.number(power);
        archive.is_valid &= power >= 0 && slow >= 0 && slow <= 1;
    }
};

}  // namespace corpuscle::circuit
