// corpuscle stream: simulates afferents live. Frames of force in, spikes out.

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/output_check.hpp"
#include "live/live_population.hpp"
#include "live/site_frames.hpp"
#include "live/stream_state.hpp"
#include "own_files.hpp"
#include "printable.hpp"
#include "signal/input_files.hpp"
#include "skin/class_overrides.hpp"
#include "skin/site_map.hpp"
#include "stream_input.hpp"
#include "stream_report.hpp"
#include "study/skin_run.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace corpuscle {
namespace {

Result<SkinPlan> plan_of(const StreamArguments& w, std::span<const Channel> channels, std::span<const ParameterOverride> overrides) {
    if (channels.empty()) return make_live_plan(w.population, w.channel_count, overrides);
    if (is_afferent_list(w.population)) return make_channel_plan(w.population, channels, overrides);
    auto plan = load_skin_plan(w.population, channels);
    if (!plan) return plan;
    if (auto ok = apply_class_overrides(*plan, overrides); !ok) return ok.error();
    return plan;
}

/// The components of one stream.
class LiveRun {
    const StreamArguments& words_;
    const CommonArguments& common_;
    std::unique_ptr<SkinStream> skin_;
    std::unique_ptr<FrameSource> frames_;
    const ForceSource* source_ = nullptr;  // of recorded frames, which own it; else null
    FrameLayout layout_;                   // of live frames
    std::unique_ptr<EventFormat> format_;
    std::unique_ptr<EventSink> outlet_;
    std::unique_ptr<StreamLoop> loop_;
    bool status_shown_ = false;

    StreamReportInput facts() const { return {*skin_, *frames_, *outlet_, *format_, *loop_}; }

    /// Opens a recording or a stimulus, and the skin that it drives.
    Result<void> open_recorded(const StreamQuantities& n, std::span<const ParameterOverride> overrides) {
        auto source = open_stream_source(words_, n, overrides);
        if (!source) return source.error();
        const auto channels = (*source)->channels();
        const auto plan = plan_of(words_, channels, overrides);
        if (!plan) return plan.error();
        if (auto ok = open_skin(*plan, (*source)->clock()); !ok) return ok;
        auto sites = match_sites(*plan, **source);
        if (!sites) return sites.error();
        source_ = source->get();
        frames_ = assign_sites(make_frame_source(std::move(*source), words_.pace == "real"), std::move(*sites), skin_->sites());
        return {};
    }

    /// Maps the columns of a CSV header to sites. Either all names are sites, or none is and the columns are in site order.
    /// `sites` is the site of each column by --layout. If it is empty, the columns are all sites in order.
    HeaderReader header_reader(std::vector<std::uint32_t> sites) const {
        return [this, sites = std::move(sites)](std::span<const std::string> names) -> Result<std::vector<std::uint32_t>> {
            const auto& all = skin_->innervation().plan.sites;
            auto named = find_sites_if_named(all, names);
            const auto from = input_name(words_.in);
            if (!named)
                return bad_input(
                    fmt::format("{}; use site names in all columns, or in none (columns are then in site order)", named.error().message),
                    {from + ": header"});
            if (!*named || sites.empty()) return *named ? **std::move(named) : std::vector<std::uint32_t>();
            for (std::size_t k = 0; k < sites.size(); ++k)
                if ((**named)[k] != sites[k])
                    return bad_input(fmt::format("column {} is site '{}' in the header, but '{}' in {}; remove --layout or the header",
                                                 k + 1, all.names[(**named)[k]], all.names[sites[k]], words_.layout),
                                     {from + ": header"});
            return std::vector<std::uint32_t>();
        };
    }

    /// Opens a live input, and the skin that it drives.
    Result<void> open_live(const StreamQuantities& n, std::span<const ParameterOverride> overrides) {
        const auto clock = live_clock(words_, n);
        if (!clock) return clock.error();
        const auto plan = plan_of(words_, {}, overrides);
        if (!plan) return plan.error();
        if (auto ok = open_skin(*plan, *clock); !ok) return ok;
        std::vector<std::uint32_t> sites;  // the site of each number of a frame; empty: all sites in order
        if (!words_.layout.empty()) {
            auto map = read_site_map(words_.layout, plan->sites);
            if (!map) return map.error();
            sites = std::move(*map);
        }
        const auto layout = live_layout(words_, n, sites.empty() ? skin_->sites() : sites.size(), *clock);
        if (!layout) return layout.error();
        auto bytes = open_live_input(words_, n, *layout);
        if (!bytes) return bytes.error();
        const auto in_frames = [&](double seconds) { return static_cast<std::int64_t>(std::min(seconds * clock->rate(), 2e9)); };
        layout_ = *layout;
        frames_ = make_frame_source(std::move(*bytes), *layout, in_frames(n.hold), in_frames(n.max_gap), words_.batch_frames,
                                    header_reader(sites));
        if (!sites.empty()) frames_ = assign_sites(std::move(frames_), std::move(sites), skin_->sites());
        return {};
    }

    Result<void> open_skin(const SkinPlan& plan, Clock clock) {
        clock.t0 = 0;  // time 0 is the first frame
        auto placed = innervate(plan);
        if (!placed) return placed.error();
        auto skin = SkinStream::make(*placed, clock, words_.sampled, words_.batch_frames);
        if (!skin) return skin.error();
        skin_ = std::move(*skin);
        return {};
    }

    Result<void> open_outlet(const StreamQuantities& n) {
        auto format = make_event_format(words_.format, make_event_addressing(skin_->innervation(), skin_->clock()));
        if (!format) return format.error();
        format_ = std::move(*format);
        const auto ring = static_cast<std::size_t>(n.buffer);
        auto outlet = !words_.to.empty()  ? connect_event_client(words_.to, *format_, ring)
                      : words_.out == "-" ? open_standard_output(*format_, ring)
                                          : create_event_file(words_.out, *format_, ring);
        if (!outlet) return outlet.error();
        outlet_ = std::move(*outlet);
        return {};
    }

    Result<void> load_state() {
        if (words_.resume.empty()) return {};
        const auto state = load_stream(words_.resume);
        if (!state) return state.error();
        if (state->force.size() != skin_->sites())
            return bad_input(fmt::format("the saved state has {} sites, but the population has {}", state->force.size(), skin_->sites()),
                             {words_.resume});
        if (auto ok = skin_->resume(state->skin); !ok) return Error{ok.error().code, ok.error().message, {words_.resume}};
        std::copy(state->force.begin(), state->force.end(), loop_->force().begin());
        if (auto* order = frames_->sequence(); order && state->number) order->resume_after(*state->number);
        return {};
    }

    Result<void> save_state() {
        if (words_.save_state.empty()) return {};
        StreamState state{{loop_->force().begin(), loop_->force().end()}, {}, skin_->save()};
        if (const auto* order = frames_->sequence(); order && order->has_begun()) state.number = order->last();
        return save_stream(words_.save_state, state);
    }

    void clear_status() {
        if (std::exchange(status_shown_, false)) fmt::print(stderr, "\r\033[K");
    }
    void print(const std::string& text) { clear_status(), print_message(text); }
    void warn(const std::string& text) { clear_status(), print_warning(fmt::format("{}: {}", input_name(words_.in), text)); }

    /// Prints how a recording was read, and warns if the frame rate is too low.
    void print_notes() {
        const auto notes = source_ && !common_.quiet ? source_->notes() : std::vector<std::string>{};
        for (const auto& r : notes) print(fmt::format("{}: {}", source_->name(), r));
        const double rate = skin_->clock().rate();
        for (const auto& c : skin_->innervation().plan.classes)
            if (rate < c.afferent.min_rate * (1 - 1e-9))
                warn(fmt::format("the frame rate is {:g} Hz, but {} needs {:g} Hz or more; its spikes are not reliable", rate, c.name,
                                 c.afferent.min_rate));
    }

    /// Prints the quality findings of a recording.
    void print_quality() {
        if (!source_) return;
        const auto quality = source_->quality();
        for (const auto& s : common_.quiet ? std::vector<std::string>{} : quality.descriptions)
            print(fmt::format("{}: {}", source_->name(), s));
        for (const auto& s : quality.warnings) clear_status(), print_warning(fmt::format("{}: {}", source_->name(), s));
    }

    std::string misfit_text(const FrameError& misfit) const {
        const auto text = describe_frame_error(misfit, layout_, words_.layout.empty() ? words_.population : words_.layout);
        const auto stamps = layout_.stamp == FrameStamp::none ? 0U : 1U;
        if (misfit.reason == FrameError::header) return "header: " + text;
        if (misfit.reason != FrameError::width || !words_.layout.empty() || misfit.found <= stamps) return text;
        const auto& plan = skin_->innervation().plan;
        if (plan.is_by_channel) return fmt::format("{}; use --channels {} for frames of this width", text, misfit.found - stamps);
        if (misfit.found - stamps > plan.sites.size()) return text;
        return fmt::format("{}; use --layout FILE to map the numbers of a frame to sites", text);
    }

    /// A stream without a single frame is an error.
    Result<void> check_frames() const {
        const auto counts = frames_->counts();
        const auto from = input_name(words_.in);
        if (counts.frames > 0) return {};
        if (const auto misfit = frames_->first_error())
            return bad_input(fmt::format("no valid frame from {}: {}", from, misfit_text(*misfit)));
        if (counts.partial_frames > 0 && layout_.kind != FrameKind::csv)
            return bad_input(fmt::format("no complete frame from {}: received {} bytes, but a frame of '{}' ({} sites) has {}", from,
                                         counts.partial_bytes, words_.population, layout_.sites, layout_.bytes()));
        return bad_input(counts.partial_frames > 0 ? fmt::format("no complete frame from {}: the line does not end with a line break", from)
                                                   : fmt::format("no frame from {}", from));
    }

    Result<void> check_drops() const {
        const auto spikes = loop_->stats().dropped + outlet_->dropped(), datagrams = frames_->counts().senders.dropped;
        if (words_.allow_drops || spikes + datagrams == 0) return {};
        std::string message;
        if (spikes > 0) message = fmt::format("{} of {} spikes did not reach the receiver", spikes, loop_->stats().spikes);
        if (datagrams > 0) message += fmt::format("{}{} datagrams were lost", message.empty() ? "" : ", and ", datagrams);
        return bad_input(
            fmt::format("{}; use --allow-drops to accept this{}", message, loop_->stats().dropped > 0 ? ", or a larger --buffer" : ""));
    }

    /// Prints the status line, unless the terminal is blocked (Ctrl-S): it must not block the stream.
    void show_status() {
        pollfd terminal = {STDERR_FILENO, POLLOUT, 0};
        if (::poll(&terminal, 1, 0) != 1) return;
        fmt::print(stderr, "\r\033[K{}", stream_status(facts()));
        std::fflush(stderr);
        status_shown_ = true;
    }

    void print_summary() {
        clear_status();
        if (common_.json) fmt::print("{}\n", json_text(stream_document(facts())));
        if (!common_.quiet && !common_.json) fmt::print(stderr, "corpuscle: {}", printable_lines(stream_summary(facts())));
    }

    Result<void> open(const StreamQuantities& n, std::span<const ParameterOverride> overrides) {
        if (auto ok = is_live_input(words_.in) ? open_live(n, overrides) : open_recorded(n, overrides); !ok) return ok;
        std::vector<std::string_view> others;
        if (source_) others.push_back(source_->name());
        if (auto ok = check_overrides_used(skin_->innervation().plan, overrides, others); !ok)
            return bad_usage(fmt::format("--set {}", ok.error().message));
        if (auto ok = check_outputs(); !ok) return ok;
        return open_outlet(n);
    }

    /// The file of --resume may be replaced by --save-state, but by no other output.
    Result<void> check_outputs() const {
        OutputCheck outputs(common_.overwrite);
        remember_input("-");
        if (!words_.save_state.empty())
            if (auto ok = outputs.check_file(words_.save_state, is_own_state); !ok) return ok;
        if (!words_.resume.empty()) remember_input(words_.resume);
        return words_.out == "-" ? Result<void>() : outputs.check_growing_file(words_.out, is_own_events);
    }

    const Error stopped{ErrorCode::interrupted, "interrupted"};

public:
    LiveRun(const StreamArguments& words, const CommonArguments& common) : words_(words), common_(common) {}

    Result<void> run() {
        std::vector<ParameterOverride> overrides;
        for (const auto& text : words_.settings) {
            auto parsed = parse_override(text);
            if (!parsed) return parsed.error();
            overrides.push_back(std::move(*parsed));
        }
        const auto n = stream_quantities(words_);
        if (!n) return n.error();
        if (auto ok = open(*n, overrides); !ok) return interrupted() ? stopped : ok;
        print_notes();
        StreamLoop::StreamOptions ways{.stop = interrupted, .busy_poll = words_.busy_poll, .keeps_state = !words_.save_state.empty()};
        ways.on_frame_error = [this](const FrameError& misfit) { warn(misfit_text(misfit)); };
        if (!common_.quiet && !common_.json && ::isatty(STDERR_FILENO) && !::isatty(STDOUT_FILENO))
            ways.on_second = [this] { show_status(); };
        loop_ = std::make_unique<StreamLoop>(*skin_, *format_, *frames_, *outlet_, std::move(ways));
        if (auto ok = load_state(); !ok) return ok;
        if (is_live_input(words_.in) && words_.in != "-") print(frames_->description());
        auto ended = loop_->run();
        print_quality();
        print_summary();
        if (auto ok = save_state(); ended && !ok) return ok;
        if (ended && interrupted()) return stopped;
        if (ended) ended = check_frames();
        return ended ? check_drops() : ended;
    }
};

}  // namespace

int stream(const StreamArguments& words, const CommonArguments& common) {
    catch_interrupt();
    if (!words.to.empty() && words.out != "-") return report_error(bad_usage("--out and --to cannot be used together"));
    if (common.json && words.to.empty() && words.out == "-")
        return report_error(bad_usage("--json prints on standard output; send the spikes elsewhere by --out FILE or --to PORT"));
    LiveRun run(words, common);
    const auto done = run.run();
    if (done) return 0;
    // The summary has reported the interruption.
    if (done.error().code == ErrorCode::interrupted) return static_cast<int>(ErrorCode::interrupted);
    return report_error(done.error());
}

}  // namespace corpuscle
