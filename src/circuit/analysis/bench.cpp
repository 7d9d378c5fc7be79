#include "circuit/analysis/bench.hpp"

#include <fmt/format.h>
#include <cmath>

#include "circuit/netlist/spice_number.hpp"
#include "signal/parameter.hpp"

namespace corpuscle::circuit {

TestBench::TestBench(std::shared_ptr<const Circuit> c, System s, const Tolerances& t)
    : circuit(std::move(c)), system(std::move(s)), tolerances(t), newton(system, t) {}

Result<std::unique_ptr<TestBench>> TestBench::make(std::shared_ptr<const Circuit> circuit) {
    auto tolerances = Tolerances::of(*circuit);
    if (!tolerances) return tolerances.error();
    auto system = System::make(circuit);
    if (!system) return system.error();
    return std::unique_ptr<TestBench>(new TestBench(std::move(circuit), std::move(*system), *tolerances));
}

Springs TestBench::held() const {
    if (circuit->ic.empty()) return {};
    Springs out{std::vector<double>(static_cast<std::size_t>(system.nodes())),
                std::vector<double>(static_cast<std::size_t>(system.size()))};
    for (const auto& [node, v] : circuit->ic)
        out.g[static_cast<std::size_t>(node) - 1] = 1e3, out.to[static_cast<std::size_t>(node) - 1] = v;
    return out;
}

Result<OperatingPoint> TestBench::rest() {
    if (rest_) return *rest_;
    auto found = operating_point(newton, designed_);
    if (found) rest_ = *found;
    return found;
}

Result<OperatingPoint> TestBench::rest_held() { return operating_point(newton, circuit->ic.empty() ? designed_ : begun_, held()); }

/// Solves the nominal circuit. Chips are solved from its operating point, with the pivot order of its matrix there.
void TestBench::prepare() {
    if (!circuit->ic.empty())
        if (auto begun = rest_held()) begun_ = std::move(begun->x);
    const auto found = rest();
    if (!found) return;
    designed_ = found->x;
    system.eval(designed_, newton.instant, newton.memory, newton.sums);
    newton.solver.settle(std::span<const double>(newton.sums.G).first(system.pattern().entries()));
}

void TestBench::draw(const Draw& chip) {
    if (!drawn_) prepare();
    drawn_ = chip;
    system.draw(&chip);
    rest_.reset();
}

Error interruption() { return {ErrorCode::interrupted, "interrupted"}; }

Error error_at(const Directive& c, std::size_t word, std::string message) {
    auto location = c.location;
    if (word < c.columns.size()) location.column = c.columns[word];
    return bad_input(std::move(message), std::move(location));
}

Result<double> number_of(const Directive& c, std::size_t word, std::string_view what) {
    if (word >= c.words.size()) return bad_input(fmt::format(".{}: {} is missing", c.name, what), c.location);
    if (const auto x = parse_number(c.words[word])) {
        if (auto why = ambiguity(*x, c.words[word])) return error_at(c, word, fmt::format(".{}: {}", c.name, *why));
        return x->value;
    }
    return error_at(c, word, fmt::format(".{}: '{}' is not a number; expected {}", c.name, c.words[word], what));
}

Result<std::vector<double>> frequencies_of(const Directive& c, std::size_t word) {
    const std::string kind = word < c.words.size() ? c.words[word] : "";
    if (kind != "dec" && kind != "oct" && kind != "lin")
        return bad_input(fmt::format(".{}: '{}' must be dec, oct or lin", c.name, kind), c.location);
    const auto points = number_of(c, word + 1, "the number of points"), from = number_of(c, word + 2, "the first frequency"),
               to = number_of(c, word + 3, "the last frequency");
    if (!points) return points.error();
    if (!from) return from.error();
    if (!to) return to.error();
    if (!(*points >= 1 && *points <= 1e7))
        return bad_input(fmt::format(".{}: {:g} points is outside [1, 10000000]", c.name, *points), c.location);
    if (!(*to >= *from && (*from > 0 || (kind == "lin" && *from >= 0))))
        return bad_input(fmt::format(".{}: from {:g} to {:g} Hz: the first must be above 0 and at most the second", c.name, *from, *to),
                         c.location);
    const auto count = static_cast<long>(*points);
    std::vector<double> out;
    if (kind == "lin") {
        for (long k = 0; k < count; ++k)
            out.push_back(count == 1 ? *from : *from + (*to - *from) * static_cast<double>(k) / static_cast<double>(count - 1));
        return out;
    }
    // As in ngspice: points are spaced evenly per decade (octave), and the last is at or below the end.
    const double base = kind == "dec" ? 10 : 2, steps = std::log(*to / *from) / std::log(base) * static_cast<double>(count);
    if (steps > 1e7) return bad_input(fmt::format(".{}: {:g} frequencies; the maximum is 10000000", c.name, steps), c.location);
    for (double k = 0; k <= std::floor(steps + 1e-9); ++k) out.push_back(*from * std::pow(base, k / static_cast<double>(count)));
    return out;
}

UnknownNames::UnknownNames(const System& system) : system_(system) {
    const auto& names = system.names();
    for (std::size_t k = 0; k < names.size(); ++k) at_.try_emplace(names[k], static_cast<int>(k));
}

int UnknownNames::index_of(std::string_view name) const {
    const auto at = at_.find(name);
    return at == at_.end() ? -1 : at->second;
}

Result<Wanted> wanted_of(const System& system, const Directive& c, std::size_t word) { return wanted_of(UnknownNames(system), c, word); }

Result<Wanted> wanted_of(const UnknownNames& names, const Directive& c, std::size_t word) {
    if (word >= c.words.size())
        return bad_input(fmt::format(".{}: an output is missing, v(node), v(node,node) or i(source)", c.name), c.location);
    auto location = c.location;
    if (word < c.columns.size()) location.column = c.columns[word];
    const auto& text = c.words[word];
    const bool voltage = text.starts_with("v("), closed = text.ends_with(")");
    if (!closed || !(voltage || text.starts_with("i(")))
        return bad_input(fmt::format(".{}: '{}' must be v(node), v(node,node) or i(source)", c.name, text), location);
    const auto inside = text.substr(2, text.size() - 3);
    const auto unknown = [&](const std::string& name) -> Result<int> {
        if (voltage && (name == "0" || name == "gnd")) return -1;
        const auto full = fmt::format("{}({})", voltage ? 'v' : 'i', name);
        const int index = names.index_of(full);
        if (index >= 0) return index;
        const std::vector<std::string_view> known(names.all().begin(), names.all().end());
        return bad_input(fmt::format(".{}: unknown output {}{}", c.name, full, did_you_mean(full, known)), location);
    };
    const auto comma = inside.find(',');
    const auto plus = unknown(inside.substr(0, comma));
    if (!plus) return plus.error();
    if (comma == std::string::npos) return Wanted{*plus, -1};
    const auto minus = unknown(inside.substr(comma + 1));
    if (!minus) return minus.error();
    return Wanted{*plus, *minus};
}

std::complex<double> Wanted::of(std::span<const std::complex<double>> x) const {
    return (plus < 0 ? 0 : x[static_cast<std::size_t>(plus)]) - (minus < 0 ? 0 : x[static_cast<std::size_t>(minus)]);
}
double Wanted::of(std::span<const double> x) const {
    return (plus < 0 ? 0 : x[static_cast<std::size_t>(plus)]) - (minus < 0 ? 0 : x[static_cast<std::size_t>(minus)]);
}

Plot plot_of(const System& system, std::string name, std::string swept, std::string type) {
    Plot plot{std::move(name), false, !swept.empty(), {}};
    if (plot.has_sweep) plot.curves.push_back({std::move(swept), std::move(type), {}});
    for (int n = 0; n < system.size(); ++n)
        plot.curves.push_back({system.names()[static_cast<std::size_t>(n)], system.is_voltage(n) ? "voltage" : "current", {}});
    return plot;
}

void append(Plot& plot, std::complex<double> swept, std::span<const std::complex<double>> x) {
    plot.curves[0].values.push_back(swept);
    for (std::size_t n = 0; n < x.size(); ++n) plot.curves[n + 1].values.push_back(x[n]);
}
void append(Plot& plot, std::complex<double> swept, std::span<const double> x) {
    plot.curves[0].values.push_back(swept);
    for (std::size_t n = 0; n < x.size(); ++n) plot.curves[n + 1].values.emplace_back(x[n]);
}

std::vector<std::complex<double>> admittances(const Sums& sums, std::size_t entries, double omega) {
    std::vector<std::complex<double>> out(entries);
    for (std::size_t k = 0; k < entries; ++k) out[k] = {sums.G[k], omega * sums.C[k]};
    return out;
}

Sums sums_at(const TestBench& context, std::span<const double> x) {
    Sums sums;
    Instant eval_context;
    eval_context.gmin = context.tolerances.gmin;
    auto limiting_state = context.system.fresh_memory();
    for (int k = 0; k < 200; ++k) {  // until limit() changes no voltage
        context.system.eval(x, eval_context, limiting_state, sums);
        if (!sums.limited) break;
    }
    return sums;
}

}  // namespace corpuscle::circuit
