// Thesis fig. 3: the smallest step of force that evokes a spike, for each afferent class.

#include <fmt/format.h>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/threshold_search.hpp"

namespace corpuscle::studies::fig3 {

/// smallest_sa1 ... smallest_fa2, N.
Result<StudyValues> compute_values(const StudyOptions& options) {
    StudyValues out;
    for (const char* afferent : {"sa1", "sa2", "fa1", "fa2"}) {
        const auto smallest = find_threshold(
            1e-4, 4, 10, SearchScale::logarithmic,
            [&](double force) { return TrialSpec{afferent, "step", {fmt::format("step.F_max={}", force)}}; },
            [](const std::vector<double>& spikes) { return !spikes.empty(); });
        if (!smallest) return smallest.error();
        out.emplace(fmt::format("smallest_{}", afferent), *smallest);
        TRY(options.report_progress(0));
    }
    return out;
}

}  // namespace corpuscle::studies::fig3
