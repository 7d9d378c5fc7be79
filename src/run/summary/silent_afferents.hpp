#pragma once
// Finds the classes of afferents that never fired.

#include <span>
#include <vector>

#include "run/run_inputs.hpp"
#include "run/summary/silence_notes.hpp"

namespace corpuscle {

/// Finds silent classes, and their factors for the row of RunBlock::force with the largest force of the run. Netlists are left out, because
/// the search would take longer than the run. In a skin, the row is the total force, scaled to the largest force on an afferent of the
/// class. This is estimated by an upper bound: for each block, the sum over the receptive field of weight times the largest force of the
/// site within the block. The bound is exact if all sites have their largest force at the same time.
class SilenceDetector final : public Sink {
    std::vector<const AfferentPlan*> plans_;        // of each class, during the run
    std::vector<AfferentPlan> silent_plans_;        // of each class; after the run, only those of silent classes
    std::vector<char> is_silent_;                   // for each class: 1 if it has afferents, and none has fired on any input
    std::vector<double> class_force_;               // for each class of a skin: upper bound of the force on its afferents so far, N
    std::vector<std::vector<double>> row_samples_;  // kept force samples of each row of the current input, N
    std::vector<double> row_max_;                   // largest force of each row of the current input, N
    double largest_force_ = 0;                      // of all rows of all inputs so far, N
    std::vector<double> largest_force_samples_;     // kept force samples of the row with the largest force, N
    double dt_ = 0;                                 // sample period of that row, s

    void keep_silent_plans();

public:
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples, std::span<const Spike> last) override;
    /// Valid after the run, also when its plans and forces are gone.
    std::vector<SilentClass> silent_classes(const RespondOptions&) const;
};

}  // namespace corpuscle
