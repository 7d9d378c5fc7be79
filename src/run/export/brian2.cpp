// Brian 2: a Python script with the equations of an afferent.
//
// Brian resets a neuron at the end of the time step in which it crossed the threshold. The script therefore finds the time of the spike
// within the step on a straight line, and moves each state that the spike changes back to that time and, after the change, forward to the
// end of the step. A refractory time may end within a step, too: the state then moves for a part of the step. The error of a spike time is
// proportional to the square of the step.

#include <fmt/format.h>

#include "run/export/equation_text.hpp"

namespace corpuscle {
namespace {

const EquationDialect brian{
    .functions = {{"max", "clip($1, $2, inf)"}, {"min", "clip($1, -inf, $2)"}, {"asinh", "log($1 + sqrt(($1)**2 + 1))"}}, .names = {}};

constexpr std::string_view brian_script = R"py(#!/usr/bin/env python3
@HEADING@#
# Needs Brian 2 (Debian: python3-brian). Usage: python3 @FILE@ FORCE.csv [SPIKES.csv] [--step S]

import argparse
import csv
import os
import re
import sys

import numpy as np
from brian2 import NeuronGroup, Network, SpikeMonitor, TimedArray, defaultclock, prefs, second

AFFERENT = "@NAME@"

PARAMETERS = {
@PARAMETERS@}

# F: force (N); dF: its slope (N/s); begin: start of the step; active: the part of the step that is not refractory (0 to 1);
# idle_until: end of the refractory time; before: value minus threshold at the start of the step.
EQUATIONS = """
F = F_step + dF*(t/second - begin) : 1
@EQUATIONS@F_step : 1
dF : 1
begin : 1
active : 1
before : 1
idle_until : 1
spike_time : 1
"""

THRESHOLD = "@THRESHOLD@"

# late: time from the spike to the end of its step; free: the part of it that is not refractory.
RESET = """
late = dt/second*(@VALUE@ - @LIMIT@)/(@VALUE@ - @LIMIT@ - clip(before, -inf, 0))
spike_time = t/second + dt/second - late
idle_until = spike_time + @REFRACTORY@
free = clip(late - @REFRACTORY@, 0, inf)
@RESET@"""
@READER@

def simulate(forces, step):
    """The spike times (s) of each column of forces, [time, column]."""
    prefs.codegen.target = "numpy"
    defaultclock.dt = step * second
    channels, currents = forces.shape[1], @CURRENTS@
    force = np.repeat(forces, currents, axis=1)
    # Without another row the slope after the last one is 0.
    force_array = TimedArray(force, dt=step * second, name="force_array")
    slope_array = TimedArray(np.diff(force, axis=0, append=force[-1:]) / step, dt=step * second, name="slope_array")
    group = NeuronGroup(channels * currents, EQUATIONS, method="rk4", threshold=THRESHOLD, reset=RESET,
                        namespace={**PARAMETERS, "force_array": force_array, "slope_array": slope_array})
    group.F_step = force[0]
    group.run_regularly("""
        F_step = force_array(t, i)
        dF = slope_array(t, i)
        begin = t/second
        active = clip((t/second + dt/second - idle_until)/(dt/second), 0, 1)
@MINIMUM@        before = @VALUE@ - @LIMIT@""", when="start")
@INITIAL@    monitor = SpikeMonitor(group, variables=["spike_time"], when="end")
    Network(group, monitor).run((len(forces) - 1) * step * second)
    return [np.array(monitor.spike_time)[np.array(monitor.i) // currents == channel] for channel in range(channels)]


if __name__ == "__main__":
    given = arguments()
    names, step, start, forces = read_force(given.force, given.step)
    write_spikes(given.spikes, given.force, names, [start + train for train in simulate(forces, step)])
)py";

std::string brian_parameters(const AfferentEquations& equations) {
    std::string out;
    for (const auto& p : equations.parameters)
        out += fmt::format("    \"{}\": {},  # {}{}{}\n", p.name, number_text(p.value), p.unit, p.unit.empty() ? "" : ": ", p.description);
    return out;
}

/// The slope of a state, which does not fall below its minimum.
std::string brian_slope(const StateEquation& s) {
    const auto slope = brian.expression(s.slope);
    if (s.minimum.empty()) return slope;
    return fmt::format("int({0} > {1})*({2}) + int({0} <= {1})*clip({2}, 0, inf)", s.name, brian.expression(s.minimum), slope);
}

std::string brian_equations(const AfferentEquations& e) {
    std::string out;
    const auto add_definitions = [&](const std::vector<Definition>& all) {
        for (const auto& d : all) out += fmt::format("{} = {} : 1  # {}\n", d.name, brian.expression(d.expression), d.unit);
    };
    for (const auto& s : e.receptor->states)
        out += fmt::format("d{}/dt = ({})/second : 1  # {}\n", s.name, brian.expression(s.slope), s.unit);
    add_definitions(e.receptor->definitions);
    if (e.receptor->currents.size() == 2)
        out += fmt::format("I = (1 - i % 2)*{} + (i % 2)*{} : 1  # A\n", e.receptor->currents[0], e.receptor->currents[1]);
    for (const auto& s : e.neuron->states) {
        out += fmt::format("slope_of_{} = {} : 1  # {}/s\n", s.name, brian_slope(s), s.unit);
        out += fmt::format("d{0}/dt = {1}slope_of_{0}/second : 1  # {2}\n", s.name, s.is_held_while_refractory ? "active*" : "", s.unit);
    }
    add_definitions(e.neuron->definitions);
    return out;
}

/// The changes of the states at a spike: all values just before it, then those after it.
std::string brian_reset(const NeuronEquations& neuron) {
    std::string back, change, forward;
    for (const auto& a : neuron.at_spike)
        for (const auto& s : neuron.states) {
            if (s.name != a.name) continue;
            if (a.expression.find(s.name) != a.expression.npos) back += fmt::format("{0} = {0} - late*slope_of_{0}\n", s.name);
            change += fmt::format("{} = {}\n", s.name, brian.expression(a.expression));
            forward += fmt::format("{0} = {0} + {1}*slope_of_{0}\n", s.name, s.is_held_while_refractory ? "free" : "late");
        }
    return back + change + forward;
}

/// The states at the start, and at the start of each step the minimum of those that have one.
std::pair<std::string, std::string> brian_start(const ExportedAfferent& afferent) {
    std::string initial, minimum;
    for (const auto* states : {&afferent.equations.receptor->states, &afferent.equations.neuron->states})
        for (const auto& s : *states) {
            initial += fmt::format("    group.{} = \"{}\"\n", s.name, brian.expression(afferent.initial(s)));
            if (!s.minimum.empty()) minimum += fmt::format("        {0} = clip({0}, {1}, inf)\n", s.name, brian.expression(s.minimum));
        }
    return {initial, minimum};
}

Result<ExportedModel> write_brian2(const ExportRequest& request) {
    const auto afferent = TRY(exported_afferent(request, brian2_target));
    const auto& [plan, equations, command, heading] = afferent;
    const auto& neuron = *equations.neuron;
    const auto [initial, minimum] = brian_start(afferent);
    const auto limit = brian.expression(neuron.threshold);
    const auto above = fmt::format("{} > {}", neuron.value, limit);
    return ExportedModel{
        fill_template(brian_script,
                      {{"HEADING", prefixed_lines(heading, "# ")},
                       {"FILE", identifier_of(plan.name) + ".py"},
                       {"NAME", plan.name},
                       {"PARAMETERS", brian_parameters(equations)},
                       {"EQUATIONS", brian_equations(equations)},
                       {"THRESHOLD", neuron.condition.empty() ? above : fmt::format("{} and {} > 0", above, neuron.condition)},
                       {"VALUE", std::string(neuron.value)},
                       {"LIMIT", limit},
                       {"REFRACTORY", neuron.refractory_time.empty() ? "0" : std::string(neuron.refractory_time)},
                       {"RESET", brian_reset(neuron)},
                       {"READER", std::string(python_force_reader)},
                       {"CURRENTS", fmt::format("{}", equations.receptor->currents.size())},
                       {"MINIMUM", minimum},
                       {"INITIAL", initial}}),
        {}};
}

}  // namespace

const ExportTarget brian2_target{.name = "brian2",
                                 .description = "a Python script for Brian 2, of an afferent",
                                 .kind = "script",
                                 .is_text = true,
                                 .write = write_brian2,
                                 .is_own = has_export_mark};

}  // namespace corpuscle
