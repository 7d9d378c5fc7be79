#include "circuit/analysis/analysis_context.hpp"

#include "circuit/devices.hpp"
#include "circuit/expression/spice_number.hpp"

namespace corpuscle::circuit {

AnalysisContext::AnalysisContext(std::shared_ptr<const Circuit> c, System s, const Tolerances& t)
    : circuit(std::move(c)), system(std::move(s)), tolerances(t), newton(system, t) {}

Result<std::unique_ptr<AnalysisContext>> AnalysisContext::make(std::shared_ptr<const Circuit> circuit) {
    const auto tolerances = Tolerances::from_options(*circuit);
    auto system = TRY(System::make(circuit));
    return std::unique_ptr<AnalysisContext>(new AnalysisContext(std::move(circuit), std::move(system), tolerances));
}

NodeClamps AnalysisContext::initial_clamps() const {
    if (circuit->ic.empty()) return {};
    // The voltages have the size of x, since uic starts from them.
    NodeClamps out{std::vector<double>(static_cast<std::size_t>(system.nodes())),
                   std::vector<double>(static_cast<std::size_t>(system.size()))};
    for (const auto& [node, v] : circuit->ic)
        out.conductance[static_cast<std::size_t>(node) - 1] = 1e3, out.voltage[static_cast<std::size_t>(node) - 1] = v;
    return out;
}

Result<OperatingPoint> AnalysisContext::operating_point() {
    if (operating_point_) return system.set_states(operating_point_->states), *operating_point_;
    system.reset_states();
    auto found = find_operating_point(newton, nominal_x_);
    if (found) operating_point_ = *found;
    return found;
}

Result<OperatingPoint> AnalysisContext::initial_operating_point() {
    system.reset_states();
    return find_operating_point(newton, circuit->ic.empty() ? nominal_x_ : nominal_initial_x_, initial_clamps());
}

/// Finds the operating points of the nominal circuit, and fixes the pivot order to that of its matrix.
void AnalysisContext::solve_nominal() {
    if (!circuit->ic.empty())
        if (auto initial = initial_operating_point()) nominal_initial_x_ = std::move(initial->x);
    const auto found = operating_point();
    if (!found) return;
    nominal_x_ = found->x;
    system.eval(nominal_x_, newton.context, newton.limiting_state, newton.evaluation);
    newton.linear_solver.fix_pivot_order(std::span<const double>(newton.evaluation.G).first(system.pattern().entries()));
}

void AnalysisContext::apply_variation(const ChipSample& chip) {
    if (!chip_sample_) solve_nominal();
    chip_sample_ = chip;
    system.apply_variation(&chip);
    operating_point_.reset();
}

Result<double> read_number(const Directive& c, std::size_t word, std::string_view what) {
    if (word >= c.words.size()) return error_at(c.location, ".{}: {} is missing", c.name, what);
    if (const auto x = parse_number(c.words[word])) {
        if (auto why = ambiguity(*x, c.words[word])) return error_at(c.location_of(word), ".{}: {}", c.name, *why);
        return x->value;
    }
    return error_at(c.location_of(word), ".{}: '{}' is not a number; expected {}", c.name, c.words[word], what);
}

/// "10meg" for the text "10m" or "10mhz" of a number in milli; "" for any other number.
static std::string in_mega(std::string_view text) {
    const auto number = parse_number(text);
    if (!number || (number->suffix != "m" && number->suffix != "mhz")) return "";
    return fmt::format("{}meg", text.substr(0, text.size() - number->suffix.size()));
}

Result<std::vector<double>> read_frequencies(const Directive& c, std::size_t word) {
    const std::string kind = word < c.words.size() ? c.words[word] : "";
    if (kind != "dec" && kind != "oct" && kind != "lin") return error_at(c.location, ".{}: '{}' must be dec, oct or lin", c.name, kind);
    const double points = TRY(read_number(c, word + 1, "the number of points"));
    const double from = TRY(read_number(c, word + 2, "the first frequency")), to = TRY(read_number(c, word + 3, "the last frequency"));
    if (!(points >= 1 && points <= 1e7))
        return error_at(c.location_of(word + 1), ".{}: {:g} points is outside [1, 10000000]", c.name, points);
    if (from > to && to > 0) {
        const auto mega = in_mega(c.words[word + 3]);
        if (!mega.empty() && 1e9 * to >= from)
            return error_at(c.location_of(word + 3), ".{}: {} is {:g} Hz, because m is milli; write .{} {} {} {} {}", c.name,
                            c.words[word + 3], to, c.name, kind, c.words[word + 1], c.words[word + 2], mega);
        return error_at(c.location_of(word + 2), ".{}: from {:g} to {:g} Hz: the lower frequency comes first; write .{} {} {} {} {}",
                        c.name, from, to, c.name, kind, c.words[word + 1], c.words[word + 3], c.words[word + 2]);
    }
    if (!(to >= from && (from > 0 || (kind == "lin" && from >= 0))))
        return error_at(c.location, ".{}: from {:g} to {:g} Hz: the first must be above 0 and at most the second", c.name, from, to);
    const auto count = static_cast<long>(points);
    std::vector<double> out;
    if (kind == "lin") {
        for (long k = 0; k < count; ++k)
            out.push_back(count == 1 ? from : from + (to - from) * static_cast<double>(k) / static_cast<double>(count - 1));
        return out;
    }
    // As in ngspice: points are spaced evenly on a logarithmic scale, `count` per decade or octave. The last is at or below the last
    // frequency.
    const double base = kind == "dec" ? 10 : 2, steps = std::log(to / from) / std::log(base) * static_cast<double>(count);
    if (steps > 1e7) return error_at(c.location, ".{}: {:g} frequencies; the maximum is 10000000", c.name, steps);
    for (double k = 0; k <= std::floor(steps + 1e-9); ++k) out.push_back(from * std::pow(base, k / static_cast<double>(count)));
    return out;
}

Result<OutputVariable> read_output_variable(const System& system, const Directive& c, std::size_t word) {
    if (word >= c.words.size()) return error_at(c.location, ".{}: an output is missing; write v(node), v(node,node) or i(source)", c.name);
    const auto location = c.location_of(word);
    const auto& text = c.words[word];
    const bool voltage = text.starts_with("v("), closed = text.ends_with(")");
    if (!closed || !(voltage || text.starts_with("i(")))
        return error_at(location, ".{}: '{}' must be v(node), v(node,node) or i(source)", c.name, text);
    const auto inside = text.substr(2, text.size() - 3);
    const auto unknown = [&](const std::string& name) -> Result<int> {
        if (voltage && is_ground(name)) return -1;
        const auto full = fmt::format("{}({})", voltage ? 'v' : 'i', name);
        const int index = system.unknown(full);
        if (index >= 0) return index;
        return error_at(location, ".{}: unknown output {}{}", c.name, full, did_you_mean(full, system.names()));
    };
    const auto comma = inside.find(',');
    const auto plus = TRY(unknown(inside.substr(0, comma)));
    if (comma == std::string::npos) return OutputVariable{plus, -1};
    const auto minus = TRY(unknown(inside.substr(comma + 1)));
    return OutputVariable{plus, minus};
}

Plot make_plot(const System& system, std::string name, std::string swept, std::string type) {
    Plot plot{std::move(name), false, !swept.empty(), {}};
    if (plot.has_sweep) plot.curves.push_back({std::move(swept), std::move(type), {}});
    for (int n = 0; n < system.size(); ++n)
        plot.curves.push_back({system.names()[static_cast<std::size_t>(n)], system.is_voltage(n) ? "voltage" : "current", {}});
    return plot;
}

Result<void> for_each_frequency(const AnalysisContext& context, const Directive& c, const SystemEvaluation& sums,
                                std::span<const double> frequencies, const FrequencyCallback& use) {
    const auto& system = context.system;
    LinearSolver<std::complex<double>> solver(system.pattern());
    std::vector<std::complex<double>> admittances(system.pattern().entries());
    for (std::size_t k = 0; k < frequencies.size(); ++k) {
        if (context.is_stopped(static_cast<double>(k) / static_cast<double>(frequencies.size()))) return interrupted_error();
        const double f = frequencies[k], omega = 6.283185307179586 * f;
        for (std::size_t e = 0; e < admittances.size(); ++e) admittances[e] = {sums.G[e], omega * sums.C[e]};
        if (!solver.factor(admittances)) {
            const int unknown = solver.singular_column();
            return error_at(c.location, ".{} at {:g} Hz: the matrix is singular{}", c.name, f,
                            unknown < 0 ? "" : " at " + system.names()[static_cast<std::size_t>(unknown)]);
        }
        use(f, solver);
    }
    return {};
}

Result<const Device*> read_independent_source(const System& system, const Directive& c, std::size_t word) {
    const int k = system.circuit().find_element(c.words[word]);
    if (k < 0 || !is_independent_source(system.circuit().elements[static_cast<std::size_t>(k)]))
        return error_at(c.location, ".{}: '{}' is not an independent source", c.name, c.words[word]);
    return system.devices()[static_cast<std::size_t>(k)].get();
}

SystemEvaluation evaluate_operating_point(const AnalysisContext& context, std::span<const double> x) {
    SystemEvaluation sums;
    EvalContext eval_context;
    eval_context.gmin = context.tolerances.gmin;
    auto limiting_state = context.system.initial_limiting_state();
    for (int k = 0; k < 200; ++k) {  // until limit() changes no voltage
        context.system.eval(x, eval_context, limiting_state, sums);
        if (!sums.is_limited) break;
    }
    return sums;
}

}  // namespace corpuscle::circuit
