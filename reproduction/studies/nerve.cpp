// Published properties of the nerve compared with the named afferents. Where a paper gives a shape and no number, the bounds are our
// choice.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "measure/measures.hpp"
#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/trial.hpp"

namespace corpuscle::studies::nerve {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The smallest amplitude (N) of a sine of `f` (Hz) that evokes a spike after the first 0.5 s, by bisection on a logarithmic scale;
/// 4 N if no amplitude below does. `rate` is in Hz.
Result<double> detection_threshold(const std::string& afferent, double f, double rate) {
    double low = 1e-4, high = 4;
    for (int k = 0; k < 14; ++k) {
        const double middle = std::sqrt(low * high);
        const auto train =
            simulate_train({afferent,
                            "sine",
                            {fmt::format("sine.f={}", f), fmt::format("sine.F_amp={}", middle), "sine.F_mean=0.2", "sine.duration=1"},
                            rate});
        if (!train) return train.error();
        (measure<SpikeCount>(*train, {0.5, 1.0}) > 0 ? high : low) = middle;
    }
    return high;
}

/// The detection threshold (mN) over the frequency (Hz), without the frequencies that have none. `done` is the completed fraction of the
/// study.
Result<StudyPlot::Series> tuning_curve(const std::string& afferent, const StudyOptions& options, double& done) {
    StudyPlot::Series curve{afferent, {}, {}, StudyPlot::Style::line};
    for (const double f : {4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 200.0, 250.0, 300.0, 400.0, 600.0}) {
        const auto amplitude = detection_threshold(afferent, f, 20e3);
        if (!amplitude) return amplitude.error();
        if (*amplitude < 4) curve.x.push_back(f), curve.y.push_back(1e3 * *amplitude);
        if (!options.should_continue(done += 1.0 / 33)) return Error{ErrorCode::interrupted, "interrupted"};
    }
    return curve;
}

/// The lowest and the highest frequency (Hz) at which the threshold is at most a tenth above its minimum; NaN for an empty curve.
std::pair<double, double> most_sensitive_band(const StudyPlot::Series& curve) {
    std::pair band{none, none};
    if (curve.y.empty()) return band;
    const double smallest = *std::min_element(curve.y.begin(), curve.y.end());
    for (std::size_t k = 0; k < curve.x.size(); ++k)
        if (curve.y[k] <= 1.1 * smallest) band = {std::isnan(band.first) ? curve.x[k] : band.first, curve.x[k]};
    return band;
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    StudyPlot plot{"Detection threshold of vibration", "frequency (Hz)", "amplitude (mN)", {}, true, true};
    double done = 0;
    for (const auto& [name, low, high, source] :
         {std::tuple{"sa1", none, 60.0, "SA lowest: Johansson et al. 1982, Brain Res 244:17"},
          {"fa1", 8.0, 64.0, "RA most excitable at 8 to 64 Hz: Johansson et al. 1982, Brain Res 244:17"},
          {"fa2", 200.0, 300.0, "PC best at 200 to 300 Hz: PMC2657072, table 1"}}) {
        auto curve = tuning_curve(name, options, done);
        if (!curve) return curve.error();
        const auto [from, to] = most_sensitive_band(*curve);
        for (const auto& [end, f] : {std::pair{"from", from}, {"to", to}})
            out.claim(fmt::format("{}: most sensitive {}", name, end), f, "Hz")
                .allow_range(low, high, source)
                .explain_if_needed(
                    "above the corners of their high-passes sa1 and fa1 are equally sensitive to all frequencies: the low-pass of the skin "
                    "is not modelled");
        plot.series.push_back(std::move(*curve));
    }
    out.plots.push_back(std::move(plot));
    out.notes = {
        "The papers displace the skin; here the stimulus is a force that oscillates about 0.2 N, the smallest that the models are fitted "
        "to. The skin's mechanics, which relate displacement and force, are not modelled.",
        "An afferent counts as most sensitive where its threshold is at most a tenth above its smallest one. A response is a spike between "
        "0.5 and 1 s.",
        "sa1 and fa1 are the thesis's models. They rectify behind their high-passes, so any vibration above the corner adds the same mean "
        "current and they are equally sensitive to all such frequencies. The nerve is not: the skin and the receptor are low-passes, which "
        "these models leave out."};
    return out;
}

const Study study{"nerve", "Published vibration sensitivity of the nerve",
                  "To which vibration is each class most sensitive? Johansson et al. 1982; for the press stimulus see fig5", compute};

}  // namespace corpuscle::studies::nerve
