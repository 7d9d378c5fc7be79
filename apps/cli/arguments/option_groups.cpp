#include "cli/arguments/option_groups.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>

#include "io/table/foreign_format.hpp"
#include "run/sinks.hpp"

namespace corpuscle {

std::string page_name_error(const std::string& name) {
    const auto dot = name.rfind('.');
    const auto stem = dot == std::string::npos || dot == 0 || name.find('/', dot) != std::string::npos ? name : name.substr(0, dot);
    return fmt::format("--report {}: the name must end in .html, such as {}.html", name, stem);
}

std::string report_argument_error(const std::string& name, std::vector<std::string> forces) {
    if (std::find(forces.begin(), forces.end(), name) == forces.end()) forces.push_back(name);
    std::string arguments;
    for (const auto& force : forces) arguments += quote_shell_word(force) + " ";
    return fmt::format("{}; for a report of these forces type: corpuscle respond {}--report", page_name_error(name), arguments);
}

void add_netlist_options(CLI::App& verb, NetlistArguments& args) {
    const auto group = "Netlists";
    verb.add_option("--supply", args.supply, "supply voltage of the circuit (its .param supply), such as 0.65V")
        ->type_name("VOLTAGE")
        ->group(group);
    verb.add_option("--temp", args.temp, "temperature in degrees Celsius")->type_name("DEGREES")->group(group);
    verb.add_option("--corner", args.corner,
                    "process corner (library section): tt ss ff sf fs, or mc (--mismatch then also samples the process)")
        ->type_name("CORNER")
        ->group(group);
    verb.add_option("--mismatch", args.mismatch,
                    "simulate one mismatched chip: random threshold and current of each transistor (replaces .mc)")
        ->type_name("SEED[/CHIP]")
        ->group(group);
    verb.add_option(
            "--probe", args.probes,
            "record these instead of the .save list (run: in addition to it): vf, v(a,b), i(vdd), i(N3B). A device current flows into "
            "the drain or the first terminal; displacement current is not included. The last part of a path is enough: rectb.o")
        ->allow_extra_args(false)
        ->type_name("WHAT,WHAT")
        ->group(group);
}

namespace {

/// Adds --transpose and --no-transpose, which set the same value.
void add_orientation(CLI::App& verb, std::optional<bool>& transpose, const std::string& group) {
    auto* transposed = verb.add_flag_callback("--transpose", [&transpose] { transpose = true; }, "rows of a recording are channels");
    auto* not_transposed = verb.add_flag_callback(
        "--no-transpose", [&transpose] { transpose = false; },
        "rows of a recording are samples, even if there are fewer rows than channels");
    transposed->group(group)->excludes(not_transposed);
    not_transposed->group(group);
}

}  // namespace

void add_recording_options(CLI::App& verb, RecordingArguments& args) {
    const auto group = "Recordings";
    verb.add_option("--channel,-c", args.channels,
                    "channels of a recording: names, or numbers and ranges (2-5) that count all columns except time")
        ->allow_extra_args(false)
        ->type_name("CHANNEL")
        ->group(group);
    verb.add_option("--dataset", args.dataset, "array to read from a file with several (HDF5, NPZ), by path or name")
        ->type_name("NAME")
        ->group(group);
    add_orientation(verb, args.transpose, group);
    verb.add_option("--skip", args.skip, "number of lines to skip at the beginning of a text file")
        ->check(CLI::Range(0U, 1'000'000U))
        ->type_name("LINES")
        ->group(group);
    verb.add_option("--time", args.time, "time column of a recording by name or number, or 'none'")->type_name("COLUMN")->group(group);
    verb.add_option("--time-unit", args.time_unit, "unit of the time column, if the header has none: s, ms, us, ns")
        ->type_name("UNIT")
        ->group(group);
    verb.add_option("--unit", args.unit, "unit of the recording: N, mN, gf, kgf, or raw (with --scale)")->type_name("UNIT")->group(group);
    verb.add_option("--scale", args.scale, "newtons per unit of the recording: 0.002, 2mN")->type_name("S")->group(group);
    verb.add_flag("--abs", args.absolute, "use the absolute value of each reading")->group(group);
    verb.add_option("--offset", args.offset, "reading at zero force, subtracted before --scale")->type_name("X")->group(group);
    verb.add_option("--range", args.range, "valid range of readings; --bad-fields says what happens to others")
        ->type_name("LO..HI")
        ->group(group);
    verb.add_option("--bad-fields", args.bad_fields,
                    "what to do with fields that are not numbers and readings out of --range: error (default for fields), drop the row, "
                    "interpolate (default for readings)")
        ->check(CLI::IsMember({"error", "drop", "interpolate"}))
        ->type_name("WHAT")
        ->group(group);
    verb.add_option("--despike", args.despike,
                    "outlier limit: readings further than this from the median of 25 neighbours are bad (auto is 6 standard deviations)")
        ->type_name("LIMIT")
        ->group(group);
    verb.add_option("--notch", args.notch, "remove mains hum: 50Hz, with a bandwidth of 4 Hz (repeatable)")
        ->allow_extra_args(false)
        ->type_name("FREQUENCY")
        ->group(group);
    verb.add_option("--lowpass", args.lowpass, "low-pass filter at this frequency (Butterworth, second order)")
        ->type_name("FREQUENCY")
        ->group(group);
    verb.add_option("--layout", args.layout, "CSV table of sensor names and positions: channel,name,x_mm,y_mm")
        ->type_name("FILE")
        ->group(group);
    verb.add_option("--resample", args.resample, "resample a recording to this rate by interpolation")
        ->type_name("FREQUENCY")
        ->group(group);
}

void add_skin_options(CLI::App& verb, RespondArguments& args) {
    const auto group = "Skins";
    verb.add_option("--population,-p", args.population,
                    "simulate a skin (instead of --afferent): hand, fingertip, 'grid 8x8', or a population file (doc/skin.md)")
        ->type_name("NAME|FILE")
        ->group(group);
    verb.add_option("--contact", args.contact,
                    "indenter that applies the force of a single channel to the skin: flat (default), sphere, edge, grating; for its "
                    "parameters see 'corpuscle list contact', and set them by --set contact.radius=5mm")
        ->type_name("INDENTER")
        ->group(group);
    verb.add_option("--checkpoint", args.checkpoint, "save progress in this file; after an interruption the same command continues")
        ->type_name("FILE")
        ->group(group);
}

void add_output_formats(CLI::App& verb, RespondArguments& args) {
    for (const auto* format : output_formats) {
        const std::string option(format->option), help(format->help);
        if (option.empty()) continue;
        if (format->value_name.empty())
            verb.add_flag_callback(option, [&args, option] { args.outputs[option]; }, help)->group("Output");
        else
            verb.add_option_function<std::string>(
                    option, [&args, option](const std::string& text) { args.outputs[option] = text; }, help)
                ->type_name(std::string(format->value_name))
                ->group("Output");
    }
}

}  // namespace corpuscle
