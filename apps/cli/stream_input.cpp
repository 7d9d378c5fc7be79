#include "stream_input.hpp"

#include <fmt/format.h>
#include <charconv>

#include "force_argument.hpp"
#include "io/column_selection.hpp"
#include "recording_arguments.hpp"
#include "signal/quantity.hpp"
#include "signal/stimuli.hpp"
#include "terminal.hpp"

namespace corpuscle {
namespace {

constexpr double stimulus_rate = 1e3;  // Hz

/// Parses an option that has a default.
Result<double> required_quantity(const std::string& text, std::string_view unit, std::string_view option) {
    const auto value = optional_quantity(text, unit, option);
    if (!value) return value.error();
    return **value;
}

/// Rejects options of recordings that live frames do not have, with the reason.
Result<void> check_live_options(const StreamArguments& w) {
    RecordingArguments others = w;
    others.unit.reset(), others.scale.reset(), others.offset.reset(), others.layout.clear();
    const auto option = first_recording_option(others);
    if (option.empty()) return {};
    const auto reason = option == "--channel" ? "every number of a frame belongs to a site, in the order of the sites or of --layout"
                        : option == "--time" || option == "--time-unit"
                            ? "the time of a frame is its number divided by --rate; use --stamp time if frames begin with their time"
                        : option == "--dataset" || option == "--skip" ? "live frames are not read from a file"
                        : option == "--range" || option == "--bad-fields"
                            ? "an invalid force, or one beyond --max-force, is replaced by the last force of the site"
                            : "it needs later readings, and live frames are processed at once";
    return bad_usage(fmt::format("{} is for recordings (--in FILE), not for live frames from {}: {}", option, input_name(w.in), reason));
}

Result<int> port_of(const StreamArguments& w) {
    const auto scheme = w.in.substr(0, 4);
    int port = 0;
    const auto* const end = w.in.data() + w.in.size();
    const auto [stop, status] = std::from_chars(w.in.data() + scheme.size(), end, port);
    if (status != std::errc{} || stop != end || port < 0 || port > 65535)
        return bad_usage(fmt::format("--in {}: write {}PORT, such as {}7000 (--listen sets the address)", w.in, scheme, scheme));
    return port;
}

}  // namespace

bool is_live_input(const std::string& in) {
    return in == "-" || in.starts_with("tcp:") || in.starts_with("udp:") || in.starts_with("serial:");
}

std::string input_name(const std::string& in) { return in == "-" ? "standard input" : in; }

Result<StreamQuantities> stream_quantities(const StreamArguments& w) {
    StreamQuantities n;
    auto options = recording_options(w);
    if (!options) return options.error();
    n.recording = std::move(*options);
    for (const auto& [text, unit, option, to] : {std::tuple{&w.max_force, "N", "--max-force", &n.max_force},
                                                 {&w.hold, "s", "--hold", &n.hold},
                                                 {&w.max_gap, "s", "--max-gap", &n.max_gap},
                                                 {&w.idle_timeout, "s", "--idle-timeout", &n.idle_timeout},
                                                 {&w.buffer, "", "--buffer", &n.buffer}}) {
        const auto value = required_quantity(*text, unit, option);
        if (!value) return value.error();
        if (!(*value >= 0)) return bad_usage(fmt::format("{} {}: must not be negative", option, *text));
        *to = *value;
    }
    if (!(n.buffer >= 1000 && n.buffer <= 1e10)) return bad_usage(fmt::format("--buffer {}: must be between 1k and 10G bytes", w.buffer));
    return n;
}

Result<std::unique_ptr<ForceSource>> open_stream_source(const StreamArguments& w, const StreamQuantities& n,
                                                        std::span<const ParameterOverride> overrides) {
    if (const auto option = first_recording_option(w); !option.empty() && is_stimulus(w.in))
        return bad_usage(
            fmt::format("{} is for recordings, but {} is a stimulus; change it by --set {}.PARAMETER=VALUE", option, w.in, w.in));
    auto options = n.recording;
    options.should_continue = [](double) { return !interrupted(); };
    return open_force(w.in, options, overrides, stimulus_rate, 0);
}

Result<Clock> live_clock(const StreamArguments& w, const StreamQuantities& n) {
    if (n.recording.rate) return make_clock(*n.recording.rate);
    return bad_usage(fmt::format("--rate is required: the frame rate of {}", input_name(w.in)));
}

Result<FrameLayout> live_layout(const StreamArguments& w, const StreamQuantities& n, std::size_t sites, const Clock& clock) {
    if (auto ok = check_live_options(w); !ok) return ok.error();
    Column number;
    number.name = "a frame";
    const auto scale = newtons_per_unit(number, n.recording, input_name(w.in));
    if (!scale) return scale.error();
    FrameLayout layout;
    layout.kind = w.frames == "csv"   ? FrameKind::csv
                  : w.frames == "f32" ? FrameKind::f32
                  : w.frames == "f64" ? FrameKind::f64
                                      : FrameKind::i16;
    layout.stamp = w.stamp == "none" ? FrameStamp::none : w.stamp == "sequence" ? FrameStamp::sequence : FrameStamp::time;
    layout.sites = sites, layout.rate = clock.rate();
    layout.scale = *scale, layout.offset = n.recording.offset, layout.limit = n.max_force;
    return layout;
}

Result<std::unique_ptr<ByteSource>> open_live_input(const StreamArguments& w, const StreamQuantities& n, const FrameLayout& layout) {
    if (w.in == "-") return open_standard_input();
    if (w.in.starts_with("serial:")) return open_serial(w.in.substr(7), w.baud);
    const auto port = port_of(w);
    if (!port) return port.error();
    const SenderLimits limits{w.clients, static_cast<std::int64_t>(std::min(n.idle_timeout, 1e9) * 1e9)};
    if (w.in.starts_with("tcp:")) return listen_on(w.listen, *port, limits);
    if (layout.kind != FrameKind::csv && layout.bytes() > max_datagram)
        return bad_usage(fmt::format("--in {}: a frame of {} bytes exceeds the maximum datagram of {} bytes; use tcp:{}{}", w.in,
                                     layout.bytes(), max_datagram, *port, w.frames == "f64" ? ", or --frames f32" : ""));
    return receive_datagrams(w.listen, *port, limits);
}

}  // namespace corpuscle
