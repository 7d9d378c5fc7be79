#pragma once
// Simulates many chips of one netlist, each with its own force, on SIMD lanes. Each lane is one chip with its own time.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "circuit/circuit_afferent.hpp"

namespace corpuscle::circuit {

/// A chip to simulate.
struct Chip {
    std::int64_t id = 0;                                   ///< chosen by the caller
    std::shared_ptr<const CircuitAfferentFactory> design;  ///< all chips of a batch must have the same devices at the same nodes
    std::optional<ChipSample> sample;
    std::span<const double> force;  ///< N, sampled at interval T; must stay valid until the chip is done
    double T = 1e-4;                ///< s
};

/// The result of one chip.
struct ChipResponse {
    std::vector<double> spikes;  ///< s
    TransientStats stats;
    EnergyUse energy_use;
    std::vector<RangeViolation> range_violations;  ///< by range of the design
    std::vector<std::vector<float>> probes;        ///< [probe of the design][recorded sample]
    std::optional<Error> error;                    ///< where the simulation did not converge: time and unknown
    bool hit_iteration_limit = false;              ///< stopped at the iteration limit
    bool is_scalar = false;                        ///< simulated by the scalar code after its lane failed
};

struct BatchOptions {
    std::size_t lanes = 8;        ///< 1, 4 or 8; results do not depend on it
    long max_iterations = 0;      ///< limit for one chip; 0: no limit
    std::size_t probe_every = 0;  ///< records the probes at every n-th sample; 0: never
    std::function<bool()> should_stop = {};
};

/// Simulates chips until `next` returns none. Calls on_done for each finished chip, in any order. The result of a chip does not depend on
/// the other chips, the number of lanes or the instruction set. If the elimination or the convergence fails on a lane, the chip is
/// simulated again from its beginning by the scalar code (run_chip_scalar). Errors: interrupted by should_stop.
Result<void> run_chips(const std::shared_ptr<const CircuitAfferentFactory>& nominal, const std::function<std::optional<Chip>()>& next,
                       const std::function<void(const Chip&, ChipResponse&&)>& on_done, const BatchOptions&);

/// Simulates one chip by the scalar code.
ChipResponse run_chip_scalar(const Chip&, const BatchOptions&);

}  // namespace corpuscle::circuit
