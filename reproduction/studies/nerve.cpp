// The detection thresholds of vibration of the thesis's afferents, and the responses of the calibrated ones to vibration, holds and a small
// probe, for the study nerve.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/median.hpp"
#include "measure/measures.hpp"
#include "reproduction/claims/claim.hpp"
#include "reproduction/claims/sample_statistics.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/nerve/graded_trials.hpp"
#include "reproduction/nerve/vibration_response.hpp"
#include "reproduction/skin/small_probe.hpp"
#include "reproduction/thesis/press.hpp"
#include "reproduction/thesis/threshold_search.hpp"

namespace corpuscle::studies::nerve {

struct NerveAfferent {
    const char *key, *name;  ///< key: in the names of values
    std::size_t copies;      ///< in a vibration; more than one if the intervals are irregular
};
constexpr NerveAfferent nerve_afferents[] = {{"SAI", "sa1-nerve", 4}, {"SAII", "sa2", 4}, {"FAI", "fa1-nerve", 1}, {"FAII", "fa2", 1}};
constexpr double frequencies[] = {2,  3,  4,  6,   8,   10,  12,  15,  20,  25,  30,  35,  40,
                                  50, 60, 80, 100, 125, 150, 200, 250, 300, 400, 500, 600, 800};  // Hz

/// The smallest amplitude (N) of a sine of `f` (Hz) that evokes a spike after the first 0.5 s; 4 N if no amplitude below does.
Result<double> thesis_threshold(const std::string& afferent, double f) {
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

/// tuning_sa1, tuning_fa1: the threshold (mN) over the frequency (Hz), without the frequencies that have none.
Result<void> add_thesis_thresholds(StudyValues& out, const StudyOptions& options) {
    for (const char* afferent : {"sa1", "fa1"}) {
        StudyCurve tuning;
        for (const double f : {4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 200.0, 250.0, 300.0, 400.0, 600.0}) {
            const auto amplitude = TRY(thesis_threshold(afferent, f));
            if (amplitude < 4) tuning.x.push_back(f), tuning.y.push_back(1e3 * amplitude);
            TRY(options.report_progress(0));
        }
        out.emplace(fmt::format("tuning_{}", afferent), std::move(tuning));
    }
    return {};
}

/// Adds curves over the frequency (Hz). The curve tuning_FAI is the least amplitude (mN) with a spike per cycle, and
/// detection_FAI the least one with a spike. The curves low_FAI and
/// high_FAI are the ends (mN) of the widest range of amplitudes with exactly one spike in each cycle. The curve strength_FAI is the
/// smallest vector strength within it.
void add_curves(StudyValues& out, const std::string& key, const std::vector<VibrationResponse>& vibrations) {
    StudyCurve tuning, detection, low, high, strength;
    const auto add = [](StudyCurve& curve, double f, double y) {
        if (!std::isnan(y)) curve.x.push_back(f), curve.y.push_back(y);
    };
    for (const auto& v : vibrations) {
        const auto plateau = v.plateau();
        add(tuning, v.f, 1e3 * v.threshold()), add(detection, v.f, 1e3 * v.detection_threshold()), add(low, v.f, 1e3 * plateau.low),
            add(high, v.f, 1e3 * plateau.high);
        add(strength, v.f, plateau.min_vector_strength);
    }
    const double least = 1e-3 * tuning.min();  // N
    out.emplace("excitable_" + key, most_excitable(vibrations, 1.25 * least));
    out.emplace("excitable_strong_" + key, most_excitable(vibrations, 12.5 * least));
    out.emplace("detection_" + key, std::move(detection));
    out.emplace("tuning_" + key, std::move(tuning)), out.emplace("strength_" + key, std::move(strength));
    out.emplace("low_" + key, std::move(low)), out.emplace("high_" + key, std::move(high));
}

/// Adds curves and numbers of each calibrated afferent under vibration. The shortest interval in all of these trials is shortest_FAI, s.
Result<void> add_vibration(StudyValues& out, const StudyOptions& options) {
    for (const auto& a : nerve_afferents) {
        std::vector<VibrationResponse> vibrations;
        for (const double f : frequencies) {
            vibrations.push_back(TRY(vibrate(a.name, f, a.copies)));
            TRY(options.report_progress(0));
        }
        add_curves(out, a.key, vibrations);
        double shortest = vibrations.front().shortest_interval;
        for (const auto& v : vibrations) shortest = std::min(shortest, v.shortest_interval);
        out.emplace(fmt::format("shortest_{}", a.key), shortest);
    }
    return {};
}

/// The median over the copies of a measure; NaN if a copy has none.
template <class F>
double median_over(const std::vector<std::vector<double>>& trains, F measure_of) {
    std::vector<double> all;
    for (const auto& t : trains) all.push_back(measure_of(t));
    const bool undefined = std::any_of(all.begin(), all.end(), [](double v) { return std::isnan(v); });
    return undefined ? Claim::none : median_of(all);
}

/// Adds numbers of the slowly adapting afferents at 4 N, as medians of 64 copies. The highest instantaneous frequency in the protraction of
/// the press stimulus is peak_SAI, and the mean rate in the last 100 ms of its plateau is hold_SAI, both in Hz. The rate from 5 to 6 s of
/// a hold over that from 0.5 to 1.5 s is adaptation_SAI. The coefficient of variation of the intervals in the hold from 2 s on is
/// variation_SAI.
Result<void> add_holds(StudyValues& out) {
    const std::vector<double> four_newtons(64, 4);
    constexpr double begin = 0.25 + 0.125;  // s: of the hold
    const auto rate = [](double from, double to) {
        return [=](const auto& t) { return measure<MeanRate>(t, {begin + from, begin + to}); };
    };
    for (const char* key : {"SAI", "SAII"}) {
        const std::string afferent = key == std::string_view("SAI") ? "sa1-nerve" : "sa2";
        const auto pressed = TRY(simulate_factors({afferent, "press", {"press.F_max=1", "press.F_min=0.05"}}, four_newtons));
        const auto held = TRY(simulate_factors({afferent, "ramp-hold", {"ramp-hold.t_up=0.125", "ramp-hold.t_hold=6"}, 5e3}, four_newtons));
        out.emplace(fmt::format("peak_{}", key),
                    median_over(pressed, [](const auto& t) { return measure<PeakRate>(t, press::protraction); }));
        out.emplace(fmt::format("hold_{}", key),
                    median_over(pressed, [](const auto& t) { return measure<MeanRate>(t, press::plateau_end); }));
        out.emplace(fmt::format("adaptation_{}", key), median_over(held, rate(5, 6)) / median_over(held, rate(0.5, 1.5)));
        out.emplace(fmt::format("variation_{}", key),
                    median_over(held, [](const auto& t) { return measure<IntervalVariation>(t, {begin + 2, begin + 6}); }));
    }
    return {};
}

/// The standardised third moment; 0 for a symmetric distribution.
double skewness(const std::vector<double>& values) {
    const auto all = sample_statistics(values);
    double sum = 0;
    for (const double v : values) sum += std::pow((v - all.mean) / all.standard_deviation, 3);
    return sum / static_cast<double>(values.size());
}

/// The value below which this fraction of the sorted values lies, at least; NaN if there are none.
double quantile(const std::vector<double>& sorted, double fraction) {
    return sorted.empty() ? Claim::none : sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1) + 0.5)];
}

/// Adds numbers of one class of the fingertip under a small probe. The median of the least forces is probe_FAI, and their quantiles of 10
/// and 90 % are probe_low_FAI and probe_high_FAI, all in N. The fraction above 5 mN is probe_above_FAI; afferents that never fire count.
/// The skewness of the logarithms is probe_skew_FAI. The curve probe_curve_FAI is the fraction of the afferents over the force (mN). Median
/// and quantiles of the areas of the fields are field_FAI, field_low_FAI and field_high_FAI, mm2.
void add_probed_class(StudyValues& out, const std::string& key, ProbedClass probed) {
    std::vector<double> forces, logarithms;
    for (const double f : probed.least_force)
        if (!std::isnan(f)) forces.push_back(f), logarithms.push_back(std::log(f));
    std::sort(forces.begin(), forces.end()), std::sort(probed.field_area.begin(), probed.field_area.end());
    const auto all = static_cast<double>(probed.least_force.size());
    const auto below = std::upper_bound(forces.begin(), forces.end(), 5e-3) - forces.begin();
    out.emplace("probe_above_" + key, 1 - static_cast<double>(below) / all);
    out.emplace("probe_skew_" + key, skewness(logarithms));
    for (const auto& [name, fraction] : {std::pair{"", 0.5}, {"low_", 0.1}, {"high_", 0.9}}) {
        out.emplace(fmt::format("probe_{}{}", name, key), quantile(forces, fraction));
        out.emplace(fmt::format("field_{}{}", name, key), 1e6 * quantile(probed.field_area, fraction));
    }
    StudyCurve curve;
    for (std::size_t k = 0; k < forces.size(); ++k) curve.x.push_back(1e3 * forces[k]), curve.y.push_back(static_cast<double>(k + 1) / all);
    out.emplace("probe_curve_" + key, std::move(curve));
}

Result<void> add_probe(StudyValues& out) {
    constexpr std::size_t fields_per_class = 24;
    auto plan = TRY(load_skin_plan("fingertip"));
    const auto fingertip = TRY(innervate(std::move(plan)));
    auto classes = TRY(probe_skin(*fingertip, fields_per_class));
    for (auto& probed : classes) {
        const std::string key =
            fmt::format("{}{}", probed.afferent.starts_with("sa") ? "SA" : "FA", probed.afferent.ends_with('1') ? "I" : "II");
        add_probed_class(out, key, std::move(probed));
    }
    return {};
}

Result<StudyValues> compute_values(const StudyOptions& options) {
    StudyValues out;
    TRY(add_thesis_thresholds(out, options));
    TRY(add_vibration(out, options));
    TRY(add_holds(out));
    TRY(add_probe(out));
    return out;
}

}  // namespace corpuscle::studies::nerve
