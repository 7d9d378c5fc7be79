// Comparison with TouchSim, a widely used model of the hand's afferents, within the range that it was fitted to: its measured responses
// and those of our fingertip.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/check_all.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/skin/fingertip.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::touchsim {

constexpr auto measured = "TouchSim's response, measured: median, noise on";
constexpr double E_star = 1.19 / (2 * 5e-3 * 2e-3);  // Pa: from TouchSim's 1.19 N for a flat punch of 5 mm, 2 mm deep, on a half-space
constexpr TimeWindow end_of_hold{0.575, 0.625};      // s, the last 50 ms of the hold

/// Firing rates (Hz): peak and mean of protraction, mean of the hold and of its last 50 ms, peak and mean of retraction.
struct Rates {
    double up_peak = 0, up = 0, hold = 0, end = 0, down_peak = 0, down = 0;
};
struct RateRow {
    const char* name;
    double Rates::* rate;
};
constexpr RateRow rows[] = {
    {"protraction, peak", &Rates::up_peak}, {"protraction, mean", &Rates::up},       {"hold, mean", &Rates::hold},
    {"hold, last 50 ms", &Rates::end},      {"retraction, peak", &Rates::down_peak}, {"retraction, mean", &Rates::down}};

struct Contact {
    const char* name;
    double radius, depth;     // m: of the punch, of its indentation
    Rates sa1, ra;            // of TouchSim's SA1 and RA afferents
    double Rates::* matched;  // the rate in which find_matching_force matches our SA-I to TouchSim's SA1
};
constexpr Contact contacts[] = {
    {"probe of 0.5 mm, 1 mm deep", 0.5e-3, 1e-3, {92, 60, 43, 43, 41, 13}, {33, 21, 0, 0, 37, 23}, &Rates::hold},
    {"flat of 5 mm, 2 mm deep", 5e-3, 2e-3, {133, 79, 4.9, 5.0, 0, 0.6}, {62, 40, 0, 0, 67, 44}, &Rates::up_peak}};

Rates rates_of(const std::vector<double>& train) {
    const auto mean = [&](const TimeWindow& window) { return press::spike_count(train, window) / (window.to - window.from); };
    const auto peak = [&](const TimeWindow& window) {
        const double x = measure<PeakRate>(train, window);  // NaN if the window has no frequency
        return std::isfinite(x) ? x : 0;
    };
    return {peak(press::protraction), mean(press::protraction), mean(press::plateau),
            mean(end_of_hold),        peak(press::retraction),  mean(press::retraction)};
}

/// The larger one of the two middle values if their number is even.
double median(std::vector<double> v) {
    const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    return *middle;
}

/// The reason for a deviation of our rate from TouchSim's.
const char* reason(const std::string& afferent, const RateRow& row, bool wide_contact) {
    const bool is_retraction = row.rate == &Rates::down_peak || row.rate == &Rates::down,
               is_hold = row.rate == &Rates::hold || row.rate == &Rates::end;
    if (afferent == "sa1" && is_hold && wide_contact)
        return "the mechanics of TouchSim suppress the plateau under a wide flat contact; our afferents respond to the pressure below it, "
               "which persists";
    if (afferent == "sa1" && is_retraction)
        return "the dynamic component of SA-IB is negative for falling force (thesis 3.3); the spikes come from the decaying static "
               "component";
    if (afferent == "sa1") return "the current must exceed the leak first, so firing begins later in the ramp than in TouchSim's SA1";
    if (is_hold) return "the high-pass of 2 Hz continues for about 130 ms after a ramp (errata B13)";
    return "the current must exceed the leak first, so firing begins later than in TouchSim's RA, and is faster afterwards; the gains are "
           "the thesis's (3.4)";
}

constexpr double max_distance = 1.5e-3;  // m: afferents within this distance from the centre of the punch are compared

/// The rates of all afferents of this type within max_distance.
std::vector<Rates> rates_within_distance(const std::vector<FingertipTrain>& trains, const std::string& afferent) {
    std::vector<Rates> out;
    for (const auto& t : trains)
        if (t.afferent == afferent && t.distance <= max_distance) out.push_back(rates_of(t.spikes));
    return out;
}

double median_of(const std::vector<Rates>& all, double Rates::* rate) {
    std::vector<double> values;
    for (const auto& r : all) values.push_back(r.*rate);
    return values.empty() ? 0 : median(std::move(values));
}

/// The force (N) at which the median rate `contact.matched` of our SA-I equals that of TouchSim's SA1, by bisection on a logarithmic scale.
Result<double> find_matching_force(const Contact& contact) {
    double low = 0.01, high = 100;
    for (int k = 0; k < 14; ++k) {
        const double middle = std::sqrt(low * high);
        const auto trains = TRY(simulate_fingertip({contact.radius, middle}));
        (median_of(rates_within_distance(trains, "sa1"), contact.matched) < contact.sa1.*contact.matched ? low : high) = middle;
    }
    return high;
}

void report_row(StudyResult& out, const std::string& name, const RateRow& row, const std::vector<Rates>& ours, const Rates& theirs,
                const char* reason_text) {
    auto& claim = out.claim(fmt::format("{}: {}", name, row.name), median_of(ours, row.rate), "Hz")
                      .derived_as(theirs.*row.rate, measured)
                      .explain_if_needed(reason_text);
    if (theirs.*row.rate == 0 && claim.computed > 0) claim.explain(reason_text);
}

/// Claims at two forces: the equivalent force of TouchSim's indentation, and the force at which our SA-I match its SA1.
Result<void> report_touch(StudyResult& out, const Contact& contact) {
    // N: force of a flat punch of this radius and depth on a half-space
    const double equivalent_force = 2 * E_star * contact.radius * contact.depth;
    const auto matching_force = TRY(find_matching_force(contact));
    const auto equivalent = simulate_fingertip({contact.radius, equivalent_force}),
               matched = simulate_fingertip({contact.radius, matching_force});
    TRY(check_all(equivalent, matched));
    out.claim(fmt::format("{}: equivalent force", contact.name), equivalent_force, "N");
    for (const auto& [afferent, theirs] : {std::pair{"sa1", &contact.sa1}, {"fa1", &contact.ra}})
        report_row(
            out, fmt::format("{} at the equivalent force, {}", contact.name, afferent == std::string("sa1") ? "SA-I" : "FA-I"), rows[0],
            rates_within_distance(*equivalent, afferent), *theirs,
            "the thesis's models are made for 0.2 to 4 N and their leak is a fraction of the current at these forces (study fig3); the "
            "nerve and TouchSim respond to millinewtons");
    out.claim(fmt::format("{}: force at which our SA-I match TouchSim's {}", contact.name,
                          contact.matched == &Rates::hold ? "mean of the hold" : "peak"),
              matching_force, "N")
        .derived_as(equivalent_force, "the equivalent force")
        .explain_if_needed("the models are made for the range of the thesis's stimulus, 0.2 to 4 N");
    for (const auto& [afferent, theirs] : {std::pair{"sa1", &contact.sa1}, {"fa1", &contact.ra}})
        for (const auto& row : rows) {
            // the force was searched for this rate, so its agreement is a fit
            out.next_kind = theirs == &contact.sa1 && row.rate == contact.matched ? std::optional(ClaimKind::fitted) : std::nullopt;
            report_row(out, fmt::format("{} at the matching force, {}", contact.name, afferent == std::string("sa1") ? "SA-I" : "FA-I"),
                       row, rates_within_distance(*matched, afferent), *theirs, reason(afferent, row, contact.radius > 1e-3));
        }
    out.next_kind = {};
    return {};
}

Result<void> report_touches(StudyResult& out, const StudyOptions& options) {
    for (const auto& contact : contacts) {
        TRY(report_touch(out, contact));
        TRY(options.report_progress(0.2 * static_cast<double>(&contact - contacts + 1)));
    }
    return {};
}

/// The smallest amplitude (N) of a sine of `f` (Hz) about a mean of 0.2 N that gives at least one spike, and at least `spikes_per_period`,
/// between 0.5 and 1 s; 4 N if no amplitude below does.
Result<double> detection_threshold(const std::string& afferent, const std::vector<std::string>& settings, double f,
                                   double spikes_per_period) {
    double low = 1e-4, high = 4;
    for (int k = 0; k < 12; ++k) {
        const double middle = std::sqrt(low * high);
        std::vector<std::string> all = {fmt::format("sine.f={}", f), fmt::format("sine.F_amp={}", middle), "sine.F_mean=0.2",
                                        "sine.duration=1"};
        all.insert(all.end(), settings.begin(), settings.end());
        const auto train = TRY(simulate_train({afferent, "sine", all}));
        (press::spike_count(train, {0.5, 1.0}) >= std::max(1.0, spikes_per_period * 0.5 * f) ? high : low) = middle;
    }
    return high;
}

constexpr double frequencies[] = {1, 2, 4, 8, 16, 24, 32, 40, 50, 64, 100, 150, 200, 250, 300, 400};

Result<void> report_tuning(StudyResult& out, const StudyOptions& options) {
    struct Curve {
        const char *name, *afferent;
        std::vector<std::string> settings;
        double spikes_per_period;
    };
    const Curve curves[] = {{"FA-I", "fa1", {}, 0},
                            {"FA-I, one spike per period", "fa1", {}, 1},
                            {"FA-I, its corner at 40 Hz instead of 2", "fa1", {"fa1.f=40Hz"}, 0},
                            {"FA-II", "fa2", {}, 0}};
    StudyPlot plot{"Detection threshold of vibration", "frequency (Hz)", "amplitude (mN)", {}, true, true};
    double done = 0;
    for (const auto& c : curves) {
        StudyCurve line;
        for (const double f : frequencies) {
            const auto smallest = TRY(detection_threshold(c.afferent, c.settings, f, c.spikes_per_period));
            if (smallest < 3.99) line.x.push_back(f), line.y.push_back(1e3 * smallest);
            TRY(options.report_progress(0.4 + 0.6 * (done += 1.0 / 64)));
        }
        // mN at one of the frequencies; NaN if the afferent has no threshold there
        const auto at = [&](double f) {
            const auto found = std::find(line.x.begin(), line.x.end(), f);
            return found == line.x.end() ? Claim::none : line.y[static_cast<std::size_t>(found - line.x.begin())];
        };
        const std::string name = c.name;
        if (name == "FA-II") {
            const auto best = std::min_element(line.y.begin(), line.y.end()) - line.y.begin();
            out.claim("FA-II: most sensitive at", line.x[static_cast<std::size_t>(best)], "Hz")
                .allow_range(200, 300, "PC best at 200 to 300 Hz: PMC2657072, table 1")
                .of_kind(ClaimKind::fitted);
        } else if (c.spikes_per_period == 0) {
            const auto add_ratio = [&](double f) -> Claim& {
                return out.claim(fmt::format("{}: threshold at {} Hz over that at 40 Hz", name, f), at(f) / at(40))
                    .allow_min(1.5, "RA best at 40 to 60 Hz (PMC2657072, table 1): the threshold is higher on either side")
                    .explain_if_needed(
                        "a high-pass has no upper limit: above its corner the mean rectified current is the same at every frequency; the "
                        "low-passes of skin and receptor are not modelled");
            };
            add_ratio(8), add_ratio(200);
        } else {
            const auto count = std::count_if(line.x.begin(), line.x.end(), [](double f) { return f >= 8 && f <= 64; });
            out.claim("FA-I: number of the frequencies 8, 16, 24, 32, 40, 50 and 64 Hz with one spike per period, up to 4 N",
                      static_cast<double>(count))
                .allow_min(1, "RA most excitable at 8 to 64 Hz, entrained: Johansson et al. 1982, Jarvilehto 1976; the bound is our choice")
                .explain_if_needed("the 2 Hz filter and the leak limit the charge, and so the firing rate");
        }
        plot.add(c.name, std::move(line));
    }
    out.plots.push_back(std::move(plot));
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    TRY(report_touches(out, options));
    TRY(report_tuning(out, options));
    out.notes = {fmt::format("TouchSim takes millimetres, our skin newtons. A flat punch on a half-space gives F = 2 E* a d. TouchSim's "
                             "1.19 N for 5 mm and 2 mm gives an E* of {:.3g} kPa, and so a force of {:.3g} mN for its small probe.",
                             E_star * 1e-3, 2e3 * E_star * 0.5e-3 * 1e-3),
                 "The speed of TouchSim's indentations is not recorded with its results; here it is that of the thesis's stimulus, 125 ms "
                 "up, 250 ms hold, 125 ms down, from zero force. Our medians are over the afferents of the built-in fingertip within 1.5 "
                 "mm of the centre of the punch.",
                 "The thesis's FA-I is flat above the 2 Hz of its high-pass, and no parameter tunes it to 20 to 80 Hz. A higher corner "
                 "makes it insensitive below the new corner and leaves it flat above.",
                 "TouchSim's plateau under a wide flat contact is suppressed by construction and is not a target at 4 N."};
    return out;
}

const Study study{"touchsim", "Comparison in TouchSim's fitted range",
                  "How do our SA-I, FA-I and FA-II respond where TouchSim was fitted: a small probe, a flat one, vibration? Saal et al. "
                  "2017; its responses as measured, its tuning as published",
                  ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::touchsim
