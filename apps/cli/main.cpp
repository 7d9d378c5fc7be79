// The command line: words in, verbs called. Only this, word_groups.cpp, sweep_verbs.cpp and stream_verbs.cpp include CLI11.

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <sstream>
#include <system_error>

#include "circuit/analyses.hpp"
#include "force_words.hpp"
#include "help.hpp"
#include "model/spread.hpp"
#include "signal/version.hpp"
#include "stream_verbs.hpp"
#include "study/studies.hpp"
#include "sweep_verbs.hpp"
#include "terminal.hpp"
#include "verbs.hpp"
#include "word_groups.hpp"

namespace {

using namespace corpuscle;

constexpr const char* about = "Corpuscle: artificial touch. Force goes in, nerve-like spikes come out.";

constexpr const char* first_steps = R"(First steps:
  corpuscle respond press                                the thesis's experiment through SA-I and FA-I
  corpuscle respond press --report press.html            ... and a page to look at
  corpuscle respond press --afferent sa1,sa1-circuit     ... of a model beside its chip, transistor by transistor
  corpuscle respond touch.csv --unit mN --out answer     a recording of your own: spikes.csv, summary.json
  corpuscle compare answer/spikes.csv other/spikes.csv   how two answers differ
  corpuscle run circuits/inverter.cir                    a netlist's analyses, transistor by transistor
  corpuscle export circuits/inverter.cir --for ngspice   the same netlist for another simulator
  corpuscle sweep chips.toml                             a thousand chips, corners, any grid: --help says how
  corpuscle stream --population hand --rate 1kHz         forces in as they come, spikes out as they happen
  corpuscle study --report studies.html                  what others printed, made again
  corpuscle list                                         every afferent, stimulus and parameter

Exit status: 0 done, 1 bad input, 2 bad usage, 3 did not converge, 130 interrupted.)";

constexpr const char* respond_examples =
    R"(FORCE is a file of numbers in columns (- for standard input), or a stimulus by name: press, ramp-hold, step, sine,
chirp, noise, grating, or a sum of them: press+noise (a shorter one holds its last value). AFFERENT is a name (sa1 fa1
sa2 fa2 sa1-kim fa1-lee; TouchSim's SA1 RA PC too) or a transduction and a neuron: sa1b+izhikevich; before either may
stand a sensor, a transducer, a converter: fsr+f2i+sa1, fsr+f2v+adc+sa1b+lif-b; or a chip, transistor by transistor:
sa1-circuit fa1-circuit, or the path of any netlist with a force input and a spike output. Of netlists anything can be
set: a .param, an array, any number of a device. 'corpuscle list' shows them all, with every parameter. A value without a unit is in SI: press.t_hold=0.25 is 0.25 s.

Examples:
  corpuscle respond press --set press.F_max=2N --set sa1.f_B=25Hz
  corpuscle respond press --json                           one document, with the time of every spike
  corpuscle respond sine --set sine.f=250Hz --afferent fa2 --rate 20kHz
  corpuscle respond press --afferent sa1 --copies 1000 --spread sa1.f_B=10% --spread sa1.V_th=5%
  corpuscle respond press --afferent sa1,sa1-circuit --corner ss --temp 85 --supply 0.65V
  corpuscle respond press --afferent sa1-circuit --set sa1-circuit.C_u=4pF --set sa1-circuit.summer.N3B=8x4 --trace 'vf,i(N3B)' -o answer
  corpuscle respond stroke --population hand --out hand --report      17,000 afferents of a hand that is stroked
  corpuscle respond frames.csv --population 'grid 8x8' --out skin     a sensor's 64 channels, each a site of a skin
  corpuscle respond touch.csv --channel fz --scale 0.02 --abs --out answer --report
  corpuscle respond eskin.csv --rate 100Hz --scale 40      a clock that comes in bursts: rows taken as even
  corpuscle respond grip.csv --rate 250Hz --scale 0.002 --range 0..4095 --despike 200 --notch 50Hz     torn, and with hum

A recording's unit stands in its header (fz_N, "fz [mN]"); say --unit if it does not, or --scale S if what is read
times S is newtons. Its clock is its time column (name it with --time), or --rate.)";

constexpr const char* compare_examples =
    R"(A is the reference: a spike of A without a match in B is missing, one of B without a match in A is extra. Files are
spikes.csv or spikes.npz of 'corpuscle respond', any CSV or JSON lines with a column time_s and, to tell trains apart, a
column unit (or afferent, channel, cluster ...; --time and --unit name others), or a lone list of times in seconds (.txt,
.npy). Trains that are called the same are compared, and so are two lone ones. A NAME is that of an afferent
or unit, that of a channel, or both: sa1,fz.

Examples:
  corpuscle compare yesterday/spikes.csv today/spikes.csv
  corpuscle compare a/spikes.csv b/spikes.csv --pair sa1=sa1-kim      one afferent with another, on every channel
  corpuscle compare a/spikes.csv b/spikes.csv --pair fz=fz_abs        one channel with another, every afferent
  corpuscle compare a/spikes.csv --pair sa1=sa1-kim                   two trains of one file
  corpuscle compare recorded.csv answer/spikes.npz --pair 11=sa1,fz --window 2ms --json

Matched are the spikes that the Victor-Purpura distance moves at a cost of 2 a window: closest first, none crossed. That
distance at --cost is the least sum of 1 a spike removed or added and --cost a second moved; a spike = that over all spikes,
0 to 1. The van Rossum distance is scaled so that one extra spike counts 1.)";

constexpr const char* run_examples = R"(

.print dc v(out) prints columns; .meas dc NAME find v(out) at=0.3 a number; .expect NAME VALUE 1% makes the netlist its own test.
.spike v(s) 0.35 says what counts as a spike in a .tran, .within v(a) 0 0.6 where the circuit works as designed, .force press which
stimulus its FORCE sources carry; .options accuracy=fine|finest asks for more than the usual accuracy. A .tran's
file grows as it goes, and Ctrl-C leaves it readable.

Examples:
  corpuscle run circuits/divider.cir
  corpuscle run circuits/spiker.cir -o spiker.raw
  corpuscle run sa1-circuit --corner ff --temp 85 --set summer.N3B=8x4 --trace 'vf,u,i(N3B)' -o sa1.csv
  corpuscle run amplifier.cir -o amplifier.raw
  corpuscle run amplifier.cir -o amplifier.csv --json)";

constexpr const char* export_examples =
    R"(The deck is flat: subcircuits put in place, every parameter worked out. Transistors become subcircuits of formulas that carry what
ours carry: currents to 1e-5 of themselves, small signals to 0.1 %; their noise ngspice cannot have. What it has no word for (.step,
.mc, .expect ...) stays as a comment, and is told.

Examples:
  corpuscle export amplifier.cir --for ngspice -o amplifier-ng.cir
  ngspice -b amplifier-ng.cir -r amplifier.raw                          the curves that 'corpuscle run amplifier.cir -o ...' writes
  corpuscle export amplifier.cir --for ngspice > deck.cir && ngspice -b deck.cir       prints, and measures)";

void add_respond(CLI::App& app, RespondWords& w, Common& common) {
    auto& verb = *app.add_subcommand("respond", "force recordings or named stimuli -> spikes, rates, report");
    verb.footer(respond_examples);
    verb.add_option("FORCE", w.forces, "recordings and stimuli");
    verb.add_option("--afferent,-a", w.afferents, "which afferents answer (more than one: repeat, or separate by commas)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("NAME")
        ->default_str("sa1,fa1");
    verb.add_option("--set,-s", w.settings, "a parameter, of an afferent or a stimulus, with its unit")
        ->allow_extra_args(false)
        ->type_name("NAME.PARAMETER=VALUE");
    verb.add_option("--copies", w.copies, "a population: each afferent stands N times on every channel, sa1#1 ... sa1#N")
        ->check(CLI::Range(1U, most_copies))
        ->type_name("N");
    verb.add_option("--spread", w.spreads, "a parameter that differs between copies: its standard deviation, as a share or with its unit")
        ->allow_extra_args(false)
        ->type_name("NAME.PARAMETER=10%");
    add_skin_words(verb, w);
    verb.add_option("--method", w.method, "how time is stepped: exact, or the thesis's own backward-euler")
        ->check(CLI::IsMember({"exact", "backward-euler"}))
        ->capture_default_str()
        ->type_name("METHOD");
    verb.add_flag("--sampled", w.sampled, "spikes on the samples, as in the thesis; else interpolated inside the step");
    verb.add_option("--noise", w.noise, "a white current to every membrane: its standard deviation within 1 kHz, such as 100nA")
        ->type_name("CURRENT");
    verb.add_option("--seed", w.seed, "of everything random")->check(CLI::NonNegativeNumber)->capture_default_str()->type_name("N");
    verb.add_option("--threads,-j", w.threads, "how many to use (0: one for each core); the answer does not depend on it")
        ->check(CLI::Range(0U, 1024U))
        ->capture_default_str()
        ->type_name("N");
    verb.add_flag("--float", w.in_float,
                  "single precision: up to twice as fast, but spikes move (doc/lanes.md says how far); no currents and membranes are kept");
    verb.add_option("--rate", w.rate, "of a stimulus (default 10 kHz; of a skin 1 kHz); of a recording: its rows are this evenly spaced")
        ->type_name("FREQUENCY");
    add_recording_words(verb, w);
    verb.add_option("--out,-o", w.out, "write spikes.csv, summary.json and, of copies, copies.csv into this directory")
        ->type_name("DIR")
        ->group("Output");
    verb.add_flag("--traces", w.traces, "write traces.csv there, too: force, currents, membranes")->group("Output");
    verb.add_option("--bin", w.bin, "write psth.csv there, too: spikes and rate in even bins of this length")
        ->type_name("TIME")
        ->group("Output");
    verb.add_flag("--npz", w.npz, "write spikes.npz there, too: exact times for NumPy and SpikeInterface")->group("Output");
    verb.add_flag("--wav", w.wav, "write spikes.wav there, too: a click a spike, to listen to")->group("Output");
    verb.add_flag("--vectors", w.vectors, "write vectors-AFFERENT.csv and rom-AFFERENT.csv there: every word behind a converter")
        ->group("Output");
    auto* report = verb.add_option("--report", w.report_file, "write a page to look at (report.html, in --out's directory if there is one)")
                       ->expected(0, 1)
                       ->type_name("[FILE.html]")
                       ->group("Output");
    add_netlist_words(verb, w.netlists);
    add_common(verb, common);
    add_overwrite(verb, common);
    verb.callback([&w, report] {
        w.report = report->count() > 0;
        if (w.report_file.empty() || w.report_file.ends_with(".html")) return;
        // "respond --report press": the word is no page, so it is the force. Beside a force it may be meant as the page.
        if (!is_force(w.report_file)) throw CLI::ValidationError(page_name_needed(w.report_file));
        if (!w.forces.empty()) throw CLI::ValidationError(force_behind_report(w.report_file, w.forces));
        w.forces.push_back(std::exchange(w.report_file, ""));
    });
}

void add_compare(CLI::App& app, CompareWords& w, Common& common) {
    auto& verb = *app.add_subcommand("compare", "two files of spikes -> what matches, how far apart, what is missing or extra");
    verb.footer(compare_examples);
    verb.add_option("FILES", w.files, "A and B, files of spikes: CSV or NPZ; or one file, with --pair")->expected(1, 2)->type_name("A [B]");
    verb.add_option("--pair,-p", w.pairs, "what is called A-NAME in the first file is B-NAME in the second (repeat for more)")
        ->allow_extra_args(false)
        ->type_name("A-NAME=B-NAME");
    verb.add_flag("--by-order", w.by_order, "whatever they are called: the first train of A with the first of B, and so on");
    verb.add_option("--time", w.time, "the column of times, by name or number, where it is called otherwise")->type_name("COLUMN");
    verb.add_option("--unit", w.unit, "the column that tells trains apart, by name or number")->type_name("COLUMN");
    verb.add_option("--window", w.window, "spikes closer than this may match")->capture_default_str()->type_name("TIME");
    verb.add_option("--cost", w.cost, "of the Victor-Purpura distance: of moving a spike, per second")
        ->capture_default_str()
        ->type_name("FREQUENCY");
    verb.add_option("--tau", w.tau, "time constant of the van Rossum distance")->capture_default_str()->type_name("TIME");
    add_common(verb, common);
}

void add_study(CLI::App& app, StudyWords& w, Common& common) {
    auto& verb = *app.add_subcommand("study", "what others printed, made again and held against it");
    std::string known;
    for (const auto* s : all_studies) known += fmt::format("\n  {:14} {}", s->name, s->title);
    std::string recorded;
    for (const auto* s : recorded_studies) recorded += fmt::format("\n  {:14} {}", s->name, s->title);
    verb.footer("Studies:" + known + "\n\nOf recordings, which CORPUSCLE_DATA says where to find; no part of all:" + recorded +
                "\n\nExamples:\n  corpuscle study all --report reproduction.html\n  corpuscle study fig24 table17 --report chips.html\n"
                "  corpuscle study fig3 --json");
    verb.add_option("NAME", w.names, "which studies (default: all)");
    verb.add_option("--report", w.report_file, "write a page to look at: figures to zoom into, what was printed beside what was made")
        ->type_name("FILE.html");
    verb.callback([&w] {
        if (!w.report_file.empty() && !w.report_file.ends_with(".html")) throw CLI::ValidationError(page_name_needed(w.report_file));
    });
    verb.add_option("--markdown", w.markdown_file, "write all numbers as text")->type_name("FILE.md");
    add_common(verb, common);
    add_overwrite(verb, common);
}

void add_run(CLI::App& app, RunWords& w, Common& common) {
    auto& verb = *app.add_subcommand("run", "the analyses written in a netlist -> .raw, CSV, printed measures");
    std::string known;
    for (const auto& a : circuit::analyses) known += fmt::format("\n  {}\n      {}", a.usage, a.sentence);
    verb.footer(
        "A netlist is SPICE: a title, elements (R C L V I E F G H B D M X), .model, .subckt, .param, .include, .lib, .options ... and "
        "what\n"
        "is asked of it:" +
        known + run_examples);
    verb.add_option("NETLIST", w.netlist, "a SPICE netlist, or one by name: sa1-circuit, fa1-circuit")->required();
    verb.add_option("--set,-s", w.settings,
                    "a .param, an array (summer.N3B=8x4), a device's value (cco.cu=4pF) or any number (N3B.w=1.2um)")
        ->allow_extra_args(false)
        ->type_name("NAME=VALUE");
    verb.add_flag("--budget", w.budget, "what the circuit costs, too: power, area and leakage, block by block");
    add_netlist_words(verb, w.netlists);
    verb.add_option("--out,-o", w.out, "write what was found: x.raw, as ngspice's (binary), or x.csv")->type_name("FILE")->group("Output");
    verb.add_flag("--ascii", w.ascii, "the .raw file in letters")->group("Output");
    add_common(verb, common);
    add_overwrite(verb, common);
}

void add_export(CLI::App& app, ExportWords& w, Common& common) {
    auto& verb = *app.add_subcommand("export", "a netlist as another simulator's deck, for a second opinion");
    verb.footer(export_examples);
    verb.add_option("NETLIST", w.netlist, "a SPICE netlist, or one by name: sa1-circuit, fa1-circuit")->required();
    verb.add_option("--for", w.target, "whose deck: ngspice (39, as Debian has it)")
        ->check(CLI::IsMember({"ngspice"}))
        ->capture_default_str()
        ->type_name("SIMULATOR");
    verb.add_option("--out,-o", w.out, "write it here, not to standard output")->type_name("FILE")->group("Output");
    add_common(verb, common);
    add_overwrite(verb, common);
}

void add_list(CLI::App& app, ListWords& w, Common& common) {
    auto& verb = *app.add_subcommand("list", "everything the catalogues hold, each parameter with default, unit, range and sentence");
    verb.footer("Examples:\n  corpuscle list\n  corpuscle list neurons\n  corpuscle list sa1 press\n  corpuscle list 'grid 4x4' --sites");
    verb.add_option("WHAT", w.what,
                    "afferents, sensors, transducers, converters, transductions, neurons, stimuli, measures, formats, or names of any");
    verb.add_flag("--sites", w.sites,
                  "of a population (hand, 'grid 4x4', own.toml): its sites in the order of a frame, as CSV: name, x_mm, y_mm, region");
    add_common(verb, common);
}

/// The options that were given to the verb.
std::vector<TypedOption> typed_options(const CLI::App& app) {
    std::vector<TypedOption> out;
    for (const auto* verb : app.get_subcommands())
        for (const auto* option : verb->get_options())
            if (option->count() > 0) out.push_back({option->get_name(), option->results()});
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    Common common;
    common.command = quoted(argc, argv);
    RespondWords respond_words;
    CompareWords compare_words;
    StudyWords study_words;
    RunWords run_words;
    ExportWords export_words;
    ListWords list_words;

    std::signal(SIGXFSZ, SIG_IGN);  // a file that may grow no further is an error of writing
    CLI::App app(about, "corpuscle");
    app.formatter(std::make_shared<Help>());
    app.set_version_flag("--version", fmt::format("corpuscle {}", version));
    app.footer(first_steps);
    app.require_subcommand(1);
    add_respond(app, respond_words, common);
    add_compare(app, compare_words, common);
    add_study(app, study_words, common);
    add_run(app, run_words, common);
    add_export(app, export_words, common);
    SweepVerbs sweeps;
    sweeps.add_to(app, common);
    StreamVerb live;
    live.add_to(app, common);
    add_list(app, list_words, common);
    const auto run_verb = [&] {
        return app.got_subcommand("list")      ? list(list_words, common)
               : app.got_subcommand("run")     ? run(run_words, common)
               : app.got_subcommand("export")  ? export_to(export_words, common)
               : app.got_subcommand("study")   ? study(study_words, common)
               : app.got_subcommand("sweep")   ? sweeps.run(common)
               : app.got_subcommand("stream")  ? live.run(common)
               : app.got_subcommand("compare") ? compare(compare_words, common)
                                               : respond(respond_words, common);
    };
    int status = 0;
    try {
        auto words = with_help_first({argv + 1, argv + argc});
        if (const auto error = unknown_verb(app, words); !error.empty()) return fail(bad_usage(error));
        std::reverse(words.begin(), words.end());  // as CLI11 takes them
        app.parse(std::move(words));
        common.typed = typed_options(app);
        status = run_verb();
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() != 0) {
            tell(e.what());
            tell("'corpuscle --help' and 'corpuscle VERB --help' list the options");
            return 2;
        }
        std::ostringstream text;
        app.exit(e, text, text);
        std::fwrite(text.str().data(), 1, text.str().size(), stdout);
    } catch (const std::system_error&) {  // standard output: a closed pipe, a full disk
        if (interrupted()) return fail({Code::interrupted, "interrupted"});
        const auto done = finish_output();
        return fail(done ? bad_input("standard output cannot be written to the end") : done.error());
    } catch (const std::bad_alloc&) {
        return fail(bad_input("there is not enough memory for this; take fewer afferents, sites or samples at a time"));
    } catch (const std::exception& e) {
        return fail(bad_input(e.what()));
    }
    const auto done = finish_output();
    return status == 0 && !done ? fail(done.error()) : status;
}
