// corpuscle stream: its options and the examples of its help.

#include "cli/output/terminal.hpp"
#include "cli/shell/suggestions.hpp"
#include "cli/stream/page/stream_page.hpp"
#include "cli/verbs.hpp"

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
  corpuscle stream --population hand --taxels palm-taxels.csv --rate 1kHz < palm.csv    frames of 16 taxels on a palm
  corpuscle stream --channels 16 --rate 500Hz --in serial:/dev/ttyACM0 --baud 921600 --frames i16 --scale 2mN -o spikes.csv
  corpuscle stream --in grip.csv --unit mN --format jsonl --pace fast  a recording, with the recording options of respond
  corpuscle stream --channels 16 --rate 1kHz --in udp:7000 --stamp sequence --frames f32     numbered frames in datagrams
  sensor | corpuscle stream --rate 1kHz --serve 8080                   forces and spikes on a page, http://localhost:8080/
  corpuscle stream --in page --serve 8080                              press by pointer on a page
  corpuscle stream --rate 1kHz --save-state now.state; corpuscle stream --rate 1kHz --resume now.state

Ctrl-C ends the stream: received frames are processed, files and the state are saved, and a summary
is printed on standard error.)";

/// A quantity that is not negative.
OptionReader positive_reader(double& to, std::string_view unit) {
    return refuse_if([&to] { return !(to >= 0); }, "must not be negative", quantity_reader(to, unit));
}

OptionReader buffer_reader(double& to) {
    return refuse_if([&to] { return !(to >= 1000 && to <= 1e10); }, "must be between 1k and 10G bytes", positive_reader(to, ""));
}

OptionGroup population_options(StreamArguments& args) {
    return {
        "",
        {suggesting(live_population_names, {"--population,-p", &args.population, "POPULATION", "the afferents to simulate"}),
         {"--channels,-n", &args.channel_count, "N", "forces per frame, if the population is given by names of afferents",
          std::pair(1, 1 << 22)},
         {"--taxels", &args.taxels, "FILE",
          "layout of the taxels that the frames are from (name,x_mm,y_mm,width_mm,height_mm,region ...): their forces are spread over the "
          "sites of the skin in their areas (doc/taxels.md)"},
         suggesting(setting_names,
                    repeatable({"--set,-s", override_reader(args.settings, "--set"), "NAME.PARAMETER=VALUE",
                                "set a parameter of an afferent, a class of the population or a stimulus, such as sa1.f_B=25Hz"})),
         {"--sampled", &args.sampled, "", "put spikes on the sampling times, as in the thesis (default: interpolate within the step)"},
         {"--batch-frames", &args.batch_frames, "N",
          "process N frames at once: less CPU time, but up to N frames more latency; the spikes are the same", std::pair(1, 1024)},
         {"--busy-poll", &args.busy_poll, "", "poll for frames without sleeping: lower latency, but occupies one core"}}};
}

OptionGroup input_options(StreamArguments& args) {
    return {"",
            {{"--in,-i", &args.in, "WHERE",
              "source of the frames: - (standard input), tcp:PORT or udp:PORT to listen on (0: any free port), serial:DEVICE, a "
              "recording, a stimulus, or page: presses by pointer on the page of --serve"},
             {"--rate,-r", quantity_reader(args.recording.rate, "Hz"), "FREQUENCY",
              "frame rate (default for a recording: its sampling rate)"}}};
}

OptionGroup frame_options(StreamArguments& args) {
    return {
        "Frames",
        {{"--frames", &args.frames, "KIND", "frame format: csv, or little-endian f32, f64, i16", one_of("csv", "f32", "f64", "i16")},
         {"--stamp", &args.stamp, "WHAT", "first field of a frame: none, sequence (its number), or time (in seconds)",
          one_of("none", "sequence", "time")},
         with_default("1kN", {"--max-force", positive_reader(args.max_force, "N"), "FORCE",
                              "maximum valid force; beyond it the last force of the site is used"}),
         with_default("100ms", {"--hold", positive_reader(args.hold, "s"), "TIME", "hold the last force for TIME in a gap, then use 0 N"}),
         with_default("10s", {"--max-gap", positive_reader(args.max_gap, "s"), "TIME",
                              "treat a larger jump of the stamp as a restart of the sender"}),
         {"--listen", &args.listen, "ADDRESS", "local address for tcp:PORT and udp:PORT; 0.0.0.0: all addresses"},
         {"--clients", &args.clients, "N", "end after N senders to tcp:PORT or udp:PORT, one after another (0: no limit)",
          OptionSign::not_negative},
         with_default("10s", {"--idle-timeout", positive_reader(args.idle_timeout, "s"), "TIME",
                              "disconnect a sender that is silent for TIME if another is waiting (0: never)"}),
         {"--baud", &args.baud, "N", "baud rate of a serial device"},
         {"--pace", &args.pace, "PACE", "pace of a recording or stimulus: real (real time), or fast (no waiting)",
          one_of("real", "fast")}}};
}

OptionGroup spike_options(StreamArguments& args) {
    return {"Spikes",
            {{"--out,-o", &args.out, "FILE", "write the spikes to - (standard output) or to a file, named FILE.part until the end"},
             {"--to", &args.to, "[HOST:]PORT", "send the spikes to a TCP server (default host: this machine)"},
             {"--format,-f", &args.format, "FORMAT",
              "spike format: lines (afferent,channel,time_s), jsonl, aer (binary, exact times), aedat2; binary headers map addresses to "
              "afferents and channels (doc/events.md)"},
             with_default("1M", {"--buffer", buffer_reader(args.buffer), "BYTES",
                                 "buffer for a slow receiver, in bytes; spikes beyond it are dropped and counted"}),
             {"--allow-drops", &args.allow_drops, "", "exit with status 0 even if spikes were dropped or datagrams lost"},
             {"--save-state", &args.save_state, "FILE", "save the state at the end, including spikes that are not yet due"},
             {"--resume", &args.resume, "FILE", "continue from a saved state, with the same population and rate"}}};
}

OptionGroup page_options(StreamArguments& args) {
    return {"Page",
            {{"--serve", &args.serve, "PORT",
              "show the stream on a page, at http://localhost:PORT/ (0: any free port); spikes are then written only with --out or --to",
              std::pair(0U, 65535U)},
             {"--bind", &args.bind, "ADDRESS",
              "serve the page at this address of the machine, such as 0.0.0.0 (all), instead of to this machine only; the printed address "
              "of the page then has a token, without which there is no access"},
             {"--max-viewers", &args.max_viewers, "N", "number of pages that may be connected (default: 256, with --in page 8)",
              std::pair(1U, 4096U)}}};
}

Result<void> check_destination(const StreamArguments& args, const CommonArguments& common) {
    if (!args.to.empty() && args.out != "-") return bad_usage("--out and --to cannot be used together");
    if (common.json && args.to.empty() && args.out == "-" && !args.serve)
        return bad_usage("--json prints on standard output; send the spikes elsewhere by --out FILE or --to PORT");
    return {};
}

}  // namespace

Verb make_stream_verb() {
    const auto args = std::make_shared<StreamArguments>();
    return {.name = "stream",
            .description = "simulate live: frames of force in, spikes out",
            .examples = stream_examples,
            .common_options = {"--in", "--rate", "--population", "--channels", "--frames", "--scale", "--out", "--to", "--format",
                               "--serve", "--json"},
            .options = {population_options(*args), input_options(*args), frame_options(*args), recording_option_group(args->recording),
                        spike_options(*args), page_options(*args)},
            .reports = true,
            .writes_files = true,
            .run = [args](const CommonArguments& common) {
                catch_interrupt();
                if (const auto ok = check_destination(*args, common); !ok) return report_error(ok.error());
                if (const auto ok = check_page_options(*args, common); !ok) return report_error(ok.error());
                const auto done = args->in == "page" ? run_page_sessions(*args, common) : run_live(*args, common);
                if (!done && done.error().code == ErrorCode::interrupted)
                    return static_cast<int>(done.error().code);  // its summary has said so
                return exit_status(done);
            }};
}

}  // namespace corpuscle
