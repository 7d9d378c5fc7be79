// .pz: poles and zeros of a transfer function of the circuit, linearized at its operating point.
//
// With Y(s) = G + s C of the circuit without a source at its input, e = 1 at IN+ and -1 at IN-, and l likewise for the output:
//
//     poles of v(OUT) / i(IN):  det Y(s) = 0
//     poles of v(OUT) / v(IN):  det [Y e; e' 0] = 0, since a voltage source drives the input
//     zeros of both:            det [Y e; l' 0] = 0

#include <algorithm>
#include <cmath>
#include <numbers>

#include "circuit/analysis/analysis_context.hpp"
#include "circuit/devices.hpp"
#include "circuit/solve/pencil.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr std::string_view syntax = ".pz IN+ IN- OUT+ OUT- vol|cur pol|zer|pz";

/// The words of .pz, with unknowns instead of nodes (-1: ground).
struct PortPair {
    OutputVariable in, out;
    bool is_voltage = true;  // the input is a voltage
    bool wants_poles = true, wants_zeros = true;
};

Result<int> read_node(const System& system, const Directive& c, std::size_t word) {
    const auto& name = c.words[word];
    if (is_ground(name)) return -1;
    const auto k = system.unknown(fmt::format("v({})", name));
    if (k >= 0) return k;
    std::vector<std::string_view> nodes(system.circuit().nodes.begin() + 1, system.circuit().nodes.end());
    return error_at(c.location_of(word), ".pz: unknown node '{}'{}", name, did_you_mean(name, nodes));
}

/// Xyce's form: .pz v(OUT[,REF]) SOURCE
Result<PortPair> read_output_and_source(const System& system, const Directive& c) {
    PortPair out;
    out.out = TRY(read_output_variable(system, c, 0));
    if (!system.is_voltage(out.out.plus))
        return error_at(c.location_of(0), ".pz: '{}' must be a voltage, v(NODE) or v(NODE,NODE)", c.words[0]);
    const auto* source = TRY(read_independent_source(system, c, 1));
    out.is_voltage = source->unknowns.size() == 3;
    out.in = out.is_voltage ? OutputVariable{source->unknowns[0], source->unknowns[1]}
                            : OutputVariable{source->unknowns[1], source->unknowns[0]};
    return out;
}

Result<PortPair> read_ports(const System& system, const Directive& c) {
    if (c.words.size() == 2) return read_output_and_source(system, c);
    if (c.words.size() != 6) return error_at(c.location, ".pz: {} words; expected {}", c.words.size(), syntax);
    PortPair out;
    out.in.plus = TRY(read_node(system, c, 0));
    out.in.minus = TRY(read_node(system, c, 1));
    out.out.plus = TRY(read_node(system, c, 2));
    out.out.minus = TRY(read_node(system, c, 3));
    const auto& input = c.words[4];
    const auto& wanted = c.words[5];
    if (input != "vol" && input != "cur") return error_at(c.location_of(4), ".pz: '{}' must be vol or cur; expected {}", input, syntax);
    if (wanted != "pol" && wanted != "zer" && wanted != "pz")
        return error_at(c.location_of(5), ".pz: '{}' must be pol, zer or pz; expected {}", wanted, syntax);
    out.is_voltage = input == "vol", out.wants_poles = wanted != "zer", out.wants_zeros = wanted != "pol";
    for (const auto& [port, word] : {std::pair{out.in, 0}, std::pair{out.out, 2}})
        if (port.plus == port.minus)
            return error_at(c.location_of(static_cast<std::size_t>(word)), ".pz: the two nodes of a port must differ");
    return out;
}

/// The current of a voltage source between the input nodes; -1 if there is none.
int branch_at_input(const System& system, const OutputVariable& in) {
    for (std::size_t k = 0; k < system.devices().size(); ++k) {
        const auto& u = system.devices()[k]->unknowns;
        if (!is_independent_source(system.circuit().elements[k]) || u.size() != 3) continue;
        if ((u[0] == in.plus && u[1] == in.minus) || (u[0] == in.minus && u[1] == in.plus)) return u[2];
    }
    return -1;
}

/// Y(s). A voltage source at the input is replaced by i = 0.
Pencil admittances(const System& system, const SystemEvaluation& evaluation, int branch) {
    Pencil out{system.size(), {}};
    system.pattern().for_each_entry([&](std::size_t entry, std::size_t row, std::size_t column) {
        const int r = static_cast<int>(row), k = static_cast<int>(column);
        if (r != branch && k != branch) out.add(r, k, evaluation.G[entry], evaluation.C[entry]);
    });
    if (branch >= 0) out.add(branch, branch, 1);
    return out;
}

/// [Y e; l' 0]
Pencil bordered(Pencil y, const OutputVariable& column, const OutputVariable& row) {
    const int last = y.size++;
    for (const auto& [node, value] : {std::pair{column.plus, 1.0}, std::pair{column.minus, -1.0}})
        if (node >= 0) y.add(node, last, value);
    for (const auto& [node, value] : {std::pair{row.plus, 1.0}, std::pair{row.minus, -1.0}})
        if (node >= 0) y.add(last, node, value);
    return y;
}

/// True if the output follows the input at some frequency. If not, every s is a zero.
Result<bool> has_transfer(const Pencil& driven, const OutputVariable& in, const OutputVariable& out, bool is_voltage, const Directive& c) {
    std::vector<std::pair<int, int>> positions;
    for (const auto& e : driven.entries) positions.emplace_back(e.row, e.column);
    const SparsityPattern pattern(driven.size, std::move(positions));
    LinearSolver<std::complex<double>> solver(pattern);
    for (const double omega : {1.0, 1e3, 1e6, 1e9}) {
        std::vector<std::complex<double>> values(pattern.entries()), x(static_cast<std::size_t>(driven.size));
        for (const auto& e : driven.entries)
            values[pattern.entry_index(e.row, e.column)] += std::complex(e.g + 0.3 * omega * e.c, omega * e.c);
        if (!solver.factor_with_new_pivots(values)) return error_at(c.location, ".pz: the matrix of the circuit is singular");
        if (is_voltage)
            x.back() = 1;
        else
            for (const auto& [node, value] : {std::pair{in.plus, 1.0}, std::pair{in.minus, -1.0}})
                if (node >= 0) x[static_cast<std::size_t>(node)] = value;
        solver.solve(x);
        double largest = 0;
        for (int k = 0; k < driven.size; ++k) largest = std::max(largest, std::abs(x[static_cast<std::size_t>(k)]));
        const auto v = value_of(x, out.plus) - value_of(x, out.minus);
        if (std::abs(v) > 1e-13 * (std::abs(value_of(x, out.plus)) + std::abs(value_of(x, out.minus)))) return true;
    }
    return false;
}

std::string table_of(std::string_view title, const std::vector<std::complex<double>>& roots) {
    std::string out = fmt::format("{}: {}\n", title, roots.size());
    if (roots.empty()) return out;
    out += fmt::format("{:>20} {:>20} {:>16} {:>12}\n", "real part, rad/s", "imaginary, rad/s", "|s|/2pi, Hz", "Q");
    for (const auto& s : roots)
        out += fmt::format("{:>20.9g} {:>20.9g} {:>16.7g} {:>12}\n", s.real(), s.imag(), std::abs(s) / turn,
                           s.imag() == 0 ? "" : fmt::format("{:.5g}", quality_of(s)));
    return out;
}

void report(std::string_view name, const std::vector<std::complex<double>>& roots, bool is_brief, AnalysisResult& out) {
    out.numbers.emplace_back(fmt::format("{}s", name), static_cast<double>(roots.size()));
    for (std::size_t k = 0; k < roots.size(); ++k)
        out.plots[0].curves.push_back({fmt::format("{}({})", name, k + 1), "notype", {roots[k]}});
    if (!is_brief) out.table += table_of(fmt::format("{}s", name), roots);
}

void report_poles(const std::vector<std::complex<double>>& poles, AnalysisResult& out) {
    const auto is_unstable = [](const std::complex<double>& s) { return s.real() > 0; };
    out.numbers.emplace_back("unstable_poles", static_cast<double>(std::ranges::count_if(poles, is_unstable)));
    if (!poles.empty()) out.numbers.emplace_back("slowest_pole", std::abs(poles[0]) / turn);
}

Plot expected_pz_plot(const System&, const Directive&) { return {"Pole-Zero Analysis", true, false, {}}; }

Result<AnalysisResult> analyse_pz(AnalysisContext& context, const Directive& c) {
    const auto& system = context.system;
    const auto ports = TRY(read_ports(system, c));
    if (system.size() >= max_pencil_size)
        return error_at(c.location, ".pz: the circuit has {} unknowns; the limit is {}", system.size(), max_pencil_size - 1);
    const auto operating_point = TRY(context.operating_point());
    const auto evaluation = evaluate_operating_point(context, operating_point.x);
    const auto y = admittances(system, evaluation, branch_at_input(system, ports.in));
    const auto driven = ports.is_voltage ? bordered(y, ports.in, ports.in) : y;
    const auto reaches = TRY(has_transfer(driven, ports.in, ports.out, ports.is_voltage, c));
    AnalysisResult out{.plots = {expected_pz_plot(system, c)}};
    if (ports.wants_poles) {
        out.poles = TRY(finite_eigenvalues(driven));
        report("pole", *out.poles, context.is_brief, out), report_poles(*out.poles, out);
    }
    if (ports.wants_zeros && !reaches)
        out.warnings.push_back(error_at(c.location, ".pz: the output does not depend on the input, so it has no zeros"));
    if (ports.wants_zeros && reaches) {
        out.zeros = TRY(finite_eigenvalues(bordered(y, ports.in, ports.out)));
        report("zero", *out.zeros, context.is_brief, out);
    }
    return out;
}

constexpr std::string_view pz_numbers[] = {"poles", "zeros", "unstable_poles", "slowest_pole"};

}  // namespace

extern constexpr Analysis pz_analysis = {.name = "pz",
                                         .usage = ".pz IN+ IN- OUT+ OUT- vol|cur pol|zer|pz",
                                         .description = "poles and zeros of the output over the input voltage or current",
                                         .run = analyse_pz,
                                         .expected_plot = expected_pz_plot,
                                         .numbers = pz_numbers,
                                         .ngspice_order = 5};

}  // namespace corpuscle::circuit
