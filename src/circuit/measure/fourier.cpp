#include "circuit/measure/fourier.hpp"

#include <numbers>

#include "circuit/measure/measurement.hpp"
#include "circuit/measure/missing_curve.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t harmonic_count = 9;  // as in ngspice
constexpr double turn = 2 * std::numbers::pi, degrees = 180 / std::numbers::pi;

/// The integrals over u from 0 to 1 of exp(-j theta u) and of u exp(-j theta u). Their closed forms are
///
///     a = (1 - e) / (j theta),   b = (a - e) / (j theta),   with e = exp(-j theta)
///
/// Where these cancel, the power series is used.
std::pair<std::complex<double>, std::complex<double>> line_integrals(double theta) {
    const std::complex<double> j(0, 1);
    if (std::abs(theta) > 0.5) {
        const auto e = std::polar(1.0, -theta), a = (1.0 - e) / (j * theta);
        return {a, (a - e) / (j * theta)};
    }
    std::complex<double> term = 1, a = 0, b = 0;  // term: (-j theta)^n / n!
    for (int n = 0; n < 20; ++n) {
        a += term / (n + 1.0), b += term / (n + 2.0);
        term *= -j * theta / (n + 1.0);
    }
    return {a, b};
}

Result<double> read_frequency(const Directive& c, const TransientTimes& times) {
    if (c.words.size() < 2) return error_at(c.location, ".four: expected .four FREQUENCY v(NODE) ...");
    const double f = TRY(read_number(c, 0, "the frequency"));
    if (!(f > 0)) return error_at(c.location_of(0), ".four: the frequency {:g} Hz must be above 0", f);
    const double duration = times.stop - times.start;
    if (1 / f > duration * (1 + 1e-9))
        return error_at(c.location_of(0), ".four: the period of {:g} Hz, {:g} s, is longer than the {:g} s of the .tran", f, 1 / f,
                        duration);
    return f;
}

/// Sets harmonics that are rounding errors to 0; their phases mean nothing.
void remove_rounding(FourierSpectrum& spectrum) {
    double largest = std::abs(spectrum.mean);
    for (const auto& h : spectrum.harmonics) largest = std::max(largest, h.magnitude);
    const double smallest = 1e-14 * largest;
    if (std::abs(spectrum.mean) < smallest) spectrum.mean = 0;
    for (auto& h : spectrum.harmonics)
        if (h.magnitude < smallest) h.magnitude = h.phase = 0;
}

}  // namespace

double FourierSpectrum::distortion() const {
    double squares = 0;
    for (std::size_t k = 1; k < harmonics.size(); ++k) squares += harmonics[k].magnitude * harmonics[k].magnitude;
    return 100 * std::sqrt(squares) / harmonics[0].magnitude;  // infinite or NaN without a first harmonic
}

std::string FourierSpectrum::text() const {
    std::string out = fmt::format("Fourier analysis of {}: mean {:.6g}, total harmonic distortion {:.6g} %\n", curve, mean, distortion());
    out += fmt::format("{:>8} {:>14} {:>14} {:>12} {:>14} {:>12}\n", "harmonic", "frequency, Hz", "magnitude", "phase, deg", "of the first",
                       "phase - first");
    for (std::size_t k = 0; k < harmonics.size(); ++k) {
        const auto& h = harmonics[k];
        out += fmt::format("{:>8} {:>14.6g} {:>14.6g} {:>12.4f} {:>14.6g} {:>12.4f}\n", k + 1, h.frequency, h.magnitude, h.phase,
                           h.magnitude / harmonics[0].magnitude, h.phase - harmonics[0].phase);
    }
    return out;
}

Result<void> FourierTransforms::begin(const Directive& tran, const Plot& head, std::vector<Error>& left_out) {
    const auto times = TRY(read_transient_times(tran));
    for (const auto& c : circuit_.directives_named("four")) {
        const bool is_first = &tran == &*circuit_.directives_named("tran").begin();
        if (c.analysis_location ? !c.applies_to(tran) : !is_first) continue;
        const double f = TRY(read_frequency(c, times));
        for (std::size_t k = 1; k < c.words.size(); ++k) {
            const auto& name = c.words[k];
            if (const auto view = CurveView::find(head, name)) {
                transforms_.push_back({&c, name, *view, f, std::max(times.stop - 1 / f, times.start)});
                transforms_.back().products.resize(harmonic_count);
            } else if (const auto quantity = unavailable_quantity(circuit_, head, name)) {
                left_out.push_back(error_at(c.location_of(k), ".four {} is left out: {} is not available in .tran", name, *quantity));
            } else {
                std::vector<std::string_view> known;
                for (const auto& curve : head.curves) known.push_back(curve.name);
                return error_at(c.location_of(k), ".four: there is no curve '{}'{}", name, did_you_mean(name, known));
            }
        }
    }
    return {};
}

void FourierTransforms::add_point(const PlotRow& row) {
    if (transforms_.empty()) return;
    const auto now = row.real;
    if (!previous_.empty())
        for (auto& t : transforms_) {
            LineSegment s{previous_[0], t.view.value(PlotRow(std::span<const double>(previous_))).real(), now[0], t.view.value(row).real()};
            if (s.x1 <= t.from || !s.cut(t.from, unbounded)) continue;
            t.integral += s.integral();
            for (std::size_t k = 0; k < t.products.size(); ++k) {
                const double omega = turn * t.frequency * static_cast<double>(k + 1);
                const auto [a, b] = line_integrals(omega * s.length());
                t.products[k] += s.length() * std::polar(1.0, -omega * (s.x0 - t.from)) * (s.y0 * a + (s.y1 - s.y0) * b);
            }
        }
    previous_.assign(now.begin(), now.end());
}

/// With the product P = integral of y exp(-j w t), y contains 2 f Re(P) cos(w t) - 2 f Im(P) sin(w t).
std::vector<FourierSpectrum> FourierTransforms::spectra() const {
    std::vector<FourierSpectrum> out;
    for (const auto& t : transforms_) {
        auto& spectrum = out.emplace_back(FourierSpectrum{t.name, t.frequency, t.integral * t.frequency, {}});
        for (std::size_t k = 0; k < t.products.size(); ++k) {
            const auto amplitude = 2 * t.frequency * t.products[k];
            spectrum.harmonics.push_back(
                {t.frequency * static_cast<double>(k + 1), std::abs(amplitude), std::atan2(amplitude.real(), -amplitude.imag()) * degrees});
        }
        remove_rounding(spectrum);
    }
    return out;
}

}  // namespace corpuscle::circuit
