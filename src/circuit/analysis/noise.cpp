// .noise: each device's noise currents, carried to the output by the adjoint network (Rohrer et al., 1971).

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "circuit/analyses.hpp"
#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

struct Part {
    std::string name;
    double total = 0, total_in = 0;    // of the squares at the output and as if at the source
    double before = 0, before_in = 0;  // densities at the frequency before
};

/// Area under a density between two frequencies, as a power law between them.
double area(double f0, double s0, double f1, double s1) {
    if (s0 <= 0 || s1 <= 0 || f0 <= 0) return 0.5 * (s0 + s1) * (f1 - f0);
    const double power = std::log(s1 / s0) / std::log(f1 / f0);
    if (std::abs(power + 1) < 1e-9) return s0 * f0 * std::log(f1 / f0);
    return (s1 * f1 - s0 * f0) / (power + 1);
}

}  // namespace

Result<Findings> analyse_noise(TestBench& bench, const Command& c) {
    const auto& system = bench.system;
    const auto out = wanted_of(system, c, 0);
    if (!out) return out.error();
    if (c.words.size() < 6) return bad_input(".noise: it is .noise v(OUT) SOURCE dec|oct|lin POINTS FROM TO", c.place);
    const auto* source = system.device(c.words[1]);
    if (source == nullptr || !(source->name[0] == 'v' || source->name[0] == 'i'))
        return bad_input(fmt::format(".noise: '{}' is no independent source", c.words[1]), c.place);
    const auto frequencies = frequencies_of(c, 2);
    if (!frequencies) return frequencies.error();
    const auto rest = bench.rest();
    if (!rest) return rest.error();
    const auto sums = sums_at(bench, rest->x);

    struct Source {
        const Device* device;
        NoiseSource noise;
        std::size_t part;
    };
    std::vector<Source> sources;
    std::vector<Part> parts;
    for (const auto& d : system.devices())
        for (const auto& n : d->noise(system.terminals(*d, rest->x))) {
            sources.push_back({d.get(), n, parts.size()});
            parts.push_back({fmt::format("{} {}", d->name, n.what)});
        }

    Plot plot{"Noise Spectral Density Curves",
              false,
              true,
              {{"frequency", "frequency", {}}, {"onoise_spectrum", "notype", {}}, {"inoise_spectrum", "notype", {}}}};
    Solver<std::complex<double>> solver(system.pattern());
    double f_before = 0;
    for (const double f : *frequencies) {
        if (bench.stopped(static_cast<double>(plot.points()) / static_cast<double>(frequencies->size()))) return interruption();
        if (!solver.factor(admittances(sums, system.pattern().entries(), 6.283185307179586 * f)))
            return bad_input(fmt::format(".noise at {:g} Hz: the matrix is singular", f), c.place);
        std::vector<std::complex<double>> lambda(rest->x.size());
        if (out->plus >= 0) lambda[static_cast<std::size_t>(out->plus)] += 1;
        if (out->minus >= 0) lambda[static_cast<std::size_t>(out->minus)] -= 1;
        solver.solve_transposed(lambda);
        const auto at = [&](const Device& d, std::size_t k) {
            return d.unknowns[k] < 0 ? std::complex<double>() : lambda[static_cast<std::size_t>(d.unknowns[k])];
        };
        const auto gain = source->unknowns.size() == 3 ? at(*source, 2) : at(*source, 1) - at(*source, 0);
        double density = 0;
        for (const auto& s : sources) {
            const double mine =
                std::norm(at(*s.device, s.noise.from) - at(*s.device, s.noise.to)) * (s.noise.white + (f > 0 ? s.noise.flicker / f : 0));
            density += mine;
            auto& part = parts[s.part];  // each by itself is nearly a power of f
            const double in = mine / std::norm(gain);
            if (f_before > 0) part.total += area(f_before, part.before, f, mine), part.total_in += area(f_before, part.before_in, f, in);
            part.before = mine, part.before_in = in;
        }
        f_before = f;
        plot.curves[0].values.emplace_back(f);
        plot.curves[1].values.emplace_back(std::sqrt(density));
        plot.curves[2].values.emplace_back(std::sqrt(density / std::norm(gain)));
    }
    double total = 0, total_in = 0;
    for (const auto& part : parts) total += part.total, total_in += part.total_in;
    Findings found;
    found.plots.push_back(std::move(plot));
    Plot sum{"Integrated Noise",
             false,
             false,
             {{"onoise_total", "notype", {std::sqrt(total)}}, {"inoise_total", "notype", {std::sqrt(total_in)}}}};
    found.plots.push_back(std::move(sum));
    found.numbers = {{"onoise_total", std::sqrt(total)}, {"inoise_total", std::sqrt(total_in)}};
    std::sort(parts.begin(), parts.end(),
              [](const Part& a, const Part& b) { return a.total != b.total ? a.total > b.total : a.name < b.name; });
    found.table = fmt::format("{:32} {:>14} {:>8}\n", "noise at the output", "rms", "share");
    for (const auto& p : parts)
        found.table += fmt::format("{:32} {:>14} {:>7.2f}%\n", p.name, format_quantity(std::sqrt(p.total), "V"),
                                   total > 0 ? 100 * p.total / total : 0);
    return found;
}

}  // namespace corpuscle::circuit
