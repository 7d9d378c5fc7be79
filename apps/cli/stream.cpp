// corpuscle stream: frames of force as they come, spikes as they happen.

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/output_check.hpp"
#include "live/live_population.hpp"
#include "live/placed_frames.hpp"
#include "live/stream_state.hpp"
#include "own_files.hpp"
#include "printable.hpp"
#include "signal/input_files.hpp"
#include "skin/class_settings.hpp"
#include "skin/site_map.hpp"
#include "stream_input.hpp"
#include "stream_told.hpp"
#include "study/skin_run.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

Result<SkinPlan> plan_of(const StreamWords& w, std::span<const Channel> channels, std::span<const Wish> wishes) {
    if (channels.empty()) return plan_live(w.population, w.count, wishes);
    if (is_afferents(w.population)) return plan_channels(w.population, channels, wishes);
    auto plan = plan_skin(w.population, channels);
    if (!plan) return plan;
    if (auto ok = set_classes(*plan, wishes); !ok) return ok.error();
    return plan;
}

/// All that takes part in one stream.
class LiveRun {
    const StreamWords& words_;
    const Common& common_;
    std::unique_ptr<SkinStream> skin_;
    std::unique_ptr<FrameSource> frames_;
    const Source* source_ = nullptr;  // of recorded frames; they own it
    FrameLayout layout_;              // of others
    std::unique_ptr<EventFormat> format_;
    std::unique_ptr<EventOutlet> outlet_;
    std::unique_ptr<StreamLoop> loop_;
    bool drawn_ = false;

    StreamFacts facts() const { return {*skin_, *frames_, *outlet_, *format_, *loop_}; }

    /// The frames' source, and the skin for as many sites.
    Result<void> open_recorded(const StreamNumbers& n, std::span<const Wish> wishes) {
        auto source = open_stream_source(words_, n, wishes);
        if (!source) return source.error();
        const auto channels = (*source)->channels();
        const auto plan = plan_of(words_, channels, wishes);
        if (!plan) return plan.error();
        if (auto ok = open_skin(*plan, (*source)->clock()); !ok) return ok;
        auto sites = sites_of(*plan, **source);
        if (!sites) return sites.error();
        source_ = source->get();
        frames_ = placed_frames(frames_of(std::move(*source), words_.pace == "real"), std::move(*sites), skin_->sites());
        return {};
    }

    /// The names of a header are sites, or not one of them is and the numbers go by order. `sites`: of each number, by --layout; none: all.
    HeaderReader header_reader(std::vector<std::uint32_t> sites) const {
        return [this, sites = std::move(sites)](std::span<const std::string> names) -> Result<std::vector<std::uint32_t>> {
            const auto& all = skin_->innervation().plan.sites;
            auto named = sites_if_named(all, names);
            const auto from = name_of_input(words_.in);
            if (!named)
                return bad_input(
                    fmt::format("{}; a header without names of sites is passed over, and numbers go by order", named.error().sentence),
                    {from + ": header"});
            if (!*named || sites.empty()) return *named ? **std::move(named) : std::vector<std::uint32_t>();
            for (std::size_t k = 0; k < sites.size(); ++k)
                if ((**named)[k] != sites[k])
                    return bad_input(fmt::format("number {} is site '{}' by name, and '{}' by {}; leave out --layout or the header", k + 1,
                                                 all.names[(**named)[k]], all.names[sites[k]], words_.layout),
                                     {from + ": header"});
            return std::vector<std::uint32_t>();
        };
    }

    Result<void> open_wired(const StreamNumbers& n, std::span<const Wish> wishes) {
        const auto clock = wire_clock(words_, n);
        if (!clock) return clock.error();
        const auto plan = plan_of(words_, {}, wishes);
        if (!plan) return plan.error();
        if (auto ok = open_skin(*plan, *clock); !ok) return ok;
        std::vector<std::uint32_t> sites;  // of each number of a frame; none: all, in order
        if (!words_.layout.empty()) {
            auto map = read_site_map(words_.layout, plan->sites);
            if (!map) return map.error();
            sites = std::move(*map);
        }
        const auto layout = wire_layout(words_, n, sites.empty() ? skin_->sites() : sites.size(), *clock);
        if (!layout) return layout.error();
        auto bytes = open_wire(words_, n, *layout);
        if (!bytes) return bytes.error();
        const auto in_frames = [&](double seconds) { return static_cast<std::int64_t>(std::min(seconds * clock->rate(), 2e9)); };
        layout_ = *layout;
        frames_ = frames_of(std::move(*bytes), *layout, in_frames(n.hold), in_frames(n.longest), words_.together, header_reader(sites));
        if (!sites.empty()) frames_ = placed_frames(std::move(frames_), std::move(sites), skin_->sites());
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

    void clear_status() {
        if (std::exchange(drawn_, false)) fmt::print(stderr, "\r\033[K");
    }
    void print(const std::string& text) { clear_status(), tell(text); }
    void warn(const std::string& text) { clear_status(), tell_warning(fmt::format("{}: {}", name_of_input(words_.in), text)); }

    /// How a recording was read, and where the rate is too low.
    void print_remarks() {
        const auto remarks = source_ && !common_.quiet ? source_->remarks() : std::vector<std::string>{};
        for (const auto& r : remarks) print(fmt::format("{}: {}", source_->name(), r));
        const double rate = skin_->clock().rate();
        for (const auto& c : skin_->innervation().plan.classes)
            if (rate < c.afferent.least_rate * (1 - 1e-9))
                warn(fmt::format("frames come at {:g} Hz, but {} needs {:g} Hz or more; do not trust its spikes", rate, c.name,
                                 c.afferent.least_rate));
    }

    /// How well what was read was recorded.
    void print_quality() {
        if (!source_) return;
        const auto quality = source_->quality();
        for (const auto& s : common_.quiet ? std::vector<std::string>{} : quality.sentences)
            print(fmt::format("{}: {}", source_->name(), s));
        for (const auto& s : quality.warnings) clear_status(), tell_warning(fmt::format("{}: {}", source_->name(), s));
    }

    std::string misfit_text(const FrameMisfit& misfit) const {
        const auto text = text_of(misfit, layout_, words_.layout.empty() ? words_.population : words_.layout);
        const auto stamps = layout_.stamp == FrameStamp::none ? 0U : 1U;
        if (misfit.why == FrameMisfit::header) return "header: " + text;
        if (misfit.why != FrameMisfit::width || !words_.layout.empty() || misfit.found <= stamps) return text;
        const auto& plan = skin_->innervation().plan;
        if (plan.is_by_channel) return fmt::format("{}; --channels {} takes frames of this width", text, misfit.found - stamps);
        if (misfit.found - stamps > plan.sites.size()) return text;
        return fmt::format("{}; --layout FILE says which sites the numbers of a frame are", text);
    }

    /// A stream that has answered no frame has done nothing.
    Result<void> check_frames() const {
        const auto counts = frames_->counts();
        const auto from = name_of_input(words_.in);
        if (counts.frames > 0) return {};
        if (const auto misfit = frames_->first_misfit())
            return bad_input(fmt::format("no frame could be read from {}: {}", from, misfit_text(*misfit)));
        if (counts.halves > 0 && layout_.kind != FrameKind::csv)
            return bad_input(fmt::format("no whole frame came from {}: {} bytes, and a frame of '{}' ({} sites) has {}", from,
                                         counts.half_bytes, words_.population, layout_.sites, layout_.bytes()));
        return bad_input(counts.halves > 0 ? fmt::format("no whole frame came from {}: a line without its end", from)
                                           : fmt::format("no frame came from {}", from));
    }

    Result<void> check_drops() const {
        const auto spikes = loop_->done().dropped + outlet_->lost(), datagrams = frames_->counts().senders.lost;
        if (words_.allow_drops || spikes + datagrams == 0) return {};
        std::string what;
        if (spikes > 0) what = fmt::format("{} of {} spikes did not reach their reader", spikes, loop_->done().spikes);
        if (datagrams > 0) what += fmt::format("{}{} datagrams were lost", what.empty() ? "" : ", and ", datagrams);
        return bad_input(fmt::format("{}; --allow-drops makes this no error{}", what,
                                     loop_->done().dropped > 0 ? ", a larger --buffer keeps more" : ""));
    }

    /// To a terminal that takes it now; one that is stopped (Ctrl-S) must not stop us.
    void show() {
        pollfd terminal = {STDERR_FILENO, POLLOUT, 0};
        if (::poll(&terminal, 1, 0) != 1) return;
        fmt::print(stderr, "\r\033[K{}", stream_status(facts()));
        std::fflush(stderr);
        drawn_ = true;
    }

    void print_summary() {
        clear_status();
        if (common_.json) fmt::print("{}\n", json_text(stream_document(facts())));
        if (!common_.quiet && !common_.json) fmt::print(stderr, "corpuscle: {}", printable_lines(stream_summary(facts())));
    }

    Result<void> open(const StreamNumbers& n, std::span<const Wish> wishes) {
        if (auto ok = is_wire(words_.in) ? open_wired(n, wishes) : open_recorded(n, wishes); !ok) return ok;
        std::vector<std::string_view> others;
        if (source_) others.push_back(source_->name());
        if (auto ok = check_all_used(skin_->innervation().plan, wishes, others); !ok)
            return bad_usage(fmt::format("--set {}", ok.error().sentence));
        if (auto ok = check_outputs(); !ok) return ok;
        return open_outlet(n);
    }

    /// The state that is taken up may be replaced by the one that is kept, and by nothing else.
    Result<void> check_outputs() const {
        OutputCheck outputs(common_.overwrite);
        remember_input("-");
        if (!words_.save.empty())
            if (auto ok = outputs.file(words_.save, is_own_state); !ok) return ok;
        if (!words_.resume.empty()) remember_input(words_.resume);
        return words_.out == "-" ? Result<void>() : outputs.growing_file(words_.out, is_own_events);
    }

    const Error stopped{Code::interrupted, "interrupted"};

public:
    LiveRun(const StreamWords& words, const Common& common) : words_(words), common_(common) {}

    Result<void> run() {
        std::vector<Wish> wishes;
        for (const auto& text : words_.settings) {
            auto wish = parse_wish(text);
            if (!wish) return wish.error();
            wishes.push_back(std::move(*wish));
        }
        const auto n = stream_numbers(words_);
        if (!n) return n.error();
        if (auto ok = open(*n, wishes); !ok) return interrupted() ? stopped : ok;
        print_remarks();
        StreamLoop::Ways ways{.stop = interrupted, .spin = words_.spin, .goes_on = !words_.save.empty()};
        ways.misfit = [this](const FrameMisfit& misfit) { warn(misfit_text(misfit)); };
        if (!common_.quiet && !common_.json && ::isatty(STDERR_FILENO) && !::isatty(STDOUT_FILENO)) ways.seen = [this] { show(); };
        loop_ = std::make_unique<StreamLoop>(*skin_, *format_, *frames_, *outlet_, std::move(ways));
        if (auto ok = take_up(); !ok) return ok;
        if (is_wire(words_.in) && words_.in != "-") print(frames_->sentence());
        auto ended = loop_->run();
        print_quality();
        print_summary();
        if (auto ok = put_by(); ended && !ok) return ok;
        if (ended && interrupted()) return stopped;
        if (ended) ended = check_frames();
        return ended ? check_drops() : ended;
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
