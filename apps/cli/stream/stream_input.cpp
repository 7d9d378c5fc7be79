#include "cli/stream/stream_input.hpp"

#include <fmt/format.h>
#include <charconv>

#include "cli/arguments/force_argument.hpp"
#include "cli/arguments/recording_arguments.hpp"
#include "cli/output/terminal.hpp"
#include "cli/stream/live_options.hpp"
#include "core/text/quantity.hpp"
#include "io/recording/column_selection.hpp"
#include "live/input/filtered_frames.hpp"

namespace corpuscle {
namespace {

constexpr double stimulus_rate = 1e3;  // Hz, default sample rate of a stimulus

/// Parses an option that has a default.
Result<double> required_quantity(const std::string& text, std::string_view unit, std::string_view option) {
    const auto value = optional_quantity(text, unit, option);
    if (!value) return value.error();
    return **value;
}

/// The port of "tcp:PORT" or "udp:PORT".
Result<int> port_of(const StreamArguments& args) {
    const auto scheme = args.in.substr(0, 4);
    int port = 0;
    const auto* const end = args.in.data() + args.in.size();
    const auto [stop, status] = std::from_chars(args.in.data() + scheme.size(), end, port);
    if (status != std::errc{} || stop != end || port < 0 || port > 65535)
        return bad_usage(fmt::format("--in {}: write {}PORT, such as {}7000 (--listen sets the address)", args.in, scheme, scheme));
    return port;
}

}  // namespace

bool is_live_input(const std::string& in) {
    return in == "-" || in.starts_with("tcp:") || in.starts_with("udp:") || in.starts_with("serial:");
}

std::string input_name(const std::string& in) { return in == "-" ? "standard input" : in; }

Result<StreamQuantities> stream_quantities(const StreamArguments& args) {
    StreamQuantities quantities;
    auto options = recording_options(args);
    if (!options) return options.error();
    quantities.recording = std::move(*options);
    for (const auto& [text, unit, option, to] : {std::tuple{&args.max_force, "N", "--max-force", &quantities.max_force},
                                                 {&args.hold, "s", "--hold", &quantities.hold},
                                                 {&args.max_gap, "s", "--max-gap", &quantities.max_gap},
                                                 {&args.idle_timeout, "s", "--idle-timeout", &quantities.idle_timeout},
                                                 {&args.buffer, "", "--buffer", &quantities.buffer}}) {
        const auto value = required_quantity(*text, unit, option);
        if (!value) return value.error();
        if (!(*value >= 0)) return bad_usage(fmt::format("{} {}: must not be negative", option, *text));
        *to = *value;
    }
    if (!(quantities.buffer >= 1000 && quantities.buffer <= 1e10))
        return bad_usage(fmt::format("--buffer {}: must be between 1k and 10G bytes", args.buffer));
    return quantities;
}

Result<Applied<std::unique_ptr<ForceSource>>> open_stream_source(const StreamArguments& args, const StreamQuantities& quantities,
                                                                 std::span<const ParameterOverride> overrides) {
    if (auto ok = check_recording_arguments(args, {&args.in, 1}); !ok) return ok.error();
    auto options = quantities.recording;
    options.should_continue = [](double) { return !interrupted(); };
    return open_force(args.in, options, overrides, stimulus_rate, 0);
}

Result<void> check_live_options(const StreamArguments& args) {
    for (const auto given : given_recording_options(args))
        for (const auto& o : live_options) {
            if (o.option != given) continue;
            if (o.effect == LiveEffect::refused)
                return bad_usage(
                    fmt::format("{} is for recordings (--in FILE), not for live frames from {}: {}", given, input_name(args.in), o.text));
            if ((given == "--notch" || given == "--lowpass") && !(args.save_state.empty() && args.resume.empty()))
                return bad_usage(fmt::format("{}: a saved state does not contain the filters; remove --save-state and --resume", given));
        }
    return {};
}

Result<Clock> live_clock(const StreamArguments& args, const StreamQuantities& quantities) {
    if (quantities.recording.rate) return make_clock(*quantities.recording.rate);
    return bad_usage(fmt::format("--rate is required: the frame rate of {}", input_name(args.in)));
}

Result<FrameLayout> live_layout(const StreamArguments& args, const StreamQuantities& quantities, std::size_t sites, const Clock& clock) {
    Column column;  // only for the name of the frame in error messages
    column.name = "a frame";
    const auto scale = newtons_per_unit(column, quantities.recording, input_name(args.in));
    if (!scale) return scale.error();
    FrameLayout layout;
    layout.kind = args.frames == "csv"   ? FrameKind::csv
                  : args.frames == "f32" ? FrameKind::f32
                  : args.frames == "f64" ? FrameKind::f64
                                         : FrameKind::i16;
    layout.stamp = args.stamp == "none" ? FrameStamp::none : args.stamp == "sequence" ? FrameStamp::sequence : FrameStamp::time;
    layout.sites = sites, layout.rate = clock.rate();
    layout.absolute = args.absolute, layout.range = quantities.recording.range;
    layout.scale = *scale, layout.offset = quantities.recording.offset, layout.limit = quantities.max_force;
    return layout;
}

Result<std::unique_ptr<FrameSource>> filter_live_frames(std::unique_ptr<FrameSource> frames, const StreamQuantities& quantities,
                                                        std::size_t sites, const Clock& clock) {
    std::vector<Biquad> filters;
    const auto add = [&](const Result<Biquad>& filter) { return filter ? (filters.push_back(*filter), Result<void>()) : filter.error(); };
    for (const double f : quantities.recording.notch)
        if (auto ok = add(Biquad::notch(f, clock)); !ok) return ok.error();
    if (quantities.recording.lowpass)
        if (auto ok = add(Biquad::lowpass(*quantities.recording.lowpass, clock)); !ok) return ok.error();
    return filter_frames(std::move(frames), sites, filters);
}

Result<std::unique_ptr<ByteSource>> open_live_input(const StreamArguments& args, const StreamQuantities& quantities,
                                                    const FrameLayout& layout) {
    if (args.in == "-") return open_standard_input();
    if (args.in.starts_with("serial:")) return open_serial(args.in.substr(std::string_view("serial:").size()), args.baud);
    const auto port = port_of(args);
    if (!port) return port.error();
    const SenderLimits limits{args.clients, static_cast<std::int64_t>(std::min(quantities.idle_timeout, 1e9) * 1e9)};
    if (args.in.starts_with("tcp:")) return listen_on(args.listen, *port, limits);
    if (layout.kind != FrameKind::csv && layout.bytes() > max_datagram)
        return bad_usage(fmt::format("--in {}: a frame of {} bytes exceeds the maximum datagram of {} bytes; use tcp:{}{}", args.in,
                                     layout.bytes(), max_datagram, *port, args.frames == "f64" ? ", or --frames f32" : ""));
    return receive_datagrams(args.listen, *port, limits);
}

}  // namespace corpuscle
