// Parses the command line and calls the verb. Only this file, program.cpp, help.cpp, option_groups.cpp, sweep_verbs.cpp and
// stream_verbs.cpp include CLI11.

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>

#include "circuit/analyses.hpp"
#include "cli/arguments/force_argument.hpp"
#include "cli/arguments/option_groups.hpp"
#include "cli/help.hpp"
#include "cli/output/terminal.hpp"
#include "cli/program.hpp"
#include "cli/stream_verbs.hpp"
#include "cli/study_program.hpp"
#include "cli/sweep/sweep_verbs.hpp"
#include "cli/verbs.hpp"
#include "model/copies.hpp"

namespace {

using namespace corpuscle;

constexpr const char* about = "Corpuscle: artificial touch. Force goes in, nerve-like spikes come out.";

constexpr const char* first_steps = R"(First steps:
  corpuscle respond press                                press, hold and release, through an SA-I and an FA-I afferent
  corpuscle respond press --report press.html            the same, with a report page
  corpuscle respond press --afferent sa1,sa1-circuit     a model beside its transistor circuit
  corpuscle respond touch.csv --unit mN --out result     your own recording: spikes.csv, summary.json
  corpuscle compare result/spikes.csv other/spikes.csv   how two responses differ
  corpuscle run circuits/inverter.cir                    run the analyses of a netlist
  corpuscle export circuits/inverter.cir --for ngspice   the same netlist for another simulator
  corpuscle sweep chips.toml                             Monte Carlo, corners and grids (see sweep --help)
  corpuscle stream --population hand --rate 1kHz         live: force in, spikes out
  corpuscle study --report studies.html                  reproduce published results
  corpuscle list                                         every afferent, stimulus and parameter

Exit status: 0 success, 1 bad input, 2 bad usage, 3 did not converge, 130 interrupted.)";

constexpr const char* respond_examples =
    R"(FORCE is a file of numbers in columns (- for standard input), or a stimulus: press, ramp-hold, step,
sine, chirp, noise, grating, or a sum such as press+noise (after its end a shorter stimulus keeps
its last value).

An afferent is one of
  a model: sa1 fa1 sa2 fa2 sa1-kim fa1-lee (TouchSim's names SA1 RA PC work, too)
  a receptor and a neuron: sa1b+izhikevich
  either of these behind a sensor, a transducer or a converter: fsr+f2i+sa1, fsr+f2v+adc+sa1b+lif-b
  a circuit: sa1-circuit fa1-circuit, or the path of a netlist with a force input and a spike output

--set changes any parameter. In netlists it changes any .param, array or device value. 'corpuscle
list' prints all parameters. A value without a unit is in SI: press.t_hold=0.25 means 0.25 s.

Examples:
  corpuscle respond press --report press.html              press, hold and release, through an SA-I and an FA-I afferent
  corpuscle respond touch.csv --unit mN --out result       your own recording: spikes.csv, summary.json
  corpuscle respond press --set press.F_max=2N --set sa1.f_B=25Hz
  corpuscle respond press --json                           one JSON document, with the time of every spike
  corpuscle respond sine --set sine.f=250Hz --afferent fa2 --rate 20kHz
  corpuscle respond press --afferent sa1 --copies 1000 --spread sa1.f_B=10% --spread sa1.V_th=5%
  corpuscle respond press --afferent sa1,sa1-circuit --corner ss --temp 85 --supply 0.65V
  corpuscle respond press --afferent sa1-circuit --set sa1-circuit.C_u=4pF --set sa1-circuit.summer.N3B=8x4 --probe 'vf,i(N3B)' -o result
  corpuscle respond stroke --population hand --out hand --report      a stroke over a hand with 17,000 afferents
  corpuscle respond frames.csv --population 'grid 8x8' --out skin     64 sensor channels, one per skin site
  corpuscle respond touch.csv --channel fz --scale 0.02 --abs --out result --report
  corpuscle respond eskin.csv --rate 100Hz --scale 40      irregular timestamps: assume even sampling
  corpuscle respond grip.csv --rate 250Hz --scale 0.002 --range 0..4095 --despike 200 --notch 50Hz     remove outliers and mains hum

The unit of a recording is read from its header (fz_N, "fz [mN]"). If the header has none, give
--unit, or --scale S (newtons per unit of the recording). Sampling times come from the time column
(--time names it) or from --rate.)";

constexpr const char* compare_examples =
    R"(A is the reference. A spike of A without a match in B is missing; a spike of B without a match in A
is extra.

Files are spikes.csv or spikes.npz of 'corpuscle respond', a list of times in seconds (.txt, .npy),
or any CSV or JSON Lines file with a column time_s. A column such as afferent, channel, unit or
cluster separates several trains. --time and --train choose other columns. Trains of the same name
are compared, and so are two files with one train each. A NAME is an afferent, a channel, or both:
sa1,fz.

Examples:
  corpuscle compare yesterday/spikes.csv today/spikes.csv
  corpuscle compare a/spikes.csv b/spikes.csv --pair sa1=sa1-kim      two afferents, on every channel
  corpuscle compare a/spikes.csv b/spikes.csv --pair fz=fz_abs        two channels, for every afferent
  corpuscle compare a/spikes.csv --pair sa1=sa1-kim                   two trains of one file
  corpuscle compare recorded.csv result/spikes.npz --pair 11=sa1,fz --window 2ms --json

Two spikes match if the Victor-Purpura alignment with a cost of 2 per window shifts one onto the
other; matches never cross. The Victor-Purpura distance is the minimum total cost to turn A into B:
1 per spike removed or added, and --cost per second of shift. 'per spike' is this distance divided
by the number of spikes in A and B, 0 to 1. The van Rossum distance is scaled so that one extra
spike counts 1.)";

constexpr const char* run_examples = R"(

Further directives:
  .print dc v(out)                  print a table of curves
  .meas dc NAME find v(out) at=0.3  measure one number
  .expect NAME VALUE 1%             fail if a measured number differs: the netlist tests itself
  .spike v(s) 0.35                  the threshold that defines a spike in a .tran
  .assert v(a) 0 0.6                the range in which the circuit works as designed
  .force press                      the stimulus of the FORCE sources
  .options accuracy=fine|finest     more than the default accuracy

The file of a .tran is written during the run. After Ctrl-C it is readable.

Examples:
  corpuscle run circuits/divider.cir
  corpuscle run circuits/spiker.cir -o spiker.raw
  corpuscle run sa1-circuit --corner ff --temp 85 --set summer.N3B=8x4 --probe 'vf,u,i(N3B)' -o sa1.csv
  corpuscle run amplifier.cir -o amplifier.raw
  corpuscle run amplifier.cir -o amplifier.csv --json)";

constexpr const char* export_examples =
    R"(The deck is flat: subcircuits are expanded and every parameter is evaluated. Transistors become
subcircuits of expressions with the same currents (relative error 1e-5) and small-signal parameters
(0.1 %), but without noise. Directives that ngspice does not have (.step, .mc, .expect ...) become
comments, with a warning.

Examples:
  corpuscle export amplifier.cir --for ngspice -o amplifier-ng.cir
  ngspice -b amplifier-ng.cir -r amplifier.raw                          the same curves as 'corpuscle run amplifier.cir'
  corpuscle export amplifier.cir --for ngspice > deck.cir && ngspice -b deck.cir       tables and measurements)";

void add_respond(CLI::App& app, RespondArguments& args, CommonArguments& common) {
    auto& verb = *app.add_subcommand("respond", "simulate afferents: force recordings or stimuli -> spikes, rates, report");
    verb.footer(respond_examples);
    verb.add_option("FORCE", args.forces, "recordings and stimuli");
    verb.add_option("--afferent,-a", args.afferents, "the afferents to simulate (repeat the option, or separate by commas)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("NAME")
        ->default_str("sa1,fa1");
    verb.add_option("--set,-s", args.settings, "set a parameter of an afferent or a stimulus, such as sa1.f_B=25Hz")
        ->allow_extra_args(false)
        ->type_name("NAME.PARAMETER=VALUE");
    verb.add_option("--copies", args.copies, "simulate N copies of each afferent on every channel: sa1#1 ... sa1#N")
        ->check(CLI::Range(1U, max_copies))
        ->type_name("N");
    verb.add_option("--spread", args.spreads, "vary a parameter between copies: its standard deviation, relative (10%) or with its unit")
        ->allow_extra_args(false)
        ->type_name("NAME.PARAMETER=10%");
    add_skin_options(verb, args);
    verb.add_option("--method", args.method, "time stepping: exact, or backward-euler as in the thesis")
        ->check(CLI::IsMember({"exact", "backward-euler"}))
        ->capture_default_str()
        ->type_name("METHOD");
    verb.add_flag("--sampled", args.sampled, "put spikes on the sampling times, as in the thesis (default: interpolate within the step)");
    verb.add_option("--noise", args.noise,
                    "add white noise current to every membrane: its standard deviation in a bandwidth of 1 kHz, such as 100nA")
        ->type_name("CURRENT");
    verb.add_option("--seed", args.seed, "seed of all random numbers")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str()
        ->type_name("N");
    verb.add_option("--threads,-j", args.threads, "number of threads (0: one per core); results do not depend on it")
        ->check(CLI::Range(0U, 1024U))
        ->capture_default_str()
        ->type_name("N");
    verb.add_flag(
        "--float", args.use_float,
        "single precision: up to twice as fast, but spike times change (see doc/lanes.md); currents and membranes are not recorded");
    verb.add_option(
            "--rate", args.rate,
            "sampling rate of a stimulus (default 10 kHz; with --population 1 kHz). For a recording: assume even sampling at this rate")
        ->type_name("FREQUENCY");
    add_recording_options(verb, args);
    verb.add_option("--out,-o", args.out, "write spikes.csv, summary.json and, with --copies, copies.csv into this directory")
        ->type_name("DIR")
        ->group("Output");
    add_output_formats(verb, args);
    auto* report = verb.add_option("--report", args.report_file, "write a report page (default: report.html, in the directory of --out)")
                       ->expected(0, 1)
                       ->type_name("[FILE.html]")
                       ->group("Output");
    add_netlist_options(verb, args.netlists);
    add_common(verb, common);
    add_overwrite(verb, common);
    verb.callback([&args, report] {
        args.has_report = report->count() > 0;
        if (args.report_file.empty() || args.report_file.ends_with(".html")) return;
        // "respond --report press": the argument is not a page, so it is the force. If a force was already given, it may be a misspelt
        // page.
        if (!is_force(args.report_file)) throw CLI::ValidationError(page_name_error(args.report_file));
        if (!args.forces.empty()) throw CLI::ValidationError(report_argument_error(args.report_file, args.forces));
        args.forces.push_back(std::exchange(args.report_file, ""));
    });
}

void add_compare(CLI::App& app, CompareArguments& args, CommonArguments& common) {
    auto& verb = *app.add_subcommand("compare", "compare two spike files: matches, distances, missing and extra spikes");
    verb.footer(compare_examples);
    verb.add_option("FILES", args.files, "the spike files A and B (CSV, NPZ ...), or one file with --pair")
        ->expected(1, 2)
        ->type_name("A [B]");
    verb.add_option("--pair,-p", args.pairs, "compare train A-NAME of the first file with B-NAME of the second (repeatable)")
        ->allow_extra_args(false)
        ->type_name("A-NAME=B-NAME");
    verb.add_flag("--by-order", args.by_order, "ignore names: compare the first train of A with the first of B, and so on");
    verb.add_option("--time", args.time_column, "column of spike times, by name or number (default: time_s)")->type_name("COLUMN");
    verb.add_option("--train", args.train_column, "column that identifies the train, by name or number")->type_name("COLUMN");
    verb.add_option("--window", args.window, "maximum time between matching spikes")->capture_default_str()->type_name("TIME");
    verb.add_option("--cost", args.cost, "Victor-Purpura distance: cost per second of shift")
        ->capture_default_str()
        ->type_name("FREQUENCY");
    verb.add_option("--tau", args.tau, "van Rossum distance: time constant")->capture_default_str()->type_name("TIME");
    add_common(verb, common);
}

void add_run(CLI::App& app, RunArguments& args, CommonArguments& common) {
    auto& verb = *app.add_subcommand("run", "run the analyses of a netlist -> .raw, CSV, printed measurements");
    std::string known;
    for (const auto& a : circuit::analyses) known += fmt::format("\n  {}\n      {}", a.usage, a.description);
    verb.footer(
        "A netlist is SPICE: a title, elements (R C L V I E F G H B D M X), .model, .subckt, .param, .include,\n"
        ".lib, .options ... and the analyses to run:" +
        known + run_examples);
    verb.add_option("NETLIST", args.netlist, "a SPICE netlist, or a built-in one: sa1-circuit, fa1-circuit")->required();
    verb.add_option("--set,-s", args.settings,
                    "set a .param, an array (summer.N3B=8x4), a device value (cco.cu=4pF) or a device parameter (N3B.w=1.2um)")
        ->allow_extra_args(false)
        ->type_name("NAME=VALUE");
    verb.add_flag("--budget", args.budget, "also print power, area and leakage of each block");
    add_netlist_options(verb, args.netlists);
    verb.add_option("--out,-o", args.out, "write the curves: x.raw (the format of ngspice, binary) or x.csv")
        ->type_name("FILE")
        ->group("Output");
    verb.add_flag("--ascii", args.ascii, "write the .raw file as text")->group("Output");
    add_common(verb, common);
    add_overwrite(verb, common);
}

void add_export(CLI::App& app, ExportArguments& args, CommonArguments& common) {
    auto& verb = *app.add_subcommand("export", "convert a netlist to the format of another simulator");
    verb.footer(export_examples);
    verb.add_option("NETLIST", args.netlist, "a SPICE netlist, or a built-in one: sa1-circuit, fa1-circuit")->required();
    verb.add_option("--for", args.target, "the target simulator: ngspice (version 39)")
        ->check(CLI::IsMember({"ngspice"}))
        ->capture_default_str()
        ->type_name("SIMULATOR");
    verb.add_option("--out,-o", args.out, "write to this file (default: standard output)")->type_name("FILE")->group("Output");
    add_common(verb, common);
    add_overwrite(verb, common);
}

void add_list(CLI::App& app, ListArguments& args, CommonArguments& common) {
    auto& verb =
        *app.add_subcommand("list", "list all models, stimuli, circuits ... with the default, range and description of every parameter");
    verb.footer("Examples:\n  corpuscle list\n  corpuscle list neurons\n  corpuscle list sa1 press\n  corpuscle list 'grid 4x4' --sites");
    verb.add_option("WHAT", args.names,
                    "afferents, sensors, transducers, converters, receptors, neurons, stimuli, measures, formats, or the name of an entry");
    verb.add_flag("--sites", args.list_sites,
                  "print the sites of a population (hand, 'grid 4x4', own.toml) in frame order, as CSV: name, x_mm, y_mm, region");
    add_common(verb, common);
}

}  // namespace

int main(int argc, char** argv) {
    CommonArguments common;
    common.command = quote_command(argc, argv);
    RespondArguments respond_arguments;
    CompareArguments compare_arguments;
    RunArguments run_arguments;
    ExportArguments export_arguments;
    ListArguments list_arguments;

    auto arguments = normalize_help({argv + 1, argv + argc});
    if (arguments[0] == "study") return start_study_program(arguments);
    const auto app = make_command_line(about);
    app->footer(first_steps);
    add_respond(*app, respond_arguments, common);
    add_compare(*app, compare_arguments, common);
    app->add_subcommand("study", "reproduce published results and compare them with the published numbers");
    add_run(*app, run_arguments, common);
    add_export(*app, export_arguments, common);
    SweepVerbs sweeps;
    sweeps.add_to(*app, common);
    StreamVerb live;
    live.add_to(*app, common);
    add_list(*app, list_arguments, common);
    return run_command_line(*app, std::move(arguments), common, [&] {
        return app->got_subcommand("list")      ? list(list_arguments, common)
               : app->got_subcommand("run")     ? run(run_arguments, common)
               : app->got_subcommand("export")  ? export_to(export_arguments, common)
               : app->got_subcommand("sweep")   ? sweeps.run(common)
               : app->got_subcommand("stream")  ? live.run(common)
               : app->got_subcommand("compare") ? compare_trains(compare_arguments, common)
                                                : respond(respond_arguments, common);
    });
}
