// .noise: the contribution of each device's noise currents to the output, by the adjoint network (Rohrer et al., 1971).

#include <algorithm>
#include <cmath>

#include "circuit/analysis/analysis_context.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double min_gain = 1e-200;  // power gain: keeps the noise referred to a source finite if the source does not reach the output

/// The integral of a density from the frequency f0 (Hz), where it is s0, to f1, where it is s1. In between it is a power of f; if that is
/// impossible, a straight line.
double integrated_density(double f0, double s0, double f1, double s1) {
    if (s0 <= 0 || s1 <= 0 || f0 <= 0) return 0.5 * (s0 + s1) * (f1 - f0);
    const double exponent = std::log(s1 / s0) / std::log(f1 / f0);
    if (std::abs(exponent + 1) < 1e-9) return s0 * f0 * std::log(f1 / f0);
    return (s1 * f1 - s0 * f0) / (exponent + 1);
}

/// The noise of one mechanism of one device.
struct NoiseContribution {
    const Device* device;
    NoiseSource noise;
    double total = 0, total_in = 0;  // integrated noise power: at the output, referred to the source
    double last = 0, last_in = 0;    // noise power densities at the previous frequency, likewise
    std::string name() const { return fmt::format("{} {}", device->name, noise.mechanism); }

    /// Adds the densities at f (Hz); f_last is the frequency before, if there was one. Each contribution is integrated separately, since
    /// each is nearly a power of f.
    void add(std::optional<double> f_last, double f, double power, double in) {
        if (f_last) total += integrated_density(*f_last, last, f, power), total_in += integrated_density(*f_last, last_in, f, in);
        last = power, last_in = in;
    }
};

std::vector<NoiseContribution> noise_contributions(const System& system, std::span<const double> x) {
    std::vector<NoiseContribution> out;
    for (const auto& d : system.devices())
        for (const auto& n : d->noise(system.terminal_values(*d, x))) out.push_back({d.get(), n});
    return out;
}

Plot expected_noise_plot(const System&, const Directive&) {
    return {"Noise Spectral Density Curves",
            false,
            true,
            {{"frequency", "frequency", {}}, {"onoise_spectrum", "notype", {}}, {"inoise_spectrum", "notype", {}}}};
}

/// The contributions, the largest first.
std::string noise_table(std::vector<NoiseContribution> contributions, double total, std::string_view unit) {
    std::sort(contributions.begin(), contributions.end(), [](const NoiseContribution& a, const NoiseContribution& b) {
        return a.total != b.total ? a.total > b.total : a.name() < b.name();
    });
    std::string out = fmt::format("{:32} {:>14} {:>8}\n", "noise at the output", "rms", "fraction");
    for (const auto& p : contributions)
        out += fmt::format("{:32} {:>14} {:>7.2f}%\n", p.name(), format_quantity(std::sqrt(p.total), unit),
                           total > 0 ? 100 * p.total / total : 0);
    return out;
}

/// The integrated noise, after all frequencies.
void add_totals(const std::vector<NoiseContribution>& contributions, std::string_view unit, AnalysisResult& out) {
    double total = 0, total_in = 0;
    for (const auto& c : contributions) total += c.total, total_in += c.total_in;
    out.numbers = {{"onoise_total", std::sqrt(total)}, {"inoise_total", std::sqrt(total_in)}};
    Plot totals{"Integrated Noise", false, false, {}};
    for (const auto& [name, value] : out.numbers) totals.curves.push_back({name, "notype", {value}});
    out.plots.push_back(std::move(totals));
    out.table = noise_table(contributions, total, unit);
}

/// The transfer from a current into each unknown to the output, at one frequency.
class NoiseTransfer {
    std::vector<std::complex<double>> lambda_;

public:
    NoiseTransfer(const OutputVariable& out, std::size_t unknowns, const LinearSolver<std::complex<double>>& solver) : lambda_(unknowns) {
        if (out.plus >= 0) lambda_[static_cast<std::size_t>(out.plus)] += 1;
        if (out.minus >= 0) lambda_[static_cast<std::size_t>(out.minus)] -= 1;
        solver.solve_transposed(lambda_);
    }
    /// From unknown k of a device.
    std::complex<double> at(const Device& d, std::size_t k) const { return value_of(lambda_, d.unknowns[k]); }
    /// The gain from a source, except for the sign. A voltage source has three unknowns, a current source two.
    std::complex<double> gain(const Device& source) const {
        return source.unknowns.size() == 3 ? at(source, 2) : at(source, 1) - at(source, 0);
    }
};

Result<AnalysisResult> analyse_noise(AnalysisContext& context, const Directive& c) {
    const auto& system = context.system;
    const auto out = TRY(read_output_variable(system, c, 0));
    if (c.words.size() < 6) return error_at(c.location, ".noise: expected .noise v(OUT) SOURCE dec|oct|lin POINTS FROM TO");
    const auto* source = TRY(read_independent_source(system, c, 1));
    const auto frequencies = TRY(read_frequencies(c, 2));
    const auto operating_point = TRY(context.operating_point());
    const auto evaluation = evaluate_operating_point(context, operating_point.x);
    auto contributions = noise_contributions(system, operating_point.x);
    AnalysisResult result{.plots = {expected_noise_plot(system, c)}};
    std::optional<double> f_last;
    TRY(for_each_frequency(context, c, evaluation, frequencies, [&](double f, const auto& solver) {
        const NoiseTransfer transfer(out, operating_point.x.size(), solver);
        const double gain = std::max(std::norm(transfer.gain(*source)), min_gain);
        double density = 0;
        for (auto& n : contributions) {
            const double power = std::norm(transfer.at(*n.device, n.noise.from) - transfer.at(*n.device, n.noise.to)) *
                                 (n.noise.white + (f > 0 ? n.noise.flicker / f : 0));
            density += power;
            n.add(f_last, f, power, power / gain);
        }
        f_last = f;
        const double row[] = {std::sqrt(density), std::sqrt(density / gain)};
        append(result.plots[0], f, row);
    }));
    add_totals(contributions, system.is_voltage(out.plus >= 0 ? out.plus : out.minus) ? "V" : "A", result);
    return result;
}

constexpr std::string_view noise_numbers[] = {"onoise_total", "inoise_total"};

}  // namespace

extern constexpr Analysis noise_analysis = {.name = "noise",
                                            .usage = ".noise v(OUT[,REF]) SOURCE dec|oct|lin POINTS FROM TO",
                                            .description = "noise at a node, with the contribution of each device",
                                            .run = analyse_noise,
                                            .expected_plot = expected_noise_plot,
                                            .numbers = noise_numbers,
                                            .plot_count = 2,
                                            .ngspice_order = 6};

}  // namespace corpuscle::circuit
