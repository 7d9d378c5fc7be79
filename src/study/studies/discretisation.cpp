// What the thesis's 1 ms and its backward Euler cost: filters, currents and spikes of Algorithms 4 to 6 at three steps, against the
// equations.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "study/studies.hpp"
#include "study/thesis/press.hpp"

namespace corpuscle::studies::discretisation {

constexpr double steps[] = {1e-3, 1e-4, 1e-5}, fine = 1e-5;  // s
constexpr const char* tenfold = "thesis 3.2: Euler's backward method, of first order: a tenth of the step, a tenth of the error";
/// theta and u_rst, V: fig. 16's, ours, and a third (errata B10a).
constexpr std::pair<double, double> readings[] = {{1, 0.5}, {0.5, 0.25}, {0.2, 0}};

/// The farthest of a trace from the exact one, at its own samples, as a share of that one's largest.
double apart(const Line& rough, const Line& exact) {
    const auto often = static_cast<std::size_t>(std::lround((rough.x[1] - rough.x[0]) / fine));
    double off = 0;
    for (std::size_t k = 0; k < rough.y.size(); ++k) off = std::max(off, std::abs(rough.y[k] - exact.y[k * often]));
    return off / exact.absolute().most();
}

/// The worst of spikes of the same number; NaN if there are not equally many.
double worst(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return Claim::none;
    double out = 0;
    for (std::size_t k = 0; k < a.size(); ++k) out = std::max(out, std::abs(a[k] - b[k]));
    return out;
}

Result<Told> at_step(const char* afferent, double T, bool exact, const std::pair<double, double>& reading,
                     std::vector<std::string> traces = {}) {
    return told_of(
        {.afferent = afferent,
         .settings = {fmt::format("{}.V_th={}", afferent, reading.first), fmt::format("{}.V_reset={}", afferent, reading.second)},
         .rate = 1 / T,
         .traces = std::move(traces),
         .method = exact ? Method::exact : Method::backward_euler,
         .sampled = !exact});
}

void tell(Outcome& out, Plot& plot, const std::string& what, const double (&errors)[3], const char* unit) {
    Line line;
    for (int k = 0; k < 3; ++k) {
        auto& c = out.claim(fmt::format("{}, T = {} ms", what, 1e3 * steps[k]), errors[k], unit);
        if (std::isnan(errors[k])) c.because("not equally many spikes");
        line.x.push_back(1e3 * steps[k]), line.y.push_back(unit == std::string_view("s") ? errors[k] * 1e3 : errors[k]);
    }
    out.claim(what + ": at 1 ms over that at 0.1 ms", errors[0] / errors[1])
        .between(5, 20, std::string(tenfold) + "; half and twice of it are ours");
    out.claim(what + ": at 0.1 ms over that at 0.01 ms", errors[1] / errors[2])
        .between(5, 20, std::string(tenfold) + "; half and twice of it are ours");
    plot.add(what, line);
}

/// One inner current at three steps.
Result<void> tell_current(Outcome& out, Plot& plot, const char* afferent, const char* trace, const std::string& what) {
    const auto exact = at_step(afferent, fine, true, readings[1], {trace});
    if (!exact) return exact.error();
    double errors[3];
    for (int k = 0; k < 3; ++k) {
        const auto rough = at_step(afferent, steps[k], false, readings[1], {trace});
        if (!rough) return rough.error();
        errors[k] = 100 * apart(rough->traces.at(trace), exact->traces.at(trace));
    }
    tell(out, plot, what, errors, "%");
    return {};
}

/// The worst spike of the three readings at three steps.
Result<void> tell_spikes(Outcome& out, Plot& plot, const char* afferent) {
    double errors[3] = {};
    for (const auto& reading : readings) {
        const auto exact = at_step(afferent, fine, true, reading);
        if (!exact) return exact.error();
        for (int k = 0; k < 3; ++k) {
            const auto rough = at_step(afferent, steps[k], false, reading);
            if (!rough) return rough.error();
            const double w = worst(rough->spikes, exact->spikes);
            errors[k] = std::isnan(w) || std::isnan(errors[k]) ? Claim::none : std::max(errors[k], w);
        }
    }
    tell(out, plot, fmt::format("{}: worst spike of three readings of theta", afferent), errors, "s");
    return {};
}

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    Plot currents{"Error of currents, of their largest", "T (ms)", "error (%)", {}, true, true},
        spikes{"Worst spike", "T (ms)", "error (ms)", {}, true, true};
    if (auto ok = tell_current(out, currents, "sa1", "I_B", "high-pass of 20 Hz"); !ok) return ok.error();
    if (auto ok = tell_current(out, currents, "sa1", "I_C", "high-pass of 2 Hz"); !ok) return ok.error();
    if (auto ok = options.at(0.3); !ok) return ok.error();
    if (auto ok = tell_current(out, currents, "sa1", "I", "SA-I's current"); !ok) return ok.error();
    if (auto ok = tell_current(out, currents, "fa1", "I", "FA-I's current"); !ok) return ok.error();
    if (auto ok = options.at(0.6); !ok) return ok.error();
    if (auto ok = tell_spikes(out, spikes, "sa1"); !ok) return ok.error();
    if (auto ok = tell_spikes(out, spikes, "fa1"); !ok) return ok.error();
    out.plots = {std::move(currents), std::move(spikes)};
    out.note("FA-I's worst spike is the last of a tail, where the current is little above the leak and a small charge takes long.");
    out.note(
        "Equal numbers of spikes at all three steps are part of this: else there is no worst one. What is exact here is the model at 0.01 "
        "ms, whose "
        "error falls with the square of its step (test/model/thesis_test.cpp holds it against the closed form).");
    return out;
}

const Study study{
    "discretisation", "What a step of 1 ms costs",
    "The thesis solves its equations by Euler's backward method at T = 1 ms: how far are its currents and spikes from the equations'? "
    "Thesis 3.2 to 3.4",
    work};

}  // namespace corpuscle::studies::discretisation
