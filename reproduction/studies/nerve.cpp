// The detection thresholds of vibration, for the study nerve.

#include <fmt/format.h>

#include "measure/measures.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/threshold_search.hpp"

namespace corpuscle::studies::nerve {

/// The smallest amplitude (N) of a sine of `f` (Hz) that evokes a spike after the first 0.5 s; 4 N if no amplitude below does.
Result<double> detection_threshold(const std::string& afferent, double f) {
    return find_threshold(
        1e-4, 4, 14, SearchScale::logarithmic,
        [&](double amplitude) {
            return TrialSpec{afferent,
                             "sine",
                             {fmt::format("sine.f={}", f), fmt::format("sine.F_amp={}", amplitude), "sine.F_mean=0.2", "sine.duration=1"},
                             20e3};
        },
        [](const std::vector<double>& spikes) { return measure<SpikeCount>(spikes, {0.5, 1.0}) > 0; });
}

/// tuning_sa1 ...: the threshold (mN) over the frequency (Hz), without the frequencies that have none.
Result<StudyValues> compute_values(const StudyOptions& options) {
    StudyValues out;
    for (const char* afferent : {"sa1", "fa1", "fa2"}) {
        StudyCurve tuning;
        for (const double f : {4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 200.0, 250.0, 300.0, 400.0, 600.0}) {
            const auto amplitude = TRY(detection_threshold(afferent, f));
            if (amplitude < 4) tuning.x.push_back(f), tuning.y.push_back(1e3 * amplitude);
            TRY(options.report_progress(0));
        }
        out.emplace(fmt::format("tuning_{}", afferent), std::move(tuning));
    }
    return out;
}

}  // namespace corpuscle::studies::nerve
