// Verilog-A: a behavioural module with the equations of an afferent. A state is the voltage of an internal node: the integral of its slope
// plus the sum of its jumps at spikes.

#include <fmt/format.h>

#include "run/export/equation_text.hpp"

namespace corpuscle {
namespace {

// I is the access function of currents.
const EquationDialect verilog_a{.functions = {}, .names = {{"pi", "`M_PI"}, {"I", "I_m"}}};

constexpr std::string_view module_text = R"va(@HEADING@//
// force: 1 V is newtons_per_volt. spike: a pulse of spike_volts and spike_width at each spike; pulses that overlap become one.
`include "constants.vams"
`include "disciplines.vams"

module @MODULE@(force, spike);
    inout force, spike;
    electrical force, spike;
    parameter real newtons_per_volt = 1.0;  // N/V
    parameter real spike_volts = 1.0;  // V
    parameter real spike_width = 0.0001;  // s
    parameter real spike_edge = 1e-06;  // s
@PARAMETERS@@NODES@    real F, dF@VARIABLES@, margin, idle_until, spike_end;
    integer active, fired;

    analog begin
        @(initial_step) begin
@JUMPS@            active = 1;
            fired = 0;
            idle_until = -1;
            spike_end = -1;
        end
        F = newtons_per_volt*V(force);
        dF = newtons_per_volt*ddt(V(force));
@QUANTITIES@        margin = @VALUE@ - @LIMIT@;
@CONDITION@        @(cross(margin, 1)) begin
@RESET@            fired = 1;
            spike_end = $abstime + spike_width;
        end
        @(timer(idle_until)) begin
            active = 1;
        end
        @(timer(spike_end)) begin
            fired = 0;
        end
@SLOPES@        V(spike) <+ transition(spike_volts*fired, 0, spike_edge, spike_edge);
    end
endmodule
)va";

struct ModuleParts {
    std::string parameters, nodes, variables, jumps, quantities, slopes;
};

/// True if a spike changes this state.
bool jumps_at_spike(const NeuronEquations& neuron, std::string_view state) {
    for (const auto& a : neuron.at_spike)
        if (a.name == state) return true;
    return false;
}

void add_module_states(ModuleParts& parts, const ExportedAfferent& afferent, const std::vector<StateEquation>& states) {
    for (const auto& s : states) {
        const bool jumps = jumps_at_spike(*afferent.equations.neuron, s.name);
        parts.nodes += fmt::format("    electrical n_{};  // {}\n", s.name, s.unit);
        parts.variables += fmt::format(", {0}, slope_of_{0}{1}", s.name, jumps ? fmt::format(", jump_of_{}", s.name) : "");
        if (jumps) parts.jumps += fmt::format("            jump_of_{} = 0;\n", s.name);
        parts.quantities += fmt::format("        {0} = V(n_{0});\n", s.name);
        parts.slopes += fmt::format("        slope_of_{} = {};\n", s.name, verilog_a.expression(s.slope));
        if (!s.minimum.empty())
            parts.slopes += fmt::format("        if ({0} <= {1}) begin\n            slope_of_{0} = max(slope_of_{0}, 0);\n        end\n",
                                        s.name, verilog_a.expression(s.minimum));
        parts.slopes +=
            fmt::format("        V(n_{0}) <+ idt({1}slope_of_{0}, {2}){3};\n", s.name, s.is_held_while_refractory ? "active*" : "",
                        verilog_a.expression(afferent.initial(s)), jumps ? fmt::format(" + jump_of_{}", s.name) : "");
    }
}

void add_module_definitions(ModuleParts& parts, const std::vector<Definition>& definitions) {
    for (const auto& d : definitions) {
        const auto name = verilog_a.name(d.name);
        parts.variables += ", " + name;
        parts.quantities += fmt::format("        {} = {};  // {}\n", name, verilog_a.expression(d.expression), d.unit);
    }
}

ModuleParts module_parts(const ExportedAfferent& afferent) {
    const auto& e = afferent.equations;
    ModuleParts parts;
    for (const auto& p : e.parameters)
        parts.parameters += fmt::format("    parameter real {} = {};  // {}{}{}\n", p.name, number_text(p.value), p.unit,
                                        p.unit.empty() ? "" : ": ", p.description);
    add_module_states(parts, afferent, e.receptor->states);
    add_module_definitions(parts, e.receptor->definitions);
    if (e.receptor->currents.size() == 2) {
        parts.parameters += fmt::format("    parameter real side = 0;  // the current that drives the neuron: 0 is {}, 1 is {}\n",
                                        e.receptor->currents[0], e.receptor->currents[1]);
        parts.variables += ", I_m";
        parts.quantities += fmt::format("        I_m = (1 - side)*{} + side*{};  // A\n", e.receptor->currents[0], e.receptor->currents[1]);
    }
    add_module_states(parts, afferent, e.neuron->states);
    add_module_definitions(parts, e.neuron->definitions);
    return parts;
}

std::string module_reset(const AfferentEquations& e) {
    std::string out;
    for (const auto& a : e.neuron->at_spike)
        out += fmt::format("            jump_of_{0} = jump_of_{0} + {1} - {0};\n", a.name, verilog_a.expression(a.expression));
    if (!e.neuron->refractory_time.empty())
        out += fmt::format(
            "            if ({0} > 0) begin\n                active = 0;\n                idle_until = $abstime + {0};\n            end\n",
            e.neuron->refractory_time);
    return out;
}

Result<ExportedModel> write_verilog_a(const ExportRequest& request) {
    const auto afferent = TRY(exported_afferent(request, verilog_a_target));
    const auto& neuron = *afferent.equations.neuron;
    const auto parts = module_parts(afferent);
    ExportedModel out;
    if (afferent.equations.receptor->currents.size() == 2)
        out.warnings.push_back(
            bad_input(fmt::format("{}: each of its two currents drives a neuron of its own; use the module twice, with "
                                  "side = 0 and side = 1",
                                  afferent.plan.name)));
    std::string condition;
    if (!neuron.condition.empty())
        condition =
            fmt::format("        if ({} <= 0) begin\n            margin = -1;\n        end\n", verilog_a.expression(neuron.condition));
    out.text = fill_template(module_text, {{"HEADING", prefixed_lines(afferent.heading, "// ")},
                                           {"MODULE", identifier_of(afferent.plan.name)},
                                           {"PARAMETERS", parts.parameters},
                                           {"NODES", parts.nodes},
                                           {"VARIABLES", parts.variables},
                                           {"JUMPS", parts.jumps},
                                           {"QUANTITIES", parts.quantities},
                                           {"VALUE", std::string(neuron.value)},
                                           {"LIMIT", verilog_a.expression(neuron.threshold)},
                                           {"CONDITION", condition},
                                           {"RESET", module_reset(afferent.equations)},
                                           {"SLOPES", parts.slopes}});
    return out;
}

}  // namespace

const ExportTarget verilog_a_target{.name = "verilog-a",
                                    .description = "a Verilog-A module, of an afferent",
                                    .kind = "module",
                                    .is_text = true,
                                    .write = write_verilog_a,
                                    .is_own = has_export_mark};

}  // namespace corpuscle
