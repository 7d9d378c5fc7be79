// How many bits and how many samples a second the mixed-signal way needs (thesis 1.3, fig. 6a): sa1 and fa1 behind a converter, their
// spikes held against those of the same equations in double precision at 10 kHz.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "measure/distance.hpp"
#include "study/studies.hpp"
#include "study/trains.hpp"

namespace corpuscle::studies::fig6 {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Apart {
    double worst = 0, rms = 0;  ///< s, of spikes that stand for each other
    double unmatched = 0;
};

/// Spikes within 50 ms can stand for each other.
Result<Apart> apart(const std::vector<double>& exact, const std::vector<double>& digital) {
    const auto alignment = align(exact, digital, 2 / 50e-3);
    if (!alignment) return alignment.error();
    Apart out;
    double squares = 0;
    for (const auto& m : alignment->moved) {
        const double off = std::abs(exact[m.a] - digital[m.b]);
        out.worst = std::max(out.worst, off);
        squares += off * off;
    }
    if (!alignment->moved.empty()) out.rms = std::sqrt(squares / static_cast<double>(alignment->moved.size()));
    out.unmatched = static_cast<double>(exact.size() + digital.size() - 2 * alignment->moved.size());
    return out;
}

Result<Apart> digital(const std::string& name, double bits, double rate) {
    const auto exact = train_of({name});
    if (!exact) return exact.error();
    const auto of = "adc+" + name;
    const auto train = train_of({of, "press", {fmt::format("{}.bits={}", of, bits), fmt::format("{}.f_s={}", of, rate)}});
    if (!train) return train.error();
    return apart(*exact, *train);
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    const double all_bits[] = {4, 6, 8, 10, 12, 14, 16}, rates[] = {100, 200, 500, 1e3, 2e3, 5e3, 10e3};
    Plot by_bits{"Error of spike times against bits, at 10 kHz", "bits", "rms error (ms)", {}, false, true};
    Plot by_rate{"Error of spike times against rate, with 16 bits", "samples a second (Hz)", "rms error (ms)", {}, true, true};
    double done = 0;
    for (const char* name : {"sa1", "fa1"}) {
        Plot::Series bits{name, {}, {}}, rate{name, {}, {}};
        for (const double b : all_bits) {
            const auto a = digital(name, b, 10e3);
            if (!a) return a.error();
            bits.x.push_back(b), bits.y.push_back(1e3 * a->rms);
            out.claims.push_back({fmt::format("{}: {:g} bits, 10 kHz: rms error of spike times", name, b), a->rms, "s", none, none, none,
                                  "", fmt::format("{:g} spikes without a partner", a->unmatched)});
            if (!options.keep_on(done += 1.0 / 28)) return Error{Code::interrupted, "interrupted"};
        }
        for (const double f : rates) {
            const auto a = digital(name, 16, f);
            if (!a) return a.error();
            rate.x.push_back(f), rate.y.push_back(1e3 * a->rms);
            out.claims.push_back({fmt::format("{}: 16 bits, {}: rms error of spike times", name,
                                              f < 1e3 ? fmt::format("{:g} Hz", f) : fmt::format("{:g} kHz", f / 1e3)),
                                  a->rms, "s", none, none, none, "", fmt::format("{:g} spikes without a partner", a->unmatched)});
            if (!options.keep_on(done += 1.0 / 28)) return Error{Code::interrupted, "interrupted"};
        }
        by_bits.series.push_back(std::move(bits)), by_rate.series.push_back(std::move(rate));
    }
    out.plots = {std::move(by_bits), std::move(by_rate)};
    out.notes = {
        "A digital afferent's spikes stand on its samples: up to a period late, 58 % of it rms, by its grid alone; backward Euler, which "
        "takes a "
        "step's current from its end, is early by about half of one, and some of it cancels.",
        "Words are 32 bits with 20 behind the point here; the converter spans 0 to 5 N. Spikes further than 50 ms apart are not taken "
        "for each other."};
    return out;
}

const Study study{"fig6", "Bits and rate of a digital afferent, and the time of its spikes",
                  "How many bits and how many samples a second does the mixed-signal way need? Thesis 1.3, fig. 6a against 6b", work};

}  // namespace corpuscle::studies::fig6
