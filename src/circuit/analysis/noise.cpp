// .noise: the contribution of each device's noise currents to the output, by the adjoint network (Rohrer et al., 1971).

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "circuit/analyses.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

/// The noise of one mechanism of one device.
struct NoiseContribution {
    std::string name;                // of the device, with the mechanism
    double total = 0, total_in = 0;  // integrated noise power: at the output, referred to the source
    double last = 0, last_in = 0;    // noise power densities at the previous frequency, likewise
};

/// The integral of a density from the frequency f0 (Hz), where it is s0, to f1, where it is s1. In between it is a power of f; if that is
/// impossible, a straight line.
double integrated_density(double f0, double s0, double f1, double s1) {
    if (s0 <= 0 || s1 <= 0 || f0 <= 0) return 0.5 * (s0 + s1) * (f1 - f0);
    const double exponent = std::log(s1 / s0) / std::log(f1 / f0);
    if (std::abs(exponent + 1) < 1e-9) return s0 * f0 * std::log(f1 / f0);
    return (s1 * f1 - s0 * f0) / (exponent + 1);
}

}  // namespace

Result<AnalysisResult> analyse_noise(AnalysisContext& context, const Directive& c) {
    const auto& system = context.system;
    const auto out = TRY(read_output_variable(system, c, 0));
    if (c.words.size() < 6) return bad_input(".noise: expected .noise v(OUT) SOURCE dec|oct|lin POINTS FROM TO", c.location);
    const auto* source = system.device(c.words[1]);
    if (source == nullptr || !(source->name[0] == 'v' || source->name[0] == 'i'))
        return bad_input(fmt::format(".noise: '{}' is not an independent source", c.words[1]), c.location);
    const auto frequencies = TRY(read_frequencies(c, 2));
    const auto operating_point = TRY(context.operating_point());
    const auto evaluation = evaluate_operating_point(context, operating_point.x);

    struct Source {
        const Device* device;
        NoiseSource noise;
        std::size_t contribution;  // index in `contributions`
    };
    std::vector<Source> sources;
    std::vector<NoiseContribution> contributions;
    for (const auto& d : system.devices())
        for (const auto& n : d->noise(system.terminal_values(*d, operating_point.x))) {
            sources.push_back({d.get(), n, contributions.size()});
            contributions.push_back({fmt::format("{} {}", d->name, n.mechanism)});
        }

    Plot plot{"Noise Spectral Density Curves",
              false,
              true,
              {{"frequency", "frequency", {}}, {"onoise_spectrum", "notype", {}}, {"inoise_spectrum", "notype", {}}}};
    LinearSolver<std::complex<double>> solver(system.pattern());
    double f_last = 0;
    for (const double f : frequencies) {
        if (context.is_stopped(static_cast<double>(plot.point_count()) / static_cast<double>(frequencies.size())))
            return interrupted_error();
        if (!solver.factor(admittances(evaluation, system.pattern().entries(), 6.283185307179586 * f)))
            return bad_input(fmt::format(".noise at {:g} Hz: the matrix is singular", f), c.location);
        std::vector<std::complex<double>> lambda(operating_point.x.size());
        if (out.plus >= 0) lambda[static_cast<std::size_t>(out.plus)] += 1;
        if (out.minus >= 0) lambda[static_cast<std::size_t>(out.minus)] -= 1;
        solver.solve_transposed(lambda);
        // lambda[n] is the output for a unit current into the equation of unknown n.
        const auto at = [&](const Device& d, std::size_t k) {
            return d.unknowns[k] < 0 ? std::complex<double>() : lambda[static_cast<std::size_t>(d.unknowns[k])];
        };
        // The gain from the source to the output, except for the sign. A voltage source has three unknowns, a current source two.
        const auto gain = source->unknowns.size() == 3 ? at(*source, 2) : at(*source, 1) - at(*source, 0);
        double density = 0;
        for (const auto& s : sources) {
            const double power =
                std::norm(at(*s.device, s.noise.from) - at(*s.device, s.noise.to)) * (s.noise.white + (f > 0 ? s.noise.flicker / f : 0));
            density += power;
            auto& contribution = contributions[s.contribution];  // integrated separately, since each is nearly a power of f
            const double in = power / std::norm(gain);
            if (f_last > 0)
                contribution.total += integrated_density(f_last, contribution.last, f, power),
                    contribution.total_in += integrated_density(f_last, contribution.last_in, f, in);
            contribution.last = power, contribution.last_in = in;
        }
        f_last = f;
        plot.curves[0].values.emplace_back(f);
        plot.curves[1].values.emplace_back(std::sqrt(density));
        plot.curves[2].values.emplace_back(std::sqrt(density / std::norm(gain)));
    }
    double total = 0, total_in = 0;
    for (const auto& contribution : contributions) total += contribution.total, total_in += contribution.total_in;
    AnalysisResult result;
    result.plots.push_back(std::move(plot));
    Plot totals{"Integrated Noise",
                false,
                false,
                {{"onoise_total", "notype", {std::sqrt(total)}}, {"inoise_total", "notype", {std::sqrt(total_in)}}}};
    result.plots.push_back(std::move(totals));
    result.numbers = {{"onoise_total", std::sqrt(total)}, {"inoise_total", std::sqrt(total_in)}};
    std::sort(contributions.begin(), contributions.end(), [](const NoiseContribution& a, const NoiseContribution& b) {
        return a.total != b.total ? a.total > b.total : a.name < b.name;
    });
    result.table = fmt::format("{:32} {:>14} {:>8}\n", "noise at the output", "rms", "fraction");
    for (const auto& p : contributions)
        result.table += fmt::format("{:32} {:>14} {:>7.2f}%\n", p.name, format_quantity(std::sqrt(p.total), "V"),
                                    total > 0 ? 100 * p.total / total : 0);
    return result;
}

}  // namespace corpuscle::circuit
