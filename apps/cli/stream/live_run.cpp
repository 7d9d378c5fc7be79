#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "circuit/variant/netlist_overrides.hpp"
#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "cli/stream/page/stream_page.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/input_files.hpp"
#include "io/output/output_check.hpp"
#include "io/recording/force_rows.hpp"
#include "live/live_population.hpp"
#include "live/stream_state.hpp"
#include "run/channels/channel_warnings.hpp"
#include "run/channels/sensor_noise.hpp"
#include "run/skin/skin_force.hpp"
#include "skin/plan/sites.hpp"
#include "skin/plan/skin_plan.hpp"

namespace corpuscle {
namespace {

/// The plan of the skin of --population. `channels`: of the recording or stimulus; empty for a live input.
Result<Applied<SkinPlan>> plan_of(const StreamArguments& args, std::span<const Channel> channels) {
    if (channels.empty()) return make_live_plan(args.population, args.channel_count, args.settings);
    if (is_afferent_list(args.population)) return make_channel_plan(args.population, channels, args.settings);
    auto plan = TRY(load_skin_plan(args.population, channels));
    return apply_overrides(std::move(plan), args.settings);
}

/// Returns an error if --population or --set names a netlist or a NIR graph.
Result<void> check_only_models(const StreamArguments& args) {
    const auto check = [&](std::string_view name, const std::string& option) -> Result<void> {
        if (!circuit::find_embedded_netlist(name) && !name.ends_with(".cir") && !name.ends_with(".nir")) return {};
        return bad_usage(fmt::format("{}: a stream simulates models, not netlists and NIR graphs; type: corpuscle respond {} --afferent {}",
                                     option, is_live_input(args.in) ? "FORCE" : args.in, name));
    };
    for (const auto name : split(args.population, ',')) TRY(check(name, "--population " + args.population));
    for (const auto& o : args.settings) TRY(check(o.target, "--set " + o.text()));
    return {};
}

/// One stream: its input, skin and output.
class LiveRun {
    const StreamArguments& args_;
    const CommonArguments& common_;
    std::unique_ptr<SkinStream> skin_;
    std::unique_ptr<FrameSource> frames_;
    const ForceSource* source_ = nullptr;    // the recording or stimulus, owned by frames_; null for a live input
    std::vector<ParameterOverride> unused_;  // overrides that neither the skin nor the source has used
    FrameLayout layout_;                     // of live frames only
    std::unique_ptr<EventFormat> format_;
    std::unique_ptr<EventSink> sink_;
    std::unique_ptr<StreamPage> page_;  // null: without --serve
    std::unique_ptr<StreamLoop> loop_;
    std::optional<TaxelLayout> taxels_;      // of --taxels
    std::vector<std::string> skin_notes_;    // about the skin and the taxels
    std::vector<std::string> header_notes_;  // about the last header of live frames
    bool is_status_shown_ = false;           // true while the last line of the terminal is the status line

    StreamReportInput report_input() const { return {*skin_, *frames_, *sink_, *format_, *loop_, page_.get()}; }

    /// Opens a recording or a stimulus, and the skin that it drives.
    Result<void> open_recorded() {
        auto opened = TRY(open_stream_source(args_, common_));
        auto& source = opened.result;
        keep_unused(unused_, opened.unused);
        TRY(open_skin(source->channels(), source->clock()));
        source_ = source.get();
        if (taxels_) {
            std::vector<std::string> names;
            for (const auto& c : source->channels()) names.push_back(c.name);
            return open_taxel_recording(std::move(source), TRY(match_taxels(*taxels_, names, source_->name())));
        }
        auto sites = TRY(match_sites(skin_->innervation().plan, *source));
        frames_ = make_frame_source(std::move(source), args_.pace == "real");
        frames_->assign_sites(std::move(sites), skin_->sites());
        return {};
    }

    /// `taxels`: of each channel of the recording.
    Result<void> open_taxel_recording(std::unique_ptr<ForceSource> source, const std::vector<std::uint32_t>& taxels) {
        const bool has_shear = source->has_shear();
        std::vector<std::uint32_t> columns;
        for (const auto taxel : taxels) {
            if (has_shear) columns.push_back(3 * taxel), columns.push_back(3 * taxel + 1);
            columns.push_back(has_shear ? 3 * taxel + 2 : taxel);
        }
        if (!has_shear) TRY(check_shear(*taxels_, *source));
        frames_ = make_frame_source(std::move(source), args_.pace == "real", has_shear);
        return assign_taxels(std::move(columns), has_shear, {});
    }

    /// Spreads the forces of the taxels over the sites of the skin. `columns`: for each force of a frame, its index in a frame of
    /// TaxelFrames.
    Result<void> assign_taxels(std::vector<std::uint32_t> columns, bool has_shear, const ChannelFilters& filters) {
        auto map = TRY(map_taxels(*taxels_, skin_->innervation().plan.sites));
        skin_notes_.insert(skin_notes_.end(), map.notes.begin(), map.notes.end());
        TaxelFrames frames(*taxels_, std::move(map), has_shear);
        frames.set_texture(TRY(make_texture()));
        frames_->assign_taxels(std::move(frames), std::move(columns), skin_->sites(), filters);
        return {};
    }

    /// The texture that slides over the taxels; null: none.
    Result<std::unique_ptr<TaxelTexture>> make_texture() {
        const auto& plan = skin_->innervation().plan;
        auto texture = TRY(make_taxel_texture(args_.settings, plan.sites, skin_->clock().rate(), plan.seed));
        keep_unused(unused_, texture.unused);
        if (!texture.result) return std::move(texture.result);
        if (!args_.save_state.empty() || !args_.resume.empty())
            return bad_usage("--set contact: a saved state does not contain the position of the texture; remove --save-state and --resume");
        for (auto& note : texture.result->notes()) skin_notes_.push_back(std::move(note));
        return std::move(texture.result);
    }

    /// Reads the layout of --taxels.
    Result<void> read_taxels() {
        if (args_.taxels.empty()) return {};
        if (is_afferent_list(args_.population))
            return bad_usage("--taxels needs a skin; add --population hand, fingertip, \"grid 8x8\" or a population file");
        if (!args_.recording.layout.empty()) return bad_usage("--layout and --taxels both say where the channels are; use --taxels only");
        taxels_ = TRY(read_taxel_layout(args_.taxels));
        return {};
    }

    /// Prints how the header of a sender was read, unless the same was printed for the sender before.
    void print_header_notes(const std::vector<std::string>& notes) {
        if (header_notes_ == notes) return;
        clear_status();
        corpuscle::print_notes(input_name(args_.in), notes, common_.quiet);
        header_notes_ = notes;
    }

    /// Opens a live input, and the skin that it drives.
    Result<void> open_live() {
        TRY(check_live_options(args_, common_));
        const auto clock = TRY(live_clock(args_));
        TRY(open_skin({}, clock));
        std::vector<std::uint32_t> sites;  // the site of each force of a frame; empty: all sites in order
        if (taxels_) sites.resize(taxels_->taxels.size() * (taxels_->has_axes ? 3 : 1)), std::iota(sites.begin(), sites.end(), 0U);
        if (const auto& path = args_.recording.layout; !path.empty()) sites = TRY(read_site_map(path, skin_->innervation().plan.sites));
        layout_ = TRY(live_layout(args_, sites.empty() ? skin_->sites() : sites.size(), clock));
        if (taxels_) layout_.site_noun = taxels_->has_axes ? "axis" : "taxel";
        auto bytes = TRY(open_live_input(args_, layout_));
        const auto in_frames = [&](double seconds) { return static_cast<std::int64_t>(std::min(seconds * clock.rate(), 2e9)); };
        frames_ = make_frame_source(std::move(bytes), layout_, in_frames(args_.hold), in_frames(args_.max_gap), args_.batch_frames,
                                    make_header_reader(args_, skin_->innervation().plan.sites, taxels_ ? &*taxels_ : nullptr, sites,
                                                       [this](const auto& notes) { print_header_notes(notes); }));
        const auto filters = TRY(make_channel_filters(args_.recording, clock));
        if (taxels_) return assign_taxels(std::move(sites), taxels_->has_axes, filters);
        if (sites.empty()) sites.resize(layout_.sites), std::iota(sites.begin(), sites.end(), 0U);
        frames_->assign_sites(std::move(sites), skin_->sites(), filters);
        return {};
    }

    /// `channels`: as for plan_of(). `clock`: of the frames.
    Result<void> open_skin(std::span<const Channel> channels, Clock clock) {
        clock.t0 = 0;  // time 0 is the first frame
        auto plan = TRY(plan_of(args_, channels));
        keep_unused(unused_, plan.unused);
        if (taxels_)
            if (auto note = treat_as_skin(plan.result); !note.empty()) skin_notes_.push_back(std::move(note));
        auto innervation = TRY(innervate(plan.result));
        skin_ = TRY(SkinStream::make(innervation, clock, args_.sampled, args_.batch_frames));
        return {};
    }

    Result<void> open_sink() {
        const auto addressing = make_event_addressing(skin_->innervation(), skin_->clock());
        format_ = TRY(make_event_format(args_.format, addressing));
        const auto buffer_size = static_cast<std::size_t>(args_.buffer);
        const auto was_given = [](const TypedOption& option) { return option.name == "--out"; };
        if (args_.serve && args_.to.empty() && std::none_of(common_.typed.begin(), common_.typed.end(), was_given)) {
            sink_ = make_null_sink(*format_, buffer_size);
            return {};
        }
        sink_ = TRY(!args_.to.empty()  ? connect_event_client(args_.to, *format_, buffer_size)
                    : args_.out == "-" ? open_standard_output(*format_, buffer_size)
                                       : create_event_file(args_.out, *format_, buffer_size));
        return {};
    }

    /// Loads the state of --resume: the skin, the last force of each site, and the number of the last frame if frames are numbered.
    Result<void> load_state() {
        if (args_.resume.empty()) return {};
        const auto state = TRY(load_stream(args_.resume));
        const auto last = last_frame();
        if (state.force.size() != last.size())
            return bad_input(
                fmt::format(
                    "the saved state has a frame of {} forces, but a frame of this stream has {}; use the same population and --taxels",
                    state.force.size(), last.size()),
                {args_.resume});
        if (auto ok = skin_->resume(state.skin); !ok) return Error{ok.error().code, ok.error().message, {args_.resume}};
        std::copy(state.force.begin(), state.force.end(), last.begin());
        if (auto* sequence = frames_->sequence(); sequence && state.number) sequence->resume_after(*state.number);
        return {};
    }

    /// The last frame: of the taxels, or of all sites.
    std::span<double> last_frame() { return taxels_ ? frames_->taxel_frame() : loop_->force(); }

    Result<void> save_state() {
        if (args_.save_state.empty()) return {};
        const auto last = last_frame();
        StreamState state{{last.begin(), last.end()}, {}, skin_->save()};
        if (const auto* sequence = frames_->sequence(); sequence && sequence->has_begun()) state.number = sequence->last();
        return save_stream(args_.save_state, state);
    }

    void clear_status() {
        if (std::exchange(is_status_shown_, false)) fmt::print(stderr, "\r\033[K");
    }
    void warn(const std::string& text) { clear_status(), print_warning(fmt::format("{}: {}", input_name(args_.in), text)); }

    /// Prints how a recording was read, and warns if the frame rate is too low.
    void print_notes() {
        if (source_) corpuscle::print_notes(source_->name(), source_->notes(), common_.quiet);
        corpuscle::print_notes(input_name(args_.in), skin_notes_, common_.quiet);
        const double rate = skin_->clock().rate();
        for (const auto& c : skin_->innervation().plan.classes)
            if (const auto text = rate_warning(c.afferent, c.name, rate); !text.empty()) warn(text);
    }

    /// The warning about the noise of the sensor of a recording, if it is enough for spikes.
    std::string noise_warning() const {
        std::vector<NoiseSubject> subjects;
        for (const auto& c : skin_->innervation().plan.classes) subjects.push_back({c.name, &c.afferent});
        return sensor_noise_warning(*source_, subjects, {.dt = skin_->clock().T(), .spikes_on_samples = args_.sampled});
    }

    /// Prints the findings about the quality of a recording.
    void print_quality() {
        if (!source_) return;
        const auto quality = source_->quality();
        clear_status();
        corpuscle::print_notes(source_->name(), quality.descriptions, common_.quiet);
        for (const auto& s : quality.warnings) print_warning(fmt::format("{}: {}", source_->name(), s));
        if (const auto text = noise_warning(); !text.empty()) print_warning(fmt::format("{}: {}", source_->name(), text));
    }

    /// Describes the error of a frame. If the width of a frame is wrong, adds the option that would make it right.
    std::string frame_error_text(const FrameError& frame_error) const {
        const auto text = describe_frame_error(frame_error, layout_,
                                               taxels_                          ? args_.taxels
                                               : args_.recording.layout.empty() ? args_.population
                                                                                : args_.recording.layout);
        const auto stamps = layout_.stamp == FrameStamp::none ? 0U : 1U;  // number of fields before the forces
        if (frame_error.reason == FrameError::header) return "header: " + text;
        if (frame_error.reason != FrameError::width || taxels_ || !args_.recording.layout.empty() || frame_error.found <= stamps)
            return text;
        const auto& plan = skin_->innervation().plan;
        if (frame_error.has_decimal_commas && layout_.sites > 1) return text;
        if (plan.is_by_channel) return fmt::format("{}; use --channels {} for frames of this width", text, frame_error.found - stamps);
        if (frame_error.found - stamps > plan.sites.size()) return text;
        return fmt::format("{}; use --layout FILE to map the numbers of a frame to sites, or --taxels FILE to spread the forces of taxels",
                           text);
    }

    /// Returns an error if no frame was received.
    Result<void> check_frames() const {
        const auto counts = frames_->counts();
        const auto from = input_name(args_.in);
        if (counts.frames > 0) return {};
        if (const auto frame_error = frames_->first_error())
            return bad_input(fmt::format("no valid frame from {}: {}", from, frame_error_text(*frame_error)));
        if (counts.partial_frames > 0 && layout_.kind != FrameKind::csv)
            return bad_input(fmt::format("no complete frame from {}: received {} bytes, but a frame of '{}' ({} sites) has {}", from,
                                         counts.partial_bytes, args_.population, layout_.sites, layout_.bytes()));
        return bad_input(counts.partial_frames > 0 ? fmt::format("no complete frame from {}: the line does not end with a line break", from)
                                                   : fmt::format("no frame from {}", from));
    }

    /// Returns an error if spikes or datagrams were lost, unless --allow-drops was given.
    Result<void> check_drops() const {
        const auto spikes = loop_->stats().dropped + sink_->dropped(), datagrams = frames_->counts().senders.dropped;
        if (args_.allow_drops || spikes + datagrams == 0) return {};
        std::string message;
        if (spikes > 0) message = fmt::format("{} of {} spikes did not reach the receiver", spikes, loop_->stats().spikes);
        if (datagrams > 0) message += fmt::format("{}{} datagrams were lost", message.empty() ? "" : ", and ", datagrams);
        return bad_input(
            fmt::format("{}; use --allow-drops to accept this{}", message, loop_->stats().dropped > 0 ? ", or a larger --buffer" : ""));
    }

    /// Prints the status line, unless the terminal is blocked (Ctrl-S), because printing would then block the stream.
    void show_status() {
        pollfd terminal = {STDERR_FILENO, POLLOUT, 0};
        if (::poll(&terminal, 1, 0) != 1) return;
        fmt::print(stderr, "\r\033[K{}", stream_status(report_input()));
        std::fflush(stderr);
        is_status_shown_ = true;
    }

    void print_summary() {
        clear_status();
        if (common_.json) fmt::print("{}\n", json_text(stream_document(report_input())));
        if (!common_.quiet && !common_.json) fmt::print(stderr, "corpuscle: {}", printable_lines(stream_summary(report_input())));
    }

    /// Opens input, skin and output.
    Result<void> open() {
        TRY(read_taxels());
        TRY(is_live_input(args_.in) ? open_live() : open_recorded());
        std::vector<std::string_view> others;
        if (source_) others.push_back(source_->name());
        TRY(check_all_used(unused_, override_targets(skin_->innervation().plan, others)));
        TRY(check_outputs());
        TRY(open_sink());
        if (args_.serve) page_ = TRY(StreamPage::start(args_, *skin_));
        return {};
    }

    /// Checks that the output files may be written. The file of --resume may be replaced by --save-state, but by no other output.
    Result<void> check_outputs() const {
        OutputCheck outputs(common_.overwrite);
        remember_input("-");  // standard input may be a file, which must not be replaced
        if (!args_.save_state.empty()) TRY(outputs.check_file(args_.save_state, is_own_state));
        if (!args_.resume.empty()) remember_input(args_.resume);
        return args_.out == "-" ? Result<void>() : outputs.check_growing_file(args_.out, is_own_events);
    }

    const Error stopped = interrupted_error();

public:
    LiveRun(const StreamArguments& args, const CommonArguments& common) : args_(args), common_(common), unused_(args.settings) {}

    Result<void> run() {
        TRY(check_only_models(args_));
        if (auto ok = open(); !ok) return interrupted() ? stopped : ok;
        print_notes();
        StreamLoop::StreamOptions options{.stop = interrupted, .busy_poll = args_.busy_poll, .keeps_state = !args_.save_state.empty()};
        options.on_frame_error = [this](const FrameError& frame_error) { warn(frame_error_text(frame_error)); };
        if (!common_.quiet && !common_.json && ::isatty(STDERR_FILENO) && !::isatty(STDOUT_FILENO))
            options.on_second = [this] { show_status(); };
        if (page_) options.observer = page_->observer();
        loop_ = std::make_unique<StreamLoop>(*skin_, *format_, *frames_, *sink_, std::move(options));
        TRY(load_state());
        if (is_live_input(args_.in) && args_.in != "-") print_message(frames_->description());
        if (page_ && !is_live_input(args_.in)) page_->wait_for_viewer(common_.quiet);
        auto ended = loop_->run();
        if (page_) page_->finish(skin_->frames(), loop_->stats().spikes);
        print_quality();
        print_summary();
        if (auto ok = save_state(); ended && !ok) return ok;
        if (ended && interrupted()) return stopped;
        if (ended) ended = check_frames();
        return ended ? check_drops() : ended;
    }
};

}  // namespace

Result<void> run_live(const StreamArguments& args, const CommonArguments& common) { return LiveRun(args, common).run(); }

}  // namespace corpuscle
