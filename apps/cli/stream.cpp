// corpuscle stream: frames of force as they come, spikes as they happen.

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/recording.hpp"
#include "live/live_population.hpp"
#include "live/stream_state.hpp"
#include "model/population.hpp"
#include "recording_words.hpp"
#include "signal/quantity.hpp"
#include "signal/stimuli.hpp"
#include "stream_told.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

/// A quantity that is always said.
Result<double> said(const std::string& text, std::string_view unit, std::string_view option) {
    const auto value = quantity(text, unit, option);
    if (!value) return value.error();
    return **value;
}

bool is_wire(const std::string& in) { return in == "-" || in.starts_with("tcp:") || in.starts_with("serial:"); }

/// What a word of the command line says, in SI.
struct StreamNumbers {
    std::optional<double> rate, scale, offset;
    double limit = 0, hold = 0, longest = 0, buffer = 0;
};

Result<StreamNumbers> numbers_of(const StreamWords& w) {
    StreamNumbers n;
    for (const auto& [text, unit, option, to] :
         {std::tuple{&w.rate, "Hz", "--rate", &n.rate}, {&w.scale, "N", "--scale", &n.scale}, {&w.offset, "", "--offset", &n.offset}}) {
        const auto value = quantity(*text, unit, option);
        if (!value) return value.error();
        *to = *value;
    }
    for (const auto& [text, unit, option, to] : {std::tuple{&w.limit, "N", "--limit", &n.limit},
                                                 {&w.hold, "s", "--hold", &n.hold},
                                                 {&w.longest, "s", "--longest-gap", &n.longest},
                                                 {&w.buffer, "", "--buffer", &n.buffer}}) {
        const auto value = said(*text, unit, option);
        if (!value) return value.error();
        if (!(*value >= 0)) return bad_usage(fmt::format("{} {}: it is to be positive", option, *text));
        *to = *value;
    }
    if (!(n.buffer >= 1024 && n.buffer <= 1e10)) return bad_usage(fmt::format("--buffer {}: between 1k and 10G bytes", w.buffer));
    return n;
}

Result<std::unique_ptr<Source>> source_of(const StreamWords& w, const StreamNumbers& n, std::span<const Wish> wishes) {
    if (is_stimulus(w.in)) return make_stimulus(w.in, wishes, n.rate.value_or(1e3), 0);
    RecordingOptions options;
    options.channels = w.channels, options.rate = n.rate, options.unit = w.unit, options.scale = n.scale;
    options.offset = n.offset.value_or(0), options.layout = w.layout, options.table.transpose = w.transpose;
    return open_recording(w.in, options);
}

Result<Clock> clock_for(const StreamWords& w, const StreamNumbers& n) {
    if (n.rate) return clock_of(*n.rate);
    return bad_usage(fmt::format("--rate is to be said: how many frames a second come from {}", w.in == "-" ? "standard input" : w.in));
}

FrameLayout layout_of(const StreamWords& w, const StreamNumbers& n, std::size_t sites, const Clock& clock) {
    FrameLayout layout;
    layout.kind = w.frames == "csv"   ? FrameKind::csv
                  : w.frames == "f32" ? FrameKind::f32
                  : w.frames == "f64" ? FrameKind::f64
                                      : FrameKind::i16;
    layout.stamp = w.stamp == "none" ? FrameStamp::none : w.stamp == "count" ? FrameStamp::count : FrameStamp::time;
    layout.sites = sites, layout.rate = clock.rate();
    layout.scale = n.scale.value_or(1), layout.offset = n.offset.value_or(0), layout.limit = n.limit;
    return layout;
}

Result<std::unique_ptr<ByteSource>> bytes_of(const StreamWords& w) {
    if (w.in == "-") return standard_input();
    if (w.in.starts_with("serial:")) return open_serial(w.in.substr(7), w.baud);
    int port = 0;
    const auto [end, status] = std::from_chars(w.in.data() + 4, w.in.data() + w.in.size(), port);
    if (status != std::errc{} || end != w.in.data() + w.in.size() || port < 0 || port > 65535)
        return bad_usage(fmt::format("--in {}: write tcp:PORT, such as tcp:7000; --listen says on which address", w.in));
    return listen_on(w.listen, port, w.clients);
}

Result<SkinPlan> plan_of(const StreamWords& w, std::size_t channels, std::span<const Channel> places, std::span<const Wish> wishes) {
    return is_afferents(w.population) ? plan_channels(w.population, channels, wishes) : plan_skin(w.population, places);
}

/// All that takes part in one stream.
class LiveRun {
    const StreamWords& words_;
    const Common& common_;
    std::unique_ptr<SkinStream> skin_;
    std::unique_ptr<FrameSource> frames_;
    std::unique_ptr<EventFormat> format_;
    std::unique_ptr<EventOutlet> outlet_;
    std::unique_ptr<StreamLoop> loop_;
    bool drawn_ = false;

    StreamFacts facts() const { return {*skin_, *frames_, *outlet_, *format_, *loop_}; }

    /// The frames' source, and the skin for as many sites.
    Result<void> open_recorded(const StreamNumbers& n, std::span<const Wish> wishes) {
        auto source = source_of(words_, n, wishes);
        if (!source) return source.error();
        const auto channels = (*source)->channels();
        const auto plan = plan_of(words_, channels.size(), channels, wishes);
        if (!plan) return plan.error();
        if (auto ok = open_skin(*plan, (*source)->clock()); !ok) return ok;
        if (skin_->sites() != channels.size())
            return bad_input(fmt::format("{} has {} channels, {} has {} sites", words_.in, channels.size(), plan->name, skin_->sites()));
        frames_ = frames_of(std::move(*source), words_.pace == "real");
        return {};
    }

    Result<void> open_wire(const StreamNumbers& n, std::span<const Wish> wishes) {
        const auto clock = clock_for(words_, n);
        if (!clock) return clock.error();
        const auto plan = plan_of(words_, words_.count, {}, wishes);
        if (!plan) return plan.error();
        if (auto ok = open_skin(*plan, *clock); !ok) return ok;
        auto bytes = bytes_of(words_);
        if (!bytes) return bytes.error();
        const auto in_frames = [&](double seconds) { return static_cast<std::int64_t>(std::min(seconds * clock->rate(), 2e9)); };
        frames_ = frames_of(std::move(*bytes), layout_of(words_, n, skin_->sites(), *clock), in_frames(n.hold), in_frames(n.longest),
                            words_.together);
        return {};
    }

    Result<void> open_skin(const SkinPlan& plan, Clock clock) {
        clock.t0 = 0;  // a stream begins at its first frame
        auto placed = innervate(plan);
        if (!placed) return placed.error();
        auto skin = SkinStream::make(*placed, clock, words_.sampled, words_.together);
        if (!skin) return skin.error();
        skin_ = std::move(*skin);
        return {};
    }

    Result<void> open_outlet(const StreamNumbers& n) {
        auto format = event_format(words_.format, event_units(skin_->innervation(), skin_->clock()));
        if (!format) return format.error();
        format_ = std::move(*format);
        const auto ring = static_cast<std::size_t>(n.buffer);
        auto outlet = !words_.to.empty()  ? event_client(words_.to, *format_, ring)
                      : words_.out == "-" ? standard_output(*format_, ring)
                                          : event_file(words_.out, *format_, ring);
        if (!outlet) return outlet.error();
        outlet_ = std::move(*outlet);
        return {};
    }

    Result<void> take_up() {
        if (words_.resume.empty()) return {};
        const auto state = load_stream(words_.resume);
        if (!state) return state.error();
        if (state->force.size() != skin_->sites())
            return bad_input(fmt::format("a state of {} sites, for {} here", state->force.size(), skin_->sites()), {words_.resume});
        if (auto ok = skin_->resume(state->skin); !ok) return Error{ok.error().code, ok.error().sentence, {words_.resume}};
        std::copy(state->force.begin(), state->force.end(), loop_->force().begin());
        if (auto* order = frames_->order(); order && state->number) order->go_on_from(*state->number);
        return {};
    }

    Result<void> put_by() {
        if (words_.save.empty()) return {};
        StreamState state{{loop_->force().begin(), loop_->force().end()}, {}, skin_->save()};
        if (const auto* order = frames_->order(); order && order->begun()) state.number = order->last();
        return save_stream(words_.save, state);
    }

    /// To a terminal that takes it now; one that is stopped (Ctrl-S) must not stop us.
    void show() {
        pollfd terminal = {STDERR_FILENO, POLLOUT, 0};
        if (::poll(&terminal, 1, 0) != 1) return;
        fmt::print(stderr, "\r\033[K{}", stream_status(facts()));
        std::fflush(stderr);
        drawn_ = true;
    }

    void tell() {
        if (drawn_) fmt::print(stderr, "\r\033[K");
        if (common_.json) fmt::print("{}\n", stream_document(facts()).dump(1));
        if (!common_.quiet && !common_.json) fmt::print(stderr, "corpuscle: {}", stream_summary(facts()));
    }

    Result<void> open(const StreamNumbers& n, std::span<const Wish> wishes) {
        if (auto ok = is_wire(words_.in) ? open_wire(n, wishes) : open_recorded(n, wishes); !ok) return ok;
        for (const auto& w : wishes)
            if (!w.used) return bad_usage(fmt::format("--set {}: nothing here is called '{}'", w.text(), w.of));
        return open_outlet(n);
    }

public:
    LiveRun(const StreamWords& words, const Common& common) : words_(words), common_(common) {}

    Result<void> run() {
        std::vector<Wish> wishes;
        for (const auto& text : words_.settings) {
            auto wish = parse_wish(text);
            if (!wish) return wish.error();
            wishes.push_back(std::move(*wish));
        }
        const auto n = numbers_of(words_);
        if (!n) return n.error();
        if (auto ok = open(*n, wishes); !ok) return ok;
        StreamLoop::Ways ways{.stop = interrupted, .spin = words_.spin, .goes_on = !words_.save.empty()};
        if (!common_.quiet && !common_.json && ::isatty(STDERR_FILENO) && !::isatty(STDOUT_FILENO)) ways.seen = [this] { show(); };
        loop_ = std::make_unique<StreamLoop>(*skin_, *format_, *frames_, *outlet_, std::move(ways));
        if (auto ok = take_up(); !ok) return ok;
        if (words_.in.starts_with("tcp:") || words_.in.starts_with("serial:")) fmt::print(stderr, "corpuscle: {}\n", frames_->sentence());
        auto ended = loop_->run();
        tell();
        if (auto ok = put_by(); ended && !ok) return ok;
        if (ended && interrupted()) return Error{Code::interrupted, "interrupted"};
        return ended;
    }
};

}  // namespace

int stream(const StreamWords& words, const Common& common) {
    catch_interrupt();
    if (!words.to.empty() && words.out != "-") return fail(bad_usage("--out and --to: spikes go to one of them"));
    if (common.json && words.to.empty() && words.out == "-")
        return fail(bad_usage("--json prints on standard output: send spikes elsewhere, with --out FILE or --to PORT"));
    LiveRun run(words, common);
    const auto done = run.run();
    if (done) return 0;
    // Its summary says so already.
    if (done.error().code == Code::interrupted) return static_cast<int>(Code::interrupted);
    return fail(done.error());
}

}  // namespace corpuscle
