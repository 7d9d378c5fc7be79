#include "cli/stream/stream.hpp"

#include <fmt/format.h>

#include "cli/output/terminal.hpp"
#include "core/text/ascii_text.hpp"
#include "io/recording/column_selection.hpp"

namespace corpuscle {
namespace {

constexpr double stimulus_rate = 1e3;  // Hz, default sample rate of a stimulus

/// The port of "tcp:PORT" or "udp:PORT".
Result<int> port_of(const StreamArguments& args) {
    const auto scheme = args.in.substr(0, 4);
    const auto port = parse_bare_number<int>(args.in.substr(4));
    if (!port || *port < 0 || *port > 65535)
        return bad_usage(fmt::format("--in {}: write {}PORT, such as {}7000 (--listen sets the address)", args.in, scheme, scheme));
    return *port;
}

}  // namespace

bool is_live_input(const std::string& in) {
    return in == "-" || in.starts_with("tcp:") || in.starts_with("udp:") || in.starts_with("serial:");
}

std::string input_name(const std::string& in) { return in == "-" ? "standard input" : in; }

Result<Applied<std::unique_ptr<ForceSource>>> open_stream_source(const StreamArguments& args, const CommonArguments& common) {
    const auto force = read_force(args.in);
    TRY(check_recording_arguments(common, {&force, 1}));
    auto options = args.recording;
    options.should_continue = [](double) { return !interrupted(); };
    return force.open(options, args.settings, stimulus_rate, 0);
}

Result<void> check_live_options(const StreamArguments& args, const CommonArguments& common) {
    for (const auto& given : given_recording_options(common))
        for (const auto& o : live_options) {
            if (o.option != given) continue;
            if (o.effect == LiveEffect::refused)
                return bad_usage(
                    fmt::format("{} is for recordings (--in FILE), not for live frames from {}: {}", given, input_name(args.in), o.text));
            if ((given == "--notch" || given == "--lowpass" || given == "--zero" || given == "--deadband") &&
                !(args.save_state.empty() && args.resume.empty()))
                return bad_usage(fmt::format("{}: a saved state does not contain the filters; remove --save-state and --resume", given));
        }
    return {};
}

Result<Clock> live_clock(const StreamArguments& args) {
    if (args.recording.rate) return make_clock(*args.recording.rate);
    return bad_usage(fmt::format("--rate is required: the frame rate of {}", input_name(args.in)));
}

Result<FrameLayout> live_layout(const StreamArguments& args, std::size_t sites, const Clock& clock) {
    Column column;  // only for the name of the frame in error messages
    column.name = "a frame";
    TRY(check_unit_options(args.recording));
    const auto scale = TRY(newtons_per_unit(column, args.recording, input_name(args.in), send_only_forces));
    FrameLayout layout;
    layout.kind = args.frames == "csv"   ? FrameKind::csv
                  : args.frames == "f32" ? FrameKind::f32
                  : args.frames == "f64" ? FrameKind::f64
                                         : FrameKind::i16;
    layout.stamp = args.stamp == "none" ? FrameStamp::none : args.stamp == "sequence" ? FrameStamp::sequence : FrameStamp::time;
    layout.sites = sites, layout.rate = clock.rate();
    layout.absolute = args.recording.absolute, layout.range = args.recording.range;
    layout.scale = scale, layout.offset = args.recording.offset, layout.limit = args.max_force;
    return layout;
}

Result<std::unique_ptr<ByteSource>> open_live_input(const StreamArguments& args, const FrameLayout& layout) {
    if (args.in == "-") return open_standard_input();
    if (args.in.starts_with("serial:")) return open_serial(args.in.substr(std::string_view("serial:").size()), args.baud);
    const auto port = TRY(port_of(args));
    const SenderLimits limits{args.clients, static_cast<std::int64_t>(std::min(args.idle_timeout, 1e9) * 1e9)};
    if (args.in.starts_with("tcp:")) return listen_on(args.listen, port, limits);
    if (layout.kind != FrameKind::csv && layout.bytes() > max_datagram)
        return bad_usage(fmt::format("--in {}: a frame of {} bytes exceeds the maximum datagram of {} bytes; use tcp:{}{}", args.in,
                                     layout.bytes(), max_datagram, port, args.frames == "f64" ? ", or --frames f32" : ""));
    return receive_datagrams(args.listen, port, limits);
}

}  // namespace corpuscle
