#pragma once
// Simulates many chips of one netlist, each with its own force, on SIMD lanes. Each lane is one chip with its own time.

#include "circuit/afferent/circuit_afferent.hpp"

namespace corpuscle::circuit {

/// A chip to simulate.
struct Chip {
    std::int64_t id = 0;                                   ///< chosen by the caller
    std::shared_ptr<const CircuitAfferentFactory> design;  ///< all chips of a batch must have the same devices at the same nodes
    std::optional<ChipSample> sample;                      ///< nothing: the nominal circuit
    std::span<const double> force;                         ///< N; must stay valid until the chip is done
    double T = 1e-4;                                       ///< s, interval between samples of the force
};

/// The result of one chip.
struct ChipResponse {
    std::vector<double> spikes;  ///< s since the first sample of the force
    TransientStats stats;
    EnergyUse energy_use;
    std::vector<RangeViolation> range_violations;  ///< [operating range of the design]
    std::vector<std::vector<float>> probes;        ///< [probe of the design][recorded sample]
    std::optional<Error> error;  ///< if the simulation did not converge (with time and unknown), was interrupted, or the force is empty
    bool hit_iteration_limit = false;  ///< true if the simulation stopped at max_iterations
    bool is_scalar = false;            ///< true if the chip was simulated by the scalar code, because a lane cannot or its lane failed
};

struct BatchOptions {
    std::size_t lanes = 8;                   ///< number of chips that are simulated at once: 1, 4 or 8; results do not depend on it
    long max_iterations = 0;                 ///< maximum number of Newton iterations of one chip; 0: no limit
    std::size_t probe_every = 0;             ///< n: records the probes at samples 0, n, 2n ...; 0: never
    std::function<bool()> should_stop = {};  ///< called repeatedly; must return true to stop
};

/// Simulates chips until `next_chip` returns none. Calls on_done for each finished chip, in any order. `nominal` gives the elimination
/// order and the tolerances for all lanes. The result of a chip does not depend on the other chips, the number of lanes or the instruction
/// set. If the elimination or the convergence fails on a lane, the chip is simulated again from its beginning by the scalar code
/// (run_chip_scalar). Errors: interruption by should_stop, an instruction set that this machine does not have, a nominal circuit that
/// cannot be set up.
Result<void> run_chips(const std::shared_ptr<const CircuitAfferentFactory>& nominal, const std::function<std::optional<Chip>()>& next_chip,
                       const std::function<void(const Chip&, ChipResponse&&)>& on_done, const BatchOptions&);

/// Simulates one chip by the scalar code.
ChipResponse run_chip_scalar(const Chip&, const BatchOptions&);

}  // namespace corpuscle::circuit
