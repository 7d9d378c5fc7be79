// Effect of conversion and quantisation on the mixed-signal implementation (thesis 1.3). The spikes of sa1 and fa1 behind a converter with
// a given number of bits and sampling rate are compared with those of the same equations in double precision at 10 kHz.

#include <fmt/format.h>

#include "reproduction/claims/studies.hpp"
#include "reproduction/claims/trial.hpp"
#include "reproduction/thesis/spike_timing_error.hpp"

namespace corpuscle::studies::resolution {

/// The timing error of an afferent behind a converter, relative to the same afferent without converter. `rate` is the sampling rate, Hz.
Result<SpikeTimingError> digital_timing_error(const std::string& name, double bits, double rate) {
    const auto exact = simulate_train({name});
    if (!exact) return exact.error();
    const auto afferent = "adc+" + name;
    const auto train =
        simulate_train({afferent, "press", {fmt::format("{}.bits={}", afferent, bits), fmt::format("{}.f_s={}", afferent, rate)}});
    if (!train) return train.error();
    return spike_timing_error(*exact, *train);
}

std::string frequency_text(double f) { return f < 1e3 ? fmt::format("{:g} Hz", f) : fmt::format("{:g} kHz", f / 1e3); }

/// Adds the claim on the rms error for these bits and this rate, and the point (x, error in ms) of a curve.
Result<void> add_point(StudyResult& out, StudyCurve& curve, double x, const std::string& name, double bits, double rate) {
    const auto a = digital_timing_error(name, bits, rate);
    if (!a) return a.error();
    curve.x.push_back(x), curve.y.push_back(1e3 * a->rms);
    out.claim(fmt::format("{}: {:g} bits, {}: rms error of spike times", name, bits, frequency_text(rate)), a->rms, "s")
        .explain(fmt::format("{:g} spikes of the two trains have no partner within 50 ms", a->unmatched));
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    const double all_bits[] = {4, 6, 8, 10, 12, 14, 16}, rates[] = {100, 200, 500, 1e3, 2e3, 5e3, 10e3};
    StudyPlot by_bits{"Error of spike times over bits, at 10 kHz", "bits", "rms error (ms)", {}, false, true};
    StudyPlot by_rate{"Error of spike times over sampling rate, with 16 bits", "sampling rate (Hz)", "rms error (ms)", {}, true, true};
    double done = 0;
    for (const char* name : {"sa1", "fa1"}) {
        StudyCurve bits, rate;
        for (const double b : all_bits) {
            if (auto ok = add_point(out, bits, b, name, b, 10e3); !ok) return ok.error();
            if (auto ok = options.report_progress(done += 1.0 / 28); !ok) return ok.error();
        }
        for (const double f : rates) {
            if (auto ok = add_point(out, rate, f, name, 16, f); !ok) return ok.error();
            if (auto ok = options.report_progress(done += 1.0 / 28); !ok) return ok.error();
        }
        out.claim_true(fmt::format("{}: fewer bits and a lower sampling rate increase the error of spike times", name),
                       bits.y.front() > bits.y.back() && rate.y.front() > rate.y.back(),
                       "thesis 1.3: signal resolution loss due to conversion and quantization");
        by_bits.add(name, bits), by_rate.add(name, rate);
    }
    out.plots = {std::move(by_bits), std::move(by_rate)};
    out.note(
        "A digital afferent's spikes are on its samples. This alone makes them up to one period late, 58 % of a period rms. Backward "
        "Euler uses the current at the end of a step, so its spikes are early by about half a step. The two errors partly cancel.");
    out.note(
        "Fixed-point numbers have 32 bits, 20 of them fractional; the converter's range is 0 to 5 N. Spikes more than 50 ms apart are not "
        "matched.");
    return out;
}

const Study study{"resolution", "Effect of bits and sampling rate of a digital afferent on spike times",
                  "The mixed-signal implementation loses resolution by conversion and quantisation: how many bits and samples per second "
                  "does it need? Thesis 1.3, fig. 6a",
                  compute};

}  // namespace corpuscle::studies::resolution
