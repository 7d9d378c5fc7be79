// corpuscle respond: its options and the examples of its help.

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "cli/output/output_files.hpp"
#include "cli/respond/planned_run.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/verbs.hpp"
#include "io/table/foreign_format.hpp"
#include "model/copies.hpp"
#include "report/page_file.hpp"
#include "run/trials/trial_option_group.hpp"

namespace corpuscle {
namespace {

constexpr const char* respond_examples =
    R"(FORCE is a file of numbers in columns (- for standard input), or a stimulus: press, ramp-hold, step,
sine, chirp, noise, grating, or a sum such as press+noise (after its end a shorter stimulus keeps
its last value).

An afferent is one of
  a model of the thesis: sa1 fa1; calibrated to nerves: sa1-nerve fa1-nerve sa2 fa2 (TouchSim's RA
  and PC mean fa1-nerve and fa2); in fixed point: sa1-kim fa1-lee
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
  corpuscle respond palm.csv --rate 1kHz --population hand --taxels palm-taxels.csv     16 taxels on the palm of a hand
  corpuscle respond touch.csv --channel fz --scale 0.02 --abs --out result --report
  corpuscle respond touch.csv --trials onset --window -0.1..0.5 --report      each contact is a trial, aligned to its onset
  corpuscle respond eskin.csv --rate 100Hz --scale 40      irregular timestamps: assume even sampling
  corpuscle respond grip.csv --rate 250Hz --scale 0.002 --range 0..4095 --despike 200 --notch 50Hz     remove outliers and mains hum

The unit of a recording is read from its header (fz_N, "fz [mN]"). If the header has none, give
--unit, or --scale S (newtons per unit of the recording). Sampling times come from the time column
(--time names it) or from --rate.)";

/// The method; its texts are those that the row accepts.
Result<Method> parse_method(const std::string& text) { return text == "exact" ? Method::exact : Method::backward_euler; }

Result<double> parse_noise(const std::string& text) {
    const auto noise = TRY(quantity_of("A")(text));
    if (noise >= 0) return noise;
    return bad_usage(fmt::format("'{}' is negative; write a standard deviation, such as '50 nA'", text));
}

OptionReader spread_reader(std::vector<ParameterOverride>& spreads) {
    return [read = override_reader(spreads, "--spread")](const std::string& text) -> Result<void> {
        if (read(text)) return {};
        return bad_usage(fmt::format("'{}': write NAME.PARAMETER=SPREAD, such as 'sa1.f_B=10%' or 'sa1.f_B=x1.5'", text));
    };
}

OptionGroup afferent_options(RespondArguments& args) {
    return {
        "",
        {suggesting(force_names, repeatable({"FORCE", list_reader(args.forces, read_force), "TEXT", "recordings and stimuli"})),
         suggesting(
             afferent_names,
             with_default("sa1,fa1",
                          split_at_commas({"--afferent,-a",
                                           list_reader(args.afferents, [](const std::string& name) { return Result<std::string>(name); }),
                                           "NAME", "the afferents to simulate (repeat the option, or separate by commas)"}))),
         suggesting(setting_names, repeatable({"--set,-s", override_reader(args.settings, "--set"), "NAME.PARAMETER=VALUE",
                                               "set a parameter of an afferent or a stimulus, such as sa1.f_B=25Hz"})),
         {"--copies", &args.copies, "N", "simulate N copies of each afferent on every channel: sa1#1 ... sa1#N", std::pair(1U, max_copies)},
         suggesting(
             setting_names,
             repeatable({"--spread", spread_reader(args.spreads), "NAME.PARAMETER=10%",
                         "vary a parameter between copies: by its standard deviation, relative (10%) or with its unit, or by a factor (x3, "
                         "lognormal)"}))}};
}

OptionGroup skin_options(RespondArguments& args) {
    return {
        "Skins",
        {suggesting(population_names,
                    {"--population,-p", &args.population, "NAME|FILE",
                     "simulate a skin (instead of --afferent): hand, fingertip, 'grid 8x8', or a population file (doc/skin.md)"}),
         suggesting(indenter_names,
                    {"--contact", &args.contact, "INDENTER",
                     "indenter that applies the force of a single channel to the skin: flat (default), sphere, edge, grating; for its "
                     "parameters see 'corpuscle list contact', and set them by --set contact.radius=5mm"}),
         {"--taxels", &args.taxels, "FILE",
          "layout of the taxels that the recording is from (name,x_mm,y_mm,width_mm,height_mm,region ...): their forces are spread over "
          "the sites of the skin in their areas (doc/taxels.md)"},
         {"--checkpoint", &args.outputs.checkpoint, "FILE",
          "save progress in this file; after an interruption the same command continues"}}};
}

OptionGroup simulation_options(RespondArguments& args) {
    const auto use_single_precision = [&args](const std::string&) {
        return args.simulation.precision = Precision::single_precision, Result<void>();
    };
    return {
        "",
        {with_default("exact", {"--method", value_reader(args.simulation.method, parse_method), "METHOD",
                                "time stepping: exact, or backward-euler as in the thesis", one_of("exact", "backward-euler")}),
         {"--sampled", &args.simulation.sampled, "",
          "put spikes on the sampling times, as in the thesis (default: interpolate within the step)"},
         {"--noise", value_reader(args.simulation.noise, parse_noise), "CURRENT",
          "add white noise current to every membrane: its standard deviation in a bandwidth of 1 kHz, such as 100nA"},
         {"--seed", &args.simulation.seed, "N", "seed of all random numbers", OptionSign::not_negative},
         {"--threads,-j", &args.threads, "N", "number of threads (0: one per core, under mpirun one per rank); results do not depend on it",
          std::pair(0U, 1024U)},
         {"--float", use_single_precision, "",
          "single precision: up to twice as fast, but spike times change (see doc/lanes.md); currents and membranes are not recorded"},
         {"--rate", quantity_reader(args.recording.rate, "Hz"), "FREQUENCY",
          "sampling rate of a stimulus (default 10 kHz; with --population 1 kHz). For a recording: assume even sampling at this rate"}}};
}

OptionGroup output_options(RespondArguments& args) {
    OptionGroup group{
        "Output",
        {{"--out,-o", &args.outputs.directory, "DIR",
          "write spikes.csv and summary.json into this directory; also copies.csv with --copies, afferents.csv with --population"}}};
    for (const auto* format : output_formats)
        if (const std::string option(format->option); !option.empty()) {
            const auto keep = [&args, option](const std::string& text) { return args.outputs.formats[option] = text, Result<void>(); };
            group.rows.push_back({format->option, keep, format->value_name, format->help});
        }
    const auto add_field = [&args](const std::string& text) { return args.outputs.nwb_fields.push_back(text), Result<void>(); };
    group.rows.push_back(repeatable({"--nwb-field", add_field, "FIELD=TEXT",
                                     "with --nwb: a field of the file, such as session_start_time=2026-03-01T12:00:00+01:00 or "
                                     "'experimenter=Doe, Jane'"}));
    group.rows.push_back(counted(
        0, 1, {"--report", &args.report_file, "[FILE.html]", "write a report page (default: report.html, in the directory of --out)"}));
    return group;
}

/// The error for `respond press --report touch`, in which the name of the page is a force.
Error force_as_page(const RespondArguments& args, const Error& error) {
    std::string forces;
    for (const auto& force : args.forces) forces += quote_shell_word(force.text) + " ";
    const auto is_page = [&](const ForceArgument& force) { return force.text == args.report_file; };
    if (std::none_of(args.forces.begin(), args.forces.end(), is_page)) forces += quote_shell_word(args.report_file) + " ";
    return bad_usage(fmt::format("{}; for a report of these forces type: corpuscle respond {}--report", error.message, forces));
}

Result<void> complete_arguments(RespondArguments& args, const CommonArguments& common) {
    if (args.afferents.empty()) args.afferents = {"sa1", "fa1"};
    if (const auto ok = check_page_name(args.report_file); !ok) {
        if (!is_force(args.report_file)) return ok;
        if (!args.forces.empty()) return force_as_page(args, ok.error());
        args.forces.push_back(read_force(std::exchange(args.report_file, "")));  // respond --report press
    }
    const auto& directory = args.outputs.directory;
    if (std::any_of(common.typed.begin(), common.typed.end(), [](const TypedOption& option) { return option.name == "--report"; }))
        args.outputs.page = !args.report_file.empty() ? args.report_file : directory.empty() ? "report.html" : directory + "/report.html";
    return {};
}

}  // namespace

Verb make_respond_verb() {
    const auto args = std::make_shared<RespondArguments>();
    return {.name = "respond",
            .description = "simulate afferents: force recordings or stimuli -> spikes, rates, report",
            .examples = respond_examples,
            .common_options = {"--afferent", "--set", "--population", "--copies", "--spread", "--trials", "--rate", "--channel", "--unit", "--scale",
                               "--out", "--report", "--json"},
            .options = {afferent_options(*args), skin_options(*args), simulation_options(*args), trial_option_group(args->trials),
                        recording_option_group(args->recording),
                        output_options(*args), netlist_options(args->netlists)},
            .reports = true,
            .writes_files = true,
            .check = [args](const CommonArguments& common) { return complete_arguments(*args, common); },
            .run = [args](const CommonArguments& common) { return respond(*args, common); }};
}

}  // namespace corpuscle
