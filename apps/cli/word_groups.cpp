#include "word_groups.hpp"

#include <CLI/CLI.hpp>

namespace corpuscle {

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

void add_skin_words(CLI::App& verb, RespondWords& w) {
    const auto group = "Skins";
    verb.add_option("--population,-p", w.population,
                    "a whole skin in the place of --afferent: hand, fingertip, 'grid 8x8', or a population file (doc/skin.md)")
        ->type_name("NAME|FILE")
        ->group(group);
    verb.add_option(
            "--contact", w.contact,
            "what presses a force of one channel into the skin: flat (default), sphere, edge, grating; --set contact.radius=5mm and "
            "'corpuscle list contact' say more")
        ->type_name("INDENTER")
        ->group(group);
    verb.add_option("--events", w.events, "write the skin's spikes as lines, jsonl, aer or aedat2 (doc/events.md) in place of spikes.csv")
        ->type_name("FORMAT")
        ->group(group);
    verb.add_option("--checkpoint", w.checkpoint,
                    "keep how far it is in this file: killed or interrupted, the same command goes on from there")
        ->type_name("FILE")
        ->group(group);
}

void add_orientation(CLI::App& verb, std::optional<bool>& transpose, const std::string& group) {
    auto* turned =
        verb.add_flag_callback("--transpose", [&transpose] { transpose = true; }, "each row of a recording's array or table is a channel");
    auto* upright = verb.add_flag_callback(
        "--no-transpose", [&transpose] { transpose = false; }, "each row is a sample, even if there are fewer rows than channels");
    turned->group(group)->excludes(upright);
    upright->group(group);
}

}  // namespace corpuscle
