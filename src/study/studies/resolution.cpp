// What conversion and quantization cost the mixed-signal way (thesis 1.3): the spikes of sa1 and fa1 behind a converter of so many bits and
// samples a second, against those of the same equations in double precision at 10 kHz.

#include <fmt/format.h>

#include "study/apart.hpp"
#include "study/studies.hpp"
#include "study/trains.hpp"

namespace corpuscle::studies::resolution {

Result<Apart> digital(const std::string& name, double bits, double rate) {
    const auto exact = train_of({name});
    if (!exact) return exact.error();
    const auto of = "adc+" + name;
    const auto train = train_of({of, "press", {fmt::format("{}.bits={}", of, bits), fmt::format("{}.f_s={}", of, rate)}});
    if (!train) return train.error();
    return apart(*exact, *train);
}

std::string hertz(double f) { return f < 1e3 ? fmt::format("{:g} Hz", f) : fmt::format("{:g} kHz", f / 1e3); }

/// One point of a curve, and its claim.
Result<void> tell(Outcome& out, Line& curve, double x, const std::string& name, double bits, double rate) {
    const auto a = digital(name, bits, rate);
    if (!a) return a.error();
    curve.x.push_back(x), curve.y.push_back(1e3 * a->rms);
    out.claim(fmt::format("{}: {:g} bits, {}: rms error of spike times", name, bits, hertz(rate)), a->rms, "s")
        .because(fmt::format("{:g} spikes without a partner", a->unmatched));
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const double all_bits[] = {4, 6, 8, 10, 12, 14, 16}, rates[] = {100, 200, 500, 1e3, 2e3, 5e3, 10e3};
    Plot by_bits{"Error of spike times against bits, at 10 kHz", "bits", "rms error (ms)", {}, false, true};
    Plot by_rate{"Error of spike times against rate, with 16 bits", "samples a second (Hz)", "rms error (ms)", {}, true, true};
    double done = 0;
    for (const char* name : {"sa1", "fa1"}) {
        Line bits, rate;
        for (const double b : all_bits) {
            if (auto ok = tell(out, bits, b, name, b, 10e3); !ok) return ok.error();
            if (auto ok = options.at(done += 1.0 / 28); !ok) return ok.error();
        }
        for (const double f : rates) {
            if (auto ok = tell(out, rate, f, name, 16, f); !ok) return ok.error();
            if (auto ok = options.at(done += 1.0 / 28); !ok) return ok.error();
        }
        out.finds(fmt::format("{}: fewer bits and fewer samples lose resolution", name),
                  bits.y.front() > bits.y.back() && rate.y.front() > rate.y.back(),
                  "thesis 1.3: signal resolution loss due to conversion and quantization");
        by_bits.add(name, bits), by_rate.add(name, rate);
    }
    out.plots = {std::move(by_bits), std::move(by_rate)};
    out.note(
        "A digital afferent's spikes stand on its samples: up to a period late, 58 % of it rms, by its grid alone; backward Euler, which "
        "takes a "
        "step's current from its end, is early by about half of one, and some of it cancels.");
    out.note(
        "Words are 32 bits with 20 behind the point here; the converter spans 0 to 5 N. Spikes further than 50 ms apart are not taken for "
        "each "
        "other.");
    return out;
}

const Study study{
    "resolution", "Bits and rate of a digital afferent, and the time of its spikes",
    "The mixed-signal way loses resolution by conversion and quantization: how many bits and samples a second does it need? Thesis 1.3, "
    "fig. 6a",
    work};

}  // namespace corpuscle::studies::resolution
