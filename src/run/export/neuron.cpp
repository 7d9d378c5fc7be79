// NEURON: a Python script that contains the equations of an afferent as a point process in NMODL, compiles it and runs it. The
// variable-step integrator finds the spikes.

#include <fmt/format.h>

#include "run/export/equation_text.hpp"

namespace corpuscle {
namespace {

// The C code that NEURON generates makes macros of all names, so functions get names that no library has. v is NEURON's membrane potential,
// and it adds 0 to the names of states: y0 is a function of C.
const EquationDialect nmodl{
    .functions = {{"max", "larger($1, $2)"}, {"min", "smaller($1, $2)"}, {"abs", "fabs($1)"}, {"asinh", "area_sinh($1)"}},
    .names = {{"pi", "3.141592653589793"}, {"v", "v_m"}, {"y", "y_m"}}};

constexpr std::string_view neuron_script = R"py(#!/usr/bin/env python3
@HEADING@#
# Needs NEURON and a C compiler (Debian: python3-neuron, neuron-dev). Usage: python3 @FILE@ FORCE.csv [SPIKES.csv] [--step S]
# The step applies to the force; between its values the time step of the integrator varies.

import argparse
import csv
import glob
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

AFFERENT = "@NAME@"

# NEURON's time is in ms, so slopes are multiplied by 0.001. All other quantities have the units of the parameters.
MECHANISM = """
NEURON {
    POINT_PROCESS Afferent
    RANGE F_begin, dF, begin, side@RANGE@
}

PARAMETER {
@PARAMETERS@    side = 0  : the current that drives this neuron, if the receptor has two
}

ASSIGNED {
    F_begin  : N, force at the time begin
    dF       : N/s, slope of the force from then on
    begin    : ms
    active   : 0 in the refractory time, else 1
    F I @DEFINITIONS@
}

STATE { @STATES@ }

INITIAL {
    F = F_begin
    active = 1
@INITIAL@    quantities()
    net_send(0, 1)
}

BREAKPOINT { SOLVE states METHOD derivimplicit }

DERIVATIVE states {
    quantities()
@SLOPES@}

PROCEDURE quantities() {
    F = F_begin + dF*0.001*(t - begin)
@QUANTITIES@}

FUNCTION margin() {
    quantities()
    margin = @MARGIN@
}

FUNCTION larger(p, q) { if (p > q) { larger = p } else { larger = q } }
FUNCTION above(x_now, x_min, slope) { if (x_now > x_min) { above = slope } else { above = larger(slope, 0) } }
FUNCTION smaller(p, q) { if (p < q) { smaller = p } else { smaller = q } }
FUNCTION area_sinh(p) { if (p < 0) { area_sinh = -log(-p + sqrt(p*p + 1)) } else { area_sinh = log(p + sqrt(p*p + 1)) } }

NET_RECEIVE (weight) {
    if (flag == 1) {
        WATCH (margin() > 0) 2
    }
    if (flag == 2) {
        net_event(t)
@RESET@    }
    if (flag == 3) {
        active = 1
    }
}
"""
@READER@

def compiler_environment(folder):
    """The environment of nrnivmodl. Debian installs the files that it needs in other directories than it expects."""
    debian = "/usr/lib/nrn"
    if "NRNHOME" in os.environ or not os.path.exists(debian + "/nrnmech_makefile"):
        return None
    home = os.path.join(folder, "home")
    for link, target in (("bin/nrnmech_makefile", debian + "/nrnmech_makefile"), ("bin/mkthreadsafe", debian + "/mkthreadsafe"),
                         ("bin/nocmodl", "/usr/bin/nocmodl"), ("lib", debian), ("include", "/usr/include"), ("share", "/usr/share")):
        os.makedirs(os.path.dirname(os.path.join(home, link)), exist_ok=True)
        os.symlink(target, os.path.join(home, link))
    return {**os.environ, "NRNHOME": home}


def load_mechanism(folder):
    """Compiles the point process in the folder and loads it."""
    import neuron  # prints a line if there is no display

    with open(os.path.join(folder, "afferent.mod"), "w") as file:
        file.write(MECHANISM)
    built = subprocess.run(["nrnivmodl", "afferent.mod"], cwd=folder, env=compiler_environment(folder), stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT, text=True)
    # The program `special`, which nrnivmodl also builds, is not needed; it needs more packages.
    if not glob.glob(os.path.join(folder, "*", "libnrnmech.so")):
        sys.exit(f"nrnivmodl failed:\n{built.stdout}")
    neuron.load_mechanisms(folder)
    return neuron.h


def simulate(h, forces, step):
    """The spike times (s) of each column of forces, [time, column]."""
    times = h.Vector(np.arange(len(forces)) * step * 1e3)
    section = h.Section(name="section")
    keep, trains = [], []
    for force in forces.T:
        train = []
        for side in range(@CURRENTS@):
            afferent = h.Afferent(section(0.5))
            afferent.side = side
            # Without another row the slope after the last one is 0.
            for pointer, values in ((afferent._ref_F_begin, force), (afferent._ref_dF, np.diff(force, append=force[-1]) / step),
                                    (afferent._ref_begin, np.arange(len(force)) * step * 1e3)):
                vector = h.Vector(values)
                vector.play(pointer, times)
                keep.append(vector)
            afferent.F_begin = force[0]
            train.append(h.Vector())
            connection = h.NetCon(afferent, None)
            connection.record(train[-1])
            keep += [afferent, connection]
        trains.append(train)
    integrator = h.CVode()
    integrator.active(1)
    integrator.rtol(1e-8)
    integrator.atol(1e-14)
    integrator.condition_order(2)
    h.finitialize()
    integrator.solve((len(forces) - 1) * step * 1e3)
    return [np.concatenate([np.array(part.to_python()) for part in train]) * 1e-3 for train in trains]


if __name__ == "__main__":
    given = arguments()
    names, step, start, forces = read_force(given.force, given.step)
    with tempfile.TemporaryDirectory() as folder:
        trains = simulate(load_mechanism(folder), forces, step)
    write_spikes(given.spikes, given.force, names, [start + train for train in trains])
)py";

/// The slope of a state, in its unit per ms.
std::string nmodl_slope(const StateEquation& s) {
    auto slope = nmodl.expression(s.slope);
    if (!s.minimum.empty()) slope = fmt::format("above({}, {}, {})", nmodl.name(s.name), nmodl.expression(s.minimum), slope);
    return fmt::format("{}0.001*({})", s.is_held_while_refractory ? "active*" : "", slope);
}

struct NmodlParts {
    std::string range, parameters, definitions, states, initial, slopes, quantities;
};

void add_states(NmodlParts& parts, const ExportedAfferent& afferent, const std::vector<StateEquation>& states) {
    for (const auto& s : states) {
        const auto name = nmodl.name(s.name);
        parts.states += (parts.states.empty() ? "" : " ") + name;
        parts.range += ", " + name;
        parts.initial += fmt::format("    {} = {}\n", name, nmodl.expression(afferent.initial(s)));
        parts.slopes += fmt::format("    {}' = {}\n", name, nmodl_slope(s));
    }
}

void add_definitions(NmodlParts& parts, const std::vector<Definition>& definitions) {
    for (const auto& d : definitions) {
        if (d.name != "I") parts.definitions += fmt::format("{} ", d.name);
        parts.quantities += fmt::format("    {} = {}\n", nmodl.name(d.name), nmodl.expression(d.expression));
    }
}

NmodlParts parts_of(const ExportedAfferent& afferent) {
    const auto& e = afferent.equations;
    NmodlParts parts;
    for (const auto& p : e.parameters) {
        parts.range += fmt::format(", {}", p.name);
        parts.parameters +=
            fmt::format("    {} = {}  : {}{}{}\n", p.name, number_text(p.value), p.unit, p.unit.empty() ? "" : ", ", p.description);
    }
    add_states(parts, afferent, e.receptor->states), add_states(parts, afferent, e.neuron->states);
    add_definitions(parts, e.receptor->definitions);
    if (e.receptor->currents.size() == 2)
        parts.quantities += fmt::format("    I = (1 - side)*{} + side*{}\n", e.receptor->currents[0], e.receptor->currents[1]);
    add_definitions(parts, e.neuron->definitions);
    return parts;
}

std::string nmodl_reset(const AfferentEquations& e) {
    std::string out;
    for (const auto& a : e.neuron->at_spike) out += fmt::format("        {} = {}\n", nmodl.name(a.name), nmodl.expression(a.expression));
    if (e.refractory_time > 0) out += fmt::format("        active = 0\n        net_send(1000*{}, 3)\n", e.neuron->refractory_time);
    return out;
}

Result<ExportedModel> write_neuron(const ExportRequest& request) {
    const auto afferent = TRY(exported_afferent(request, neuron_target));
    const auto& e = afferent.equations;
    const auto parts = parts_of(afferent);
    auto margin = fmt::format("{} - {}", nmodl.name(e.neuron->value), nmodl.expression(e.neuron->threshold));
    if (!e.neuron->condition.empty()) margin += fmt::format("\n    if ({} <= 0) {{ margin = -1 }}", nmodl.expression(e.neuron->condition));
    return ExportedModel{fill_template(neuron_script, {{"HEADING", prefixed_lines(afferent.heading, "# ")},
                                                       {"FILE", identifier_of(afferent.plan.name) + ".py"},
                                                       {"NAME", afferent.plan.name},
                                                       {"RANGE", parts.range},
                                                       {"PARAMETERS", parts.parameters},
                                                       {"DEFINITIONS", parts.definitions},
                                                       {"STATES", parts.states},
                                                       {"INITIAL", parts.initial},
                                                       {"SLOPES", parts.slopes},
                                                       {"QUANTITIES", parts.quantities},
                                                       {"MARGIN", margin},
                                                       {"RESET", nmodl_reset(e)},
                                                       {"READER", std::string(python_force_reader)},
                                                       {"CURRENTS", fmt::format("{}", e.receptor->currents.size())}}),
                         {}};
}

}  // namespace

const ExportTarget neuron_target{.name = "neuron",
                                 .description = "a Python script for NEURON, of an afferent",
                                 .kind = "script",
                                 .is_text = true,
                                 .write = write_neuron,
                                 .is_own = has_export_mark};

}  // namespace corpuscle
