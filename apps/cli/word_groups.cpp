#include "word_groups.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>

#include "io/foreign_format.hpp"

namespace corpuscle {

std::string page_name_needed(const std::string& name) {
    const auto dot = name.rfind('.');
    const auto stem = dot == std::string::npos || dot == 0 || name.find('/', dot) != std::string::npos ? name : name.substr(0, dot);
    return fmt::format("--report {}: needs a name that ends in .html, such as {}.html", name, stem);
}

std::string force_behind_report(const std::string& name, std::vector<std::string> forces) {
    if (std::find(forces.begin(), forces.end(), name) == forces.end()) forces.push_back(name);
    std::string words;
    for (const auto& force : forces) words += shell_word(force) + " ";
    return fmt::format("{}; of forces a report is made by: corpuscle respond {}--report", page_name_needed(name), words);
}

void add_netlist_words(CLI::App& verb, NetlistWords& w) {
    const auto group = "Netlists";
    verb.add_option("--supply", w.supply, "its .param supply, such as 0.65V")->type_name("VOLTAGE")->group(group);
    verb.add_option("--temp", w.temp, "its temperature, in degrees Celsius")->type_name("DEGREES")->group(group);
    verb.add_option("--corner", w.corner,
                    "the section its libraries are read for: tt ss ff sf fs, or mc (then --mismatch draws the process, too)")
        ->type_name("CORNER")
        ->group(group);
    verb.add_option("--mismatch", w.mismatch, "one chip, each transistor with a threshold and current of its own, in place of .mc")
        ->type_name("SEED[/CHIP]")
        ->group(group);
    verb.add_option("--trace", w.traces,
                    "show these in place of what .save names: vf, v(a,b), i(vdd), i(N3B): into a device's drain or first end, channel and "
                    "junction, without what charges take; of a path the end is enough: rectb.o")
        ->allow_extra_args(false)
        ->type_name("WHAT,WHAT")
        ->group(group);
}

namespace {

/// --transpose and --no-transpose, which share a value.
void add_orientation(CLI::App& verb, std::optional<bool>& transpose, const std::string& group) {
    auto* turned =
        verb.add_flag_callback("--transpose", [&transpose] { transpose = true; }, "each row of a recording's array or table is a channel");
    auto* upright = verb.add_flag_callback(
        "--no-transpose", [&transpose] { transpose = false; }, "each row is a sample, even if there are fewer rows than channels");
    turned->group(group)->excludes(upright);
    upright->group(group);
}

}  // namespace

void add_recording_words(CLI::App& verb, RecordingWords& w) {
    const auto group = "Recordings";
    verb.add_option("--channel,-c", w.channels,
                    "which channels of a recording: names, or numbers and ranges (2-5) that count all columns but the time")
        ->allow_extra_args(false)
        ->type_name("CHANNEL")
        ->group(group);
    verb.add_option("--dataset", w.dataset, "which array of a file that holds several (HDF5, NPZ), by its path or name")
        ->type_name("NAME")
        ->group(group);
    add_orientation(verb, w.transpose, group);
    verb.add_option("--skip", w.skip, "lines at the beginning of a file of text that are not part of its table")
        ->check(CLI::Range(0U, 1'000'000U))
        ->type_name("LINES")
        ->group(group);
    verb.add_option("--time", w.time, "a recording's time column by name or number, or 'none'")->type_name("COLUMN")->group(group);
    verb.add_option("--time-unit", w.time_unit, "what the time column is in, if its header does not say: s, ms, us, ns")
        ->type_name("UNIT")
        ->group(group);
    verb.add_option("--unit", w.unit, "what a recording holds: N, mN, gf, kgf, or raw (then say --scale)")->type_name("UNIT")->group(group);
    verb.add_option("--scale", w.scale, "what is read, times S, is newtons (0.002, 2mN)")->type_name("S")->group(group);
    verb.add_flag("--abs", w.absolute, "take the absolute value of what is read")->group(group);
    verb.add_option("--offset", w.offset, "what is read where there is no force; taken off before --scale")->type_name("X")->group(group);
    verb.add_option("--range", w.range, "what can be read at all; readings outside are bad")->type_name("LO..HI")->group(group);
    verb.add_option("--bad-fields", w.bad_fields,
                    "what becomes of fields that are no numbers, and of readings out of --range: error (else of fields), drop the row, "
                    "interpolate (else of readings)")
        ->check(CLI::IsMember({"error", "drop", "interpolate"}))
        ->type_name("WHAT")
        ->group(group);
    verb.add_option("--despike", w.despike,
                    "readings further than this from the median of the 25 about them are bad; auto: 6 standard deviations")
        ->type_name("LIMIT")
        ->group(group);
    verb.add_option("--notch", w.notch, "filter out mains hum: 50Hz, and 4 Hz about it (repeat for others)")
        ->allow_extra_args(false)
        ->type_name("FREQUENCY")
        ->group(group);
    verb.add_option("--lowpass", w.lowpass, "filter out what is faster (Butterworth, second order)")->type_name("FREQUENCY")->group(group);
    verb.add_option("--layout", w.layout, "a table that names the sensors and says where they sit: channel,name,x_mm,y_mm")
        ->type_name("FILE")
        ->group(group);
    verb.add_option("--resample", w.resample, "interpolate a recording to this rate")->type_name("FREQUENCY")->group(group);
}

void add_skin_words(CLI::App& verb, RespondWords& w) {
    const auto group = "Skins";
    auto* const population =
        verb.add_option("--population,-p", w.population,
                        "a whole skin in the place of --afferent: hand, fingertip, 'grid 8x8', or a population file (doc/skin.md)")
            ->type_name("NAME|FILE")
            ->group(group);
    verb.add_option(
            "--contact", w.contact,
            "what presses a force of one channel into the skin: flat (default), sphere, edge, grating; --set contact.radius=5mm and "
            "'corpuscle list contact' say more")
        ->type_name("INDENTER")
        ->needs(population)
        ->group(group);
    verb.add_option("--events", w.events, "write the skin's spikes as lines, jsonl, aer or aedat2 (doc/events.md) in place of spikes.csv")
        ->type_name("FORMAT")
        ->needs(population)
        ->group(group);
    verb.add_option("--checkpoint", w.checkpoint,
                    "keep how far it is in this file: killed or interrupted, the same command goes on from there")
        ->type_name("FILE")
        ->needs(population)
        ->group(group);
}

}  // namespace corpuscle
