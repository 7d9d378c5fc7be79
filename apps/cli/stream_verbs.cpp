#include "stream_verbs.hpp"

#include <CLI/CLI.hpp>

#include "sweep_verbs.hpp"
#include "word_groups.hpp"

namespace corpuscle {
namespace {

constexpr const char* stream_examples =
    R"(A frame is one force a site, all read at one instant. Its time is its number over --rate, never when it arrived. As CSV a frame is a
line; in binary (f32, f64, i16, little-endian) one number after another. With --stamp count each begins with its number (binary: u32), with
--stamp time with its time in seconds (binary: f64); then gaps are filled by the last force, duplicates and late frames left out. All of
that is counted, and told at the end. A recording at --pace fast waits for a slow reader of the spikes, and any stream for its own file;
else force never waits: spikes that a reader does not take in time are left out and counted, and the exit status is 1 (--allow-drops: 0).

POPULATION is hand, fingertip, "grid 8x8", a population file, or afferents by name, on every one of --channels channels.

Examples:
  corpuscle stream --in press                                          try it: the thesis's press, at its own pace
  sensor | corpuscle stream --rate 1kHz                                a force a line in, a spike a line out
  corpuscle stream --population hand --rate 1kHz --frames f32 --in tcp:7000 --to 7001 --format aer
  corpuscle stream --population "grid 64x64" --rate 5.2kHz --frames f32 < frames.f32 > spikes.aer --format aer
  corpuscle stream --channels 16 --rate 500Hz --in serial:/dev/ttyACM0 --baud 921600 --frames i16 --scale 2mN -o spikes.csv
  corpuscle stream --in grip.csv --unit mN --format jsonl --pace fast  a recording, with all options of respond
  corpuscle stream --channels 16 --rate 1kHz --in udp:7000 --stamp count --frames f32     frames in datagrams, numbered
  corpuscle stream --rate 1kHz --save-state now.state; corpuscle stream --rate 1kHz --resume now.state

Ctrl-C ends it: what has come is answered, files are whole, the state is kept, and a summary is printed on standard error.)";

void add_frames(CLI::App& verb, StreamWords& w) {
    verb.add_option("--in,-i", w.in,
                    "where frames come from: - (standard input), tcp:PORT or udp:PORT to listen on (0: any that is free), serial:DEVICE, a "
                    "recording, or a stimulus by name")
        ->capture_default_str()
        ->type_name("WHERE");
    verb.add_option("--rate,-r", w.rate, "frames a second; of a recording, as its clock says if nothing is said")->type_name("FREQUENCY");
    const auto group = "Frames";
    verb.add_option("--frames", w.frames, "what they are: csv, or little-endian f32, f64, i16")
        ->check(CLI::IsMember({"csv", "f32", "f64", "i16"}))
        ->capture_default_str()
        ->type_name("KIND")
        ->group(group);
    verb.add_option("--stamp", w.stamp, "what stands before each: none, its count, or its time in seconds")
        ->check(CLI::IsMember({"none", "count", "time"}))
        ->capture_default_str()
        ->type_name("WHAT")
        ->group(group);
    verb.add_option("--limit", w.limit, "a force beyond it is no reading: that site's last is held")
        ->capture_default_str()
        ->type_name("FORCE")
        ->group(group);
    verb.add_option("--hold", w.hold, "of a gap: as long the last force is held, then there is none")
        ->capture_default_str()
        ->type_name("TIME")
        ->group(group);
    verb.add_option("--longest-gap", w.longest, "a stamp further from the last is no gap: the sender's count began anew")
        ->capture_default_str()
        ->type_name("TIME")
        ->group(group);
    verb.add_option("--listen", w.listen, "which of this machine's addresses tcp:PORT and udp:PORT listen on; 0.0.0.0 is all of them")
        ->capture_default_str()
        ->type_name("ADDRESS")
        ->group(group);
    verb.add_option("--clients", w.clients, "end after so many senders to tcp:PORT or udp:PORT, one after another (0: go on)")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str()
        ->type_name("N")
        ->group(group);
    verb.add_option("--idle-limit", w.idle, "a sender that was silent for so long makes way for another that wants to send (0: never)")
        ->capture_default_str()
        ->type_name("TIME")
        ->group(group);
    verb.add_option("--baud", w.baud, "of a serial device")->capture_default_str()->type_name("N")->group(group);
    verb.add_option("--pace", w.pace, "of a recording: real, each frame when it is due, or fast")
        ->check(CLI::IsMember({"real", "fast"}))
        ->capture_default_str()
        ->type_name("PACE")
        ->group(group);
}

void add_events(CLI::App& verb, StreamWords& w) {
    const auto group = "Spikes";
    verb.add_option("--out,-o", w.out, "where spikes go: - (standard output), or a file, which is FILE.part while it grows")
        ->capture_default_str()
        ->type_name("FILE")
        ->group(group);
    verb.add_option("--to", w.to, "send them to who listens there; on this machine if only a port is said")
        ->type_name("[HOST:]PORT")
        ->group(group);
    verb.add_option("--format,-f", w.format, "lines (afferent,channel,time_s), jsonl, aer (binary, all of it), aedat2; their headers say which address is which afferent and channel (doc/events.md)")
        ->capture_default_str()
        ->type_name("FORMAT")
        ->group(group);
    verb.add_option("--buffer", w.buffer, "bytes that may wait for a slow reader; what is more is left out and counted")
        ->capture_default_str()
        ->type_name("BYTES")
        ->group(group);
    verb.add_flag("--allow-drops", w.allow_drops, "spikes that a reader did not take, and datagrams that were lost, are no error")
        ->group(group);
    verb.add_option("--save-state", w.save, "at the end keep where all stands in this file; spikes on their way are part of it")
        ->type_name("FILE")
        ->group(group);
    verb.add_option("--resume", w.resume, "go on from there: the same population, the same rate")->type_name("FILE")->group(group);
}

}  // namespace

void StreamVerb::add_to(CLI::App& app, Common& common) {
    auto& verb = *app.add_subcommand("stream", "forces in as they come, spikes out as they happen");
    auto& w = words_;
    verb.footer(stream_examples);
    verb.add_option("--population,-p", w.population, "what answers")->capture_default_str()->type_name("POPULATION");
    verb.add_option("--channels,-n", w.count, "of afferents by name: how many forces a frame has")
        ->check(CLI::Range(1, 1 << 22))
        ->capture_default_str()
        ->type_name("N");
    verb.add_option("--set,-s", w.settings, "a parameter, of an afferent, a population's class or a stimulus, with its unit")
        ->allow_extra_args(false)
        ->type_name("NAME.PARAMETER=VALUE");
    verb.add_flag("--sampled", w.sampled, "spikes on the samples, as in the thesis; else interpolated inside the step");
    verb.add_option("--together", w.together,
                    "answer so many frames at once: a fraction of the work, and spikes up to so many frames late; the spikes are the same")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str()
        ->type_name("N");
    verb.add_flag("--spin", w.spin, "wait for frames without sleeping: takes a core of its own, and saves the time to wake");
    add_frames(verb, w);
    add_recording_words(verb, w);
    add_events(verb, w);
    add_common(verb, common);
    add_overwrite(verb, common);
}

}  // namespace corpuscle
