// The responses of the built-in skins to contact, texture, gratings and slip, for the study touch.

#include <fmt/format.h>

#include "core/random.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/nerve/grating_trials.hpp"
#include "reproduction/skin/hand_contact.hpp"
#include "reproduction/skin/slip_experiment.hpp"

namespace corpuscle::studies::touch {

constexpr std::size_t sliding_trials = 150, resting_trials = 90, folds = 5;

/// Values of a contact with this force (N): FAI_under_tip_50, FAII_near_tip_50, FAII_hand_tip_50 (fractions) and FAI_latency_tip_50,
/// FAII_latency_tip_50 (s), where tip is a key of the place and 50 the force in mN.
Result<void> add_contacts(StudyValues& out, const std::shared_ptr<const Innervation>& hand) {
    for (const auto& [key, region] : {std::pair{"tip", "index.tip"}, {"palm", "palm"}})
        for (const double force : {0.05, 1.0}) {
            const auto r = TRY(measure_contact(hand, region, force));
            const auto add = [&](const char* name, double value) {
                out.emplace(fmt::format("{}_{}_{:.0f}", name, key, 1e3 * force), value);
            };
            add("FAI_under", r.fa1_under), add("FAII_near", r.fa2_near), add("FAII_hand", r.fa2_hand);
            add("FAI_latency", r.fa1_latency), add("FAII_latency", r.fa2_latency);
            add("FAI_count", static_cast<double>(r.fa1_count)), add("FAII_count", static_cast<double>(r.fa2_count));
        }
    return {};
}

/// Values of the touch texture: rough_sa1 (spikes), rough_rate_sa1 (Hz, the mean of all afferents of the hand) and rough_silent_sa1 (a
/// fraction). The same with smooth instead of rough are those of the same stroke with a smooth surface.
Result<void> add_texture(StudyValues& out, const std::shared_ptr<const Innervation>& hand) {
    for (const auto& [key, roughness] : {std::pair{"rough", 0.03}, {"smooth", 0.0}})
        for (const auto& r : TRY(measure_sliding(hand, roughness))) {
            out.emplace(fmt::format("{}_{}", key, r.afferent), r.spikes);
            out.emplace(fmt::format("{}_rate_{}", key, r.afferent), r.rate);
            out.emplace(fmt::format("{}_silent_{}", key, r.afferent), r.silent_fraction);
        }
    return {};
}

/// Gives the labels of the trials to other trials at random (Fisher and Yates), so that they say nothing about the features.
void permute_labels(std::vector<ReadoutTrial>& trials) {
    constexpr auto purpose = static_cast<std::uint32_t>(stream_id("permuted labels"));
    for (std::size_t k = trials.size(); k-- > 1;) {
        const auto w = philox({static_cast<std::uint32_t>(k), 0, 0, purpose}, 1);
        const auto other = static_cast<std::size_t>(unit_interval(w[0], w[1]) * static_cast<double>(k + 1));
        std::swap(trials[k].label, trials[other].label);
    }
}

/// Values of a read-out of the period: accuracies grating_sa1, grating_known_sa1, resting_sa1 ("all": all classes), and the curves
/// grating_curve_sa1 over the time in which spikes are counted (ms).
Result<void> add_gratings(StudyValues& out, const std::shared_ptr<const Innervation>& tip, const StudyOptions& options) {
    const auto sliding = TRY(simulate_gratings(tip, sliding_trials, true, 1));
    TRY(options.report_progress(0.7));
    const auto resting = TRY(simulate_gratings(tip, resting_trials, false, 2));
    const auto accuracy = [&](const auto& trials, std::string_view name, double duration, bool knows_speed) {
        return readout_accuracy(spike_counts(*tip, trials, name, duration, knows_speed), folds, grating_periods.size());
    };
    for (const std::string key : {"sa1", "fa1", "fa2", "all"}) {
        const std::string name = key == "all" ? "" : key;
        StudyCurve curve;
        for (const double duration : {0.025, 0.05, 0.1, grating_counted})
            curve.x.push_back(1e3 * duration), curve.y.push_back(accuracy(sliding, name, duration, false));
        out.emplace("grating_" + key, curve.y.back()), out.emplace("grating_curve_" + key, std::move(curve));
        out.emplace("grating_known_" + key, accuracy(sliding, name, grating_counted, true));
        out.emplace("resting_" + key, accuracy(resting, name, grating_counted, false));
        TRY(options.report_progress(0.8));
    }
    auto shuffled = spike_counts(*tip, sliding, "", grating_counted, false);
    permute_labels(shuffled);
    out.emplace("grating_shuffled", readout_accuracy(shuffled, folds, grating_periods.size()));
    out.emplace("sliding_trials", static_cast<double>(sliding_trials)), out.emplace("resting_trials", static_cast<double>(resting_trials));
    return {};
}

/// Values of a lift after a pull: partial_sa1 (afferents), partial_without_sa1, partial_only_sa1, partial_spikes_sa1,
/// partial_spikes_without_sa1, and the same with full for the time when everything slips.
Result<void> add_slip(StudyValues& out, const std::shared_ptr<const Innervation>& tip) {
    for (const auto& r : TRY(measure_slip(tip)))
        for (const auto& [key, part] : {std::pair{"partial", r.partial}, {"full", r.full}}) {
            out.emplace(fmt::format("{}_{}", key, r.afferent), part.afferents);
            out.emplace(fmt::format("{}_without_{}", key, r.afferent), part.afferents_without);
            out.emplace(fmt::format("{}_only_{}", key, r.afferent), part.only);
            out.emplace(fmt::format("{}_spikes_{}", key, r.afferent), part.spikes);
            out.emplace(fmt::format("{}_spikes_without_{}", key, r.afferent), part.spikes_without);
        }
    out.emplace("full_slip_time", time_to_full_slip());
    return {};
}

Result<StudyValues> compute_values(const StudyOptions& options) {
    StudyValues out;
    const auto hand = TRY(skin_without_conduction("hand")), tip = TRY(skin_without_conduction("fingertip"));
    TRY(add_contacts(out, hand));
    TRY(options.report_progress(0.1));
    TRY(add_texture(out, hand));
    TRY(add_slip(out, tip));
    TRY(options.report_progress(0.2));
    TRY(add_gratings(out, tip, options));
    return out;
}

}  // namespace corpuscle::studies::touch
