#pragma once
// Many chips of one netlist, each under its force: on lanes, each lane a chip with its own time.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "circuit/afferent.hpp"

namespace corpuscle::circuit {

/// A chip that is to be run.
struct Chip {
    std::int64_t number = 0;                      ///< the caller's
    std::shared_ptr<const CircuitDesign> design;  ///< all of one batch have the same devices at the same nodes
    std::optional<Draw> draw;
    std::span<const double> force;  ///< N, samples T apart; it stays where it is until the chip has ended
    double T = 1e-4;                ///< s
};

/// What it did.
struct ChipAnswer {
    std::vector<double> spikes;  ///< s
    TransientWork work;
    Spent spent;
    std::vector<Outside> outside;           ///< of each of the design's ranges
    std::vector<std::vector<float>> shown;  ///< what was asked to be shown: each of the design's probes at each sample asked for
    std::optional<Error> error;             ///< it did not converge: when and where
    bool capped = false;                    ///< it was stopped: more iterations than it may have
    bool alone = false;                     ///< it left its lane, and was done again by itself
};

struct BatchOptions {
    std::size_t lanes = 8;       ///< 1, 4 or 8; the answers do not depend on it
    long most_iterations = 0;    ///< of a chip; 0: as many as it takes
    std::size_t show_every = 0;  ///< samples; 0: nothing is shown
    std::function<bool()> stop = {};
};

/// Takes chips until `next` has none, and tells each as it ends, in any order. An answer depends on its chip alone, not on the chips beside
/// it, on lanes or instruction set. One whose elimination or convergence fails on its lane is done again as one chip alone
/// (CircuitDesign::make).
Result<void> run_chips(const std::shared_ptr<const CircuitDesign>& nominal, const std::function<std::optional<Chip>()>& next,
                       const std::function<void(const Chip&, ChipAnswer&&)>& told, const BatchOptions&);

/// The same for one chip by itself.
ChipAnswer run_chip_alone(const Chip&, const BatchOptions&);

}  // namespace corpuscle::circuit
