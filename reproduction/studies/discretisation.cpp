// Error of the thesis's 1 ms step and backward Euler method: filters, currents and spikes of Algorithms 4 to 6 at three steps, compared
// with the exact equations.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "reproduction/claims/studies.hpp"
#include "reproduction/thesis/press.hpp"

namespace corpuscle::studies::discretisation {

constexpr double steps[] = {1e-3, 1e-4, 1e-5}, fine = 1e-5;  // s; the exact solution is sampled at `fine`
constexpr const char* tenfold = "thesis 3.2: Euler's backward method, of first order: a tenth of the step gives a tenth of the error";
/// Threshold theta and reset voltage u_rst, V: those of fig. 16, our choice, and a third pair. The thesis gives none for SA-I and FA-I
/// (errata B10a).
constexpr std::pair<double, double> threshold_pairs[] = {{1, 0.5}, {0.5, 0.25}, {0.2, 0}};

/// Largest difference of a coarse trace from the exact one (sampled at `fine`), at the samples of the coarse trace, over the largest
/// absolute value of the exact one.
double relative_error(const StudyCurve& rough, const StudyCurve& exact) {
    const auto stride = static_cast<std::size_t>(std::lround((rough.x[1] - rough.x[0]) / fine));
    double largest = 0;
    for (std::size_t k = 0; k < rough.y.size(); ++k) largest = std::max(largest, std::abs(rough.y[k] - exact.y[k * stride]));
    return largest / exact.absolute().max();
}

/// Largest time difference (s) between the spikes of two trains, k-th against k-th; NaN if the trains have different numbers of spikes.
double largest_time_difference(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return Claim::none;
    double out = 0;
    for (std::size_t k = 0; k < a.size(); ++k) out = std::max(out, std::abs(a[k] - b[k]));
    return out;
}

Result<TrialResult> simulate_at_step(const char* afferent, double T, bool exact, const std::pair<double, double>& thresholds,
                                     std::vector<std::string> probes = {}) {
    return run_trial(
        {.afferent = afferent,
         .settings = {fmt::format("{}.V_th={}", afferent, thresholds.first), fmt::format("{}.V_reset={}", afferent, thresholds.second)},
         .rate = 1 / T,
         .probes = std::move(probes),
         .method = exact ? Method::exact : Method::backward_euler,
         .sampled = !exact});
}

/// `errors` at the three steps, in `unit`.
void add_claims(StudyResult& out, StudyPlot& plot, const std::string& quantity, const double (&errors)[3], const char* unit) {
    StudyCurve line;
    for (int k = 0; k < 3; ++k) {
        auto& c = out.claim(fmt::format("{}, T = {} ms", quantity, 1e3 * steps[k]), errors[k], unit);
        if (std::isnan(errors[k])) c.explain("this step gives another number of spikes than the exact solution");
        line.x.push_back(1e3 * steps[k]), line.y.push_back(unit == std::string_view("s") ? errors[k] * 1e3 : errors[k]);
    }
    out.claim(quantity + ": error at 1 ms over error at 0.1 ms", errors[0] / errors[1])
        .allow_range(5, 20, std::string(tenfold) + "; the bounds 5 and 20 are our choice")
        .of_kind(ClaimKind::identity);
    out.claim(quantity + ": error at 0.1 ms over error at 0.01 ms", errors[1] / errors[2])
        .allow_range(5, 20, std::string(tenfold) + "; the bounds 5 and 20 are our choice")
        .of_kind(ClaimKind::identity);
    plot.add(quantity, line);
}

/// Error of one recorded current at the three steps.
Result<void> report_current(StudyResult& out, StudyPlot& plot, const char* afferent, const char* probe, const std::string& quantity) {
    const auto exact = TRY(simulate_at_step(afferent, fine, true, threshold_pairs[1], {probe}));
    double errors[3];
    for (int k = 0; k < 3; ++k) {
        const auto rough = TRY(simulate_at_step(afferent, steps[k], false, threshold_pairs[1], {probe}));
        errors[k] = 100 * relative_error(rough.probes.at(probe), exact.probes.at(probe));
    }
    add_claims(out, plot, quantity, errors, "%");
    return {};
}

/// The largest spike time error over the three threshold pairs, at three steps.
Result<void> report_spikes(StudyResult& out, StudyPlot& plot, const char* afferent) {
    double errors[3] = {};
    for (const auto& thresholds : threshold_pairs) {
        const auto exact = TRY(simulate_at_step(afferent, fine, true, thresholds));
        for (int k = 0; k < 3; ++k) {
            const auto rough = TRY(simulate_at_step(afferent, steps[k], false, thresholds));
            const double difference = largest_time_difference(rough.spikes, exact.spikes);
            errors[k] = std::isnan(difference) || std::isnan(errors[k]) ? Claim::none : std::max(errors[k], difference);
        }
    }
    add_claims(out, plot, fmt::format("{}: largest spike time error, three pairs of theta and u_rst", afferent), errors, "s");
    return {};
}

Result<StudyResult> compute(const StudyOptions& options) {
    StudyResult out;
    StudyPlot currents{"Error of currents, over their largest value", "T (ms)", "error (%)", {}, true, true},
        spikes{"Largest spike time error", "T (ms)", "error (ms)", {}, true, true};
    TRY(report_current(out, currents, "sa1", "I_B", "high-pass of 20 Hz"));
    TRY(report_current(out, currents, "sa1", "I_C", "high-pass of 2 Hz"));
    TRY(options.report_progress(0.3));
    TRY(report_current(out, currents, "sa1", "I", "SA-I's current"));
    TRY(report_current(out, currents, "fa1", "I", "FA-I's current"));
    TRY(options.report_progress(0.6));
    TRY(report_spikes(out, spikes, "sa1"));
    TRY(report_spikes(out, spikes, "fa1"));
    out.plots = {std::move(currents), std::move(spikes)};
    out.note(
        "FA-I's largest error is at the last spike of a decay, where the current is little above the leak, so that a small error of charge "
        "is a large error of time.");
    out.note(
        "Each step must give as many spikes as the exact solution; otherwise no error is defined. The exact reference is the model at 0.01 "
        "ms, whose error falls with the square of its step (test/model/thesis_test.cpp compares it with the closed form).");
    return out;
}

const Study study{"discretisation", "Error of a step of 1 ms",
                  "The thesis solves its equations by Euler's backward method at T = 1 ms: how large is the error of its currents and "
                  "spikes? Thesis 3.2 to 3.4",
                  ClaimKind::predicted, compute};

}  // namespace corpuscle::studies::discretisation
