#include "cli/stream_verbs.hpp"

#include <CLI/CLI.hpp>

#include "cli/arguments/option_groups.hpp"
#include "cli/program.hpp"

namespace corpuscle {
namespace {

constexpr const char* stream_examples =
    R"(A frame is one force per site, all sampled at the same time. The time of a frame is its number
divided by --rate, not its time of arrival. A CSV frame is a line of text; a binary frame is a
sequence of numbers (f32, f64 or i16, little-endian). With --stamp sequence a frame begins with its
number (binary: u32), with --stamp time with its time in seconds (binary: f64). Gaps are then filled
by the last force, and duplicate and late frames are ignored. The summary at the end counts all of
these.

Input is never delayed: spikes that the receiver does not read in time are dropped and counted, and
the exit status is 1 (0 with --allow-drops). Exceptions: a stream waits for its own output file, and
a recording at --pace fast waits for the receiver.

POPULATION is hand, fingertip, "grid 8x8", a population file, or names of afferents, which are
simulated on each of --channels channels.

Examples:
  corpuscle stream --in press                                          try it: press, hold and release in real time
  sensor | corpuscle stream --rate 1kHz                                one force per line in, one spike per line out
  corpuscle stream --population hand --rate 1kHz --frames f32 --in tcp:7000 --to 7001 --format aer
  corpuscle stream --population "grid 64x64" --rate 5.2kHz --frames f32 < frames.f32 > spikes.aer --format aer
  corpuscle stream --channels 16 --rate 500Hz --in serial:/dev/ttyACM0 --baud 921600 --frames i16 --scale 2mN -o spikes.csv
  corpuscle stream --in grip.csv --unit mN --format jsonl --pace fast  a recording, with the recording options of respond
  corpuscle stream --channels 16 --rate 1kHz --in udp:7000 --stamp sequence --frames f32     numbered frames in datagrams
  corpuscle stream --rate 1kHz --save-state now.state; corpuscle stream --rate 1kHz --resume now.state

Ctrl-C ends the stream: received frames are processed, files and the state are saved, and a summary
is printed on standard error.)";

void add_frames(CLI::App& verb, StreamArguments& args) {
    verb.add_option("--in,-i", args.in,
                    "source of the frames: - (standard input), tcp:PORT or udp:PORT to listen on (0: any free port), serial:DEVICE, a "
                    "recording, or a stimulus")
        ->capture_default_str()
        ->type_name("WHERE");
    verb.add_option("--rate,-r", args.rate, "frame rate (default for a recording: its sampling rate)")->type_name("FREQUENCY");
    const auto group = "Frames";
    verb.add_option("--frames", args.frames, "frame format: csv, or little-endian f32, f64, i16")
        ->check(CLI::IsMember({"csv", "f32", "f64", "i16"}))
        ->capture_default_str()
        ->type_name("KIND")
        ->group(group);
    verb.add_option("--stamp", args.stamp, "first field of a frame: none, sequence (its number), or time (in seconds)")
        ->check(CLI::IsMember({"none", "sequence", "time"}))
        ->capture_default_str()
        ->type_name("WHAT")
        ->group(group);
    verb.add_option("--max-force", args.max_force, "maximum valid force; beyond it the last force of the site is used")
        ->capture_default_str()
        ->type_name("FORCE")
        ->group(group);
    verb.add_option("--hold", args.hold, "hold the last force for TIME in a gap, then use 0 N")
        ->capture_default_str()
        ->type_name("TIME")
        ->group(group);
    verb.add_option("--max-gap", args.max_gap, "treat a larger jump of the stamp as a restart of the sender")
        ->capture_default_str()
        ->type_name("TIME")
        ->group(group);
    verb.add_option("--listen", args.listen, "local address for tcp:PORT and udp:PORT; 0.0.0.0: all addresses")
        ->capture_default_str()
        ->type_name("ADDRESS")
        ->group(group);
    verb.add_option("--clients", args.clients, "end after N senders to tcp:PORT or udp:PORT, one after another (0: no limit)")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str()
        ->type_name("N")
        ->group(group);
    verb.add_option("--idle-timeout", args.idle_timeout, "disconnect a sender that is silent for TIME if another is waiting (0: never)")
        ->capture_default_str()
        ->type_name("TIME")
        ->group(group);
    verb.add_option("--baud", args.baud, "baud rate of a serial device")->capture_default_str()->type_name("N")->group(group);
    verb.add_option("--pace", args.pace, "pace of a recording or stimulus: real (real time), or fast (no waiting)")
        ->check(CLI::IsMember({"real", "fast"}))
        ->capture_default_str()
        ->type_name("PACE")
        ->group(group);
}

void add_events(CLI::App& verb, StreamArguments& args) {
    const auto group = "Spikes";
    verb.add_option("--out,-o", args.out, "write the spikes to - (standard output) or to a file, named FILE.part until the end")
        ->capture_default_str()
        ->type_name("FILE")
        ->group(group);
    verb.add_option("--to", args.to, "send the spikes to a TCP server (default host: this machine)")
        ->type_name("[HOST:]PORT")
        ->group(group);
    verb.add_option(
            "--format,-f", args.format,
            "spike format: lines (afferent,channel,time_s), jsonl, aer (binary, exact times), aedat2; binary headers map addresses to "
            "afferents and channels (doc/events.md)")
        ->capture_default_str()
        ->type_name("FORMAT")
        ->group(group);
    verb.add_option("--buffer", args.buffer, "buffer for a slow receiver, in bytes; spikes beyond it are dropped and counted")
        ->capture_default_str()
        ->type_name("BYTES")
        ->group(group);
    verb.add_flag("--allow-drops", args.allow_drops, "exit with status 0 even if spikes were dropped or datagrams lost")->group(group);
    verb.add_option("--save-state", args.save_state, "save the state at the end, including spikes that are not yet due")
        ->type_name("FILE")
        ->group(group);
    verb.add_option("--resume", args.resume, "continue from a saved state, with the same population and rate")
        ->type_name("FILE")
        ->group(group);
}

}  // namespace

void StreamVerb::add_to(CLI::App& app, CommonArguments& common) {
    auto& verb = *app.add_subcommand("stream", "simulate live: frames of force in, spikes out");
    auto& args = arguments_;
    verb.footer(stream_examples);
    verb.add_option("--population,-p", args.population, "the afferents to simulate")->capture_default_str()->type_name("POPULATION");
    verb.add_option("--channels,-n", args.channel_count, "forces per frame, if the population is given by names of afferents")
        ->check(CLI::Range(1, 1 << 22))
        ->capture_default_str()
        ->type_name("N");
    verb.add_option("--set,-s", args.settings,
                    "set a parameter of an afferent, a class of the population or a stimulus, such as sa1.f_B=25Hz")
        ->allow_extra_args(false)
        ->type_name("NAME.PARAMETER=VALUE");
    verb.add_flag("--sampled", args.sampled, "put spikes on the sampling times, as in the thesis (default: interpolate within the step)");
    verb.add_option("--batch-frames", args.batch_frames,
                    "process N frames at once: less CPU time, but up to N frames more latency; the spikes are the same")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str()
        ->type_name("N");
    verb.add_flag("--busy-poll", args.busy_poll, "poll for frames without sleeping: lower latency, but occupies one core");
    add_frames(verb, args);
    add_recording_options(verb, args);
    add_events(verb, args);
    add_common(verb, common);
    add_overwrite(verb, common);
}

}  // namespace corpuscle
