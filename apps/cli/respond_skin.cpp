// corpuscle respond --population: simulates the afferents of a skin.

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/arguments/force_argument.hpp"
#include "cli/arguments/recording_arguments.hpp"
#include "cli/output/printable.hpp"
#include "cli/output/skin_outputs.hpp"
#include "cli/output/skin_spike_times.hpp"
#include "cli/output/terminal.hpp"
#include "core/stimulus/stimuli.hpp"
#include "core/text/ascii_text.hpp"
#include "core/version.hpp"
#include "io/table/foreign_format.hpp"
#include "run/skin/skin_checkpoint.hpp"
#include "run/skin/skin_ranks.hpp"
#include "run/summary/nerve_limit.hpp"
#include "run/summary/silent_afferents.hpp"
#include "run/summary/skin_silent_classes.hpp"
#include "skin/plan/class_overrides.hpp"
#include "skin/plan/indented_array.hpp"

namespace corpuscle {
namespace {

constexpr double skin_rate = 1e3;  // Hz, default sample rate of stimuli
constexpr const char* default_indenter = "flat";

/// Returns an error, with the reason and a remedy, for options that do not apply to a skin.
Result<void> check_skin_options(const RespondArguments& args) {
    struct Refusal {
        const char* option;
        bool given;
        const char* reason;
    };
    constexpr const char* in_file = "the population file defines the afferents of a skin ('corpuscle list skins', doc/skin.md)";
    constexpr const char* spread =
        "density, per_site and spread in the population file set the number of afferents of a skin and their variation "
        "(doc/skin.md)";
    constexpr const char* probes =
        "currents and membranes of a skin are not recorded; run one afferent without --population, or use afferents.csv "
        "and --bin 10ms";
    constexpr const char* netlists =
        "the afferents of a skin are models, not netlists; run a netlist with --afferent sa1-circuit, without "
        "--population";
    const RespondArguments defaults;
    const Refusal refusals[] = {
        {"--afferent", args.afferents != defaults.afferents, in_file},
        {"--copies", args.copies > 0, spread},
        {"--spread", !args.spreads.empty(), spread},
        {"--noise", args.noise.has_value(), "membranes of a skin have no noise; for a noisy force use press+noise as FORCE"},
        {"--float", args.use_float, "a skin is simulated in double precision only; remove --float"},
        {"--probe-files", args.probe_files, probes},
        {"--probe", !args.netlists.probes.empty(), netlists},
        {"--vectors", args.vectors,
         "afferents of a skin have no converter; run an afferent with one: --afferent sa1-kim, without --population"},
        {"--wav", args.wav, "the clicks of thousands of afferents are not audible separately; run one afferent without --population"},
        {"--corner", args.netlists.corner.has_value(), netlists},
        {"--supply", args.netlists.supply.has_value(), netlists},
        {"--temp", args.netlists.temp.has_value(), netlists},
        {"--mismatch", args.netlists.mismatch.has_value(), netlists}};
    for (const auto& r : refusals)
        if (r.given) return bad_usage(fmt::format("{} cannot be used with --population: {}", r.option, r.reason));
    if (args.forces.size() != 1) return bad_usage(fmt::format("--population takes one FORCE, not {}", args.forces.size()));
    return {};
}

/// The touch of this name, such as "stroke"; null if there is none.
const NamedTouch* find_touch(const std::string& force) {
    const auto all = named_touches();
    const auto at = std::find_if(all.begin(), all.end(), [&](const NamedTouch& t) { return t.name == force; });
    return at == all.end() ? nullptr : &*at;
}

/// A skin simulation, prepared from the arguments.
struct SkinJob {
    std::vector<ParameterOverride> overrides;
    std::unique_ptr<ForceSource> source;
    std::shared_ptr<const Innervation> skin;
    std::unique_ptr<Contact> contact;  ///< null: each channel is the force at one site
    std::unique_ptr<SkinForce> force;
    SkinRunNotes run_info;
    std::string name;       ///< of the touch, stimulus or recording
    std::string skin_note;  ///< note that a sensor array is treated as skin; "" if it is not
};

/// Adds the settings of a touch as overrides. Overrides of the user take precedence.
void add_touch_overrides(std::vector<ParameterOverride>& overrides, const NamedTouch& touch) {
    const auto add = [&](std::string_view target, const std::vector<Setting>& settings) {
        for (const auto& s : settings)
            if (std::none_of(overrides.begin(), overrides.end(),
                             [&](const ParameterOverride& entry) { return entry.target == target && entry.parameter == s.name; }))
                overrides.push_back({std::string(target), std::string(s.name), fmt::format("{}", s.value), true});
    };
    add("contact", touch.settings);
    add(touch.force, touch.force_settings);
}

/// Returns an error if an override was not applied.
Result<void> check_skin_overrides(const SkinJob& job) {
    std::vector<std::string_view> names = {"contact", job.source->name()};
    for (const auto& c : job.skin->plan.classes) names.push_back(c.name);
    for (const auto& entry : job.overrides)
        if (!entry.is_used)
            return bad_usage(
                fmt::format("--set {}: there is no '{}' in this run{}", entry.text(), entry.target, did_you_mean(entry.target, names)));
    return {};
}

/// Makes job.force: with an indenter if the force has one channel and the skin several sites, otherwise from one channel for each site.
Result<void> open_contact(SkinJob& job, const RespondArguments& args, const NamedTouch* touch) {
    const auto& sites = job.skin->plan.sites;
    const std::size_t channels = job.source->channels().size();
    if (channels > 1 || sites.size() == 1) {
        if (!args.contact.empty())
            return bad_usage(channels > 1 ? fmt::format("--contact {}: {} has {} channels; an indenter needs a force of one channel",
                                                        args.contact, job.source->name(), channels)
                                          : fmt::format("--contact {}: the skin has one site; an indenter needs several", args.contact));
        auto at = match_sites(job.skin->plan, *job.source);
        if (!at) return at.error();
        job.force = make_site_force(*job.source, std::move(*at), sites.size());
        return {};
    }
    const std::string indenter = !args.contact.empty() ? args.contact : touch ? std::string(touch->indenter) : default_indenter;
    auto contact = make_contact(indenter, job.overrides, sites, job.source->clock());
    if (!contact) return contact.error();
    job.contact = std::move(*contact);
    job.force = make_pressed_force(*job.source, *job.contact);
    return {};
}

/// Prepares the simulation: reads the options, opens the force and places the afferents.
Result<SkinJob> prepare_skin(const RespondArguments& args) {
    if (auto ok = check_skin_options(args); !ok) return ok.error();
    SkinJob job;
    for (const auto& text : args.settings) {
        auto parsed = parse_override(text);
        if (!parsed) return parsed.error();
        job.overrides.push_back(std::move(*parsed));
    }
    const auto* touch = find_touch(args.forces[0]);
    if (touch) add_touch_overrides(job.overrides, *touch);
    auto options = recording_options(args);
    if (!options) return options.error();
    auto source = open_force(touch ? std::string(touch->force) : args.forces[0], *options, job.overrides, skin_rate, args.seed);
    if (!source) return source.error();
    job.source = std::move(*source);
    job.name = touch ? std::string(touch->name) : job.source->name();
    auto plan = load_skin_plan(args.population, job.source->channels());
    if (!plan) return plan.error();
    if (auto ok = apply_class_overrides(*plan, job.overrides); !ok) return ok.error();
    if (args.seed != 0) plan->seed = args.seed;  // 0, the default, keeps the seed of the population file
    if (job.source->channels().size() == 1) job.skin_note = treat_as_skin(*plan);
    auto skin = innervate(std::move(*plan));
    if (!skin) return skin.error();
    job.skin = std::move(*skin);
    if (auto ok = open_contact(job, args, touch); !ok) return ok.error();
    if (auto ok = check_skin_overrides(job); !ok) return ok.error();
    if (!touch)
        if (auto ok = check_recording_arguments(args); !ok) return ok.error();
    job.run_info.method = args.method == "exact" ? Method::exact : Method::backward_euler;
    job.run_info.sampled = args.sampled;
    return job;
}

/// Collects metadata and notes of force and contact, and warnings about the force and the steps of the run. Call it after the run.
void add_force_notes(SkinJob& job) {
    auto& run_info = job.run_info;
    run_info.metadata = job.source->metadata();
    run_info.notes = job.source->notes();
    const auto quality = job.source->quality();
    run_info.notes.insert(run_info.notes.end(), quality.descriptions.begin(), quality.descriptions.end());
    run_info.warnings.insert(run_info.warnings.end(), quality.warnings.begin(), quality.warnings.end());
    if (!job.skin_note.empty()) run_info.notes.push_back(job.skin_note);
    if (job.contact) {
        run_info.contact = job.contact->description();
        for (auto& f : job.contact->metadata()) run_info.metadata.push_back(std::move(f));
        for (auto& r : job.contact->notes()) run_info.notes.push_back(std::move(r));
    }
    for (const auto& c : job.skin->plan.classes)
        if (job.source->clock().rate() < c.afferent.min_rate * (1 - 1e-9))
            run_info.warnings.push_back(fmt::format("{}: the sampling rate of the force is {:g} Hz; {:g} Hz or more is needed", c.name,
                                                    job.source->clock().rate(), c.afferent.min_rate));
    if (run_info.stats.truncated_steps > 0)
        run_info.warnings.push_back(
            fmt::format("{} time steps reached the spike limit of one step and were truncated; increase the sampling rate or the "
                        "threshold",
                        run_info.stats.truncated_steps));
}

/// A remedy for a force that is too weak: the setting or option that multiplies it by `factor`; "" if there is none.
std::string stronger_stimulus_advice(const SkinJob& job, const RespondArguments& args, double factor) {
    const auto& plan = job.skin->plan;
    if (job.contact && plan.sites.area > 0 && !(plan.felt_area > 0)) {
        const auto area = std::max(factor * plan.sites.area, default_felt_area);
        return fmt::format("set felt_area = \"{} cm2\" in {}: without it an afferent receives the mean force of its sites",
                           format_rounded_up(1e4 * area), args.population);
    }
    const auto metadata = job.source->metadata();
    if (!is_stimulus(job.source->name())) {
        // The metadata of a recording begins with the scale of its first channel.
        const bool has_gain = !metadata.empty() && metadata[0].name.ends_with("newtons per unit");
        return has_gain
                   ? fmt::format("try --scale {}{}", format_rounded_up(factor * metadata[0].value), args.unit ? " instead of --unit" : "")
                   : "";
    }
    // The parameter of the stimulus with the largest force is assumed to be its amplitude.
    const MetadataEntry* largest = nullptr;
    for (const auto& f : metadata)
        if (f.unit == "N" && (!largest || f.value > largest->value)) largest = &f;
    return largest ? fmt::format("try --set {}={}N", largest->name, format_rounded_up(factor * largest->value)) : "";
}

/// Reports the silent classes: as a warning if all classes are silent, else as a note.
void add_silence_notes(SkinJob& job, const RespondArguments& args, const std::vector<SilentClass>& silent) {
    constexpr double margin = 1.25;  // on the factor, because the afferents of a class vary and receive different forces
    std::vector<std::string> messages;
    std::optional<double> min_factor;  // of the class that needs the least additional force
    for (const auto& s : silent) {
        auto text = job.skin->plan.classes[s.class_index].name;
        if (!(s.max_force > 0))
            text += " received no force";
        else if (!s.factor)
            text += fmt::format(" received at most {:.2g} N, and would not fire even at a million times this force", s.max_force);
        else
            text += fmt::format(" received at most {:.2g} N, and needs about {} N of the same stimulus to fire ({} times as much)",
                                s.max_force, format_rounded_up(*s.factor * s.max_force), format_rounded_up(*s.factor));
        messages.push_back(std::move(text));
        if (s.factor) min_factor = std::min(*s.factor, min_factor.value_or(*s.factor));
    }
    if (silent.empty()) return;
    const bool any_force = std::any_of(silent.begin(), silent.end(), [](const SilentClass& s) { return s.max_force > 0; });
    const bool all = silent.size() == job.skin->plan.classes.size();
    auto text = fmt::format("{}: {}", all ? "no afferent fired" : "never fired", fmt::join(messages, "; "));
    if (all && min_factor)
        if (const auto remedy = stronger_stimulus_advice(job, args, margin * *min_factor); !remedy.empty()) text += "; " + remedy;
    if (all && !any_force && job.contact)
        text += fmt::format(
            "; --set contact.x=... and --set contact.y=... place the indenter (for positions see afferents.csv, or type: corpuscle list {} "
            "--sites)",
            quote_shell_word(args.population));
    (all ? job.run_info.warnings : job.run_info.notes).push_back(std::move(text));
}

/// Warns of classes in which afferents fire faster than a nerve fibre can.
void add_rate_warnings(SkinJob& job, const SkinSummary& summary) {
    for (std::size_t c = 0; c < job.skin->plan.classes.size(); ++c) {
        const auto& plan = job.skin->plan.classes[c].afferent;
        const auto [count, rate] = summary.count_faster_than(c, max_nerve_rate);
        if (count > 0)
            job.run_info.warnings.push_back(
                fmt::format("{} of {} {} afferents: {}", count, job.skin->class_begin[c + 1] - job.skin->class_begin[c],
                            job.skin->plan.classes[c].name, excessive_rate_warning(rate, plan, job.skin->plan.classes[c].name)));
    }
}

/// Options that change where or how results are written and how fast, but not the response.
constexpr std::string_view output_options[] = {"--checkpoint", "--out",       "--report", "--bin",  "--events",
                                               "--npz",        "--overwrite", "--quiet",  "--json", "--threads"};

/// Adds the checksum of a file's contents, if the file exists. `kind`: "recording", "population file" ...
Result<void> add_contents(RunFingerprint& all, const std::string& kind, const std::string& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) return {};
    auto contents = checksum_of_file(path);
    if (!contents) return contents.error();
    all.emplace_back(fmt::format("contents of the {}", kind), std::move(*contents));
    return {};
}

/// Checksum of the sites. It also covers the site lists that a population file includes.
std::string sites_checksum(const Sites& sites) {
    Checksum sum;
    for (const auto& p : sites.positions) sum.add(p.x), sum.add(p.y), sum.add(p.z);
    for (const auto& name : sites.names) sum.add(std::string_view(name));
    for (const auto r : sites.region) sum.add(std::uint64_t{r});
    for (const auto& name : sites.regions) sum.add(std::string_view(name));
    sum.add(sites.area);
    return fmt::format("{} sites, checksum {:016x}", sites.size(), sum.value());
}

/// All that determines the response: the program's version, the force, all options except output_options, and the contents of the files
/// that they name.
Result<RunFingerprint> fingerprint_of(const SkinJob& job, const RespondArguments& args, const CommonArguments& common) {
    RunFingerprint all = {{"the program", fmt::format("version {}", version)}, {"FORCE", args.forces[0]}};
    for (const auto& [name, values] : common.typed)
        if (name != "FORCE" && std::find(std::begin(output_options), std::end(output_options), name) == std::end(output_options))
            all.emplace_back(name, fmt::format("{}", fmt::join(values, " ")));
    if (!is_stimulus(args.forces[0]) && !find_touch(args.forces[0]))
        if (auto ok = add_contents(all, "recording", args.forces[0]); !ok) return ok.error();
    if (auto ok = add_contents(all, "population file", args.population); !ok) return ok.error();
    if (auto ok = add_contents(all, "layout file", args.layout); !ok) return ok.error();
    all.emplace_back("contents of the table of sites", sites_checksum(job.skin->plan.sites));
    return all;
}

/// This process among the MPI ranks.
struct SkinProcess {
    std::unique_ptr<Ranks> ranks;  ///< null: a single process
    bool is_coordinator() const { return !ranks || ranks->rank() == 0; }
    SkinPart part() const {
        return ranks ? SkinPart{static_cast<std::uint32_t>(ranks->rank()), static_cast<std::uint32_t>(ranks->size())} : SkinPart{};
    }
};

Result<std::unique_ptr<Skin>> make_skin(const SkinJob& job, const SkinProcess& self) {
    const auto set = instruction_set();
    if (!set) return set.error();
    return Skin::make(job.skin, {job.source->clock().T(), job.run_info.method, job.run_info.sampled, 0, 0}, *set, self.part());
}

/// Runs the skin in a single process or as rank 0, and writes all outputs.
Result<void> coordinate_skin(SkinJob& job, const RespondArguments& args, const CommonArguments& common, const SkinProcess& self) {
    auto skin = make_skin(job, self);
    if (!skin) return skin.error();
    SkinSummary summary;
    SkinSilenceDetector silence;
    SkinOutputs outputs;
    OutputCheck check(common.overwrite);
    if (auto ok = outputs.open(args, summary, check); !ok) return ok;
    ThreadPool pool(self.ranks ? std::max(1U, args.threads) : args.threads);
    std::unique_ptr<SkinCheckpoint> checkpoint;
    if (!args.checkpoint.empty()) {
        if (self.ranks) return bad_usage("--checkpoint works with one process only, not under mpirun");
        auto fingerprint = fingerprint_of(job, args, common);
        if (!fingerprint) return fingerprint.error();
        auto opened = SkinCheckpoint::open(args.checkpoint, **skin, std::move(*fingerprint));
        if (!opened) return opened.error();
        checkpoint = std::move(*opened);
        if (checkpoint->resumed_samples() > 0 && !common.quiet)
            print_message(fmt::format("resuming after {:.3f} s, from {}",
                                      job.source->clock().T() * static_cast<double>(checkpoint->resumed_samples()), args.checkpoint));
    }
    SkinSpikeTimes times;
    std::vector<SkinSink*> sinks = {&summary, &silence};
    if (common.json) sinks.push_back(&times);
    outputs.add_sinks(sinks);
    const auto simulator = self.ranks ? distributed_skin_simulator(*self.ranks, **skin, pool) : local_skin_simulator(**skin, pool);
    const SkinInput input{job.name, job.source->description(), job.source->clock(), job.source->phases(), *job.skin};
    const auto stats = [&] {
        Progress progress(common.quiet);
        return run_skin(*job.force, input, *simulator, sinks,
                        {[&](double fraction) { return progress.update(fraction), !interrupted(); }, checkpoint.get()});
    }();
    if (!stats && stats.error().code == ErrorCode::interrupted && checkpoint)
        return Error{ErrorCode::interrupted, fmt::format("interrupted; the same command resumes from {}", args.checkpoint)};
    if (!stats) return stats.error();
    job.run_info.stats = *stats;
    add_force_notes(job);
    add_silence_notes(job, args, silence.silent_classes(job.run_info.method, job.run_info.sampled));
    add_rate_warnings(job, summary);
    auto result = summary.document(job.run_info);
    result["files"] = outputs.file_names();
    const auto document = json_text(result) + "\n";
    if (auto ok = outputs.commit(summary, job.run_info, document, common.command); !ok) return ok;
    if (checkpoint) checkpoint->remove_files();
    for (const auto& r : common.quiet ? std::vector<std::string>{} : job.run_info.notes) print_message(fmt::format("{}: {}", job.name, r));
    for (const auto& warning : job.run_info.warnings) print_warning(warning);
    if (common.json) result["spikes"] = times.document();
    if (common.json && times.is_over_limit())
        print_warning(fmt::format("{}: more than {} million spikes, which are too many for --json; --out DIR writes them to spikes.csv",
                                  job.name, SkinSpikeTimes::max_spikes / 1'000'000));
    if (common.json)
        fmt::print("{}\n", json_text(result));
    else if (!common.quiet)
        print_text(format_table(summary.table()) + outputs.written_text());
    return {};
}

/// Runs the skin in this process, as the coordinator or as a worker.
Result<void> run_as(const RespondArguments& args, const CommonArguments& common, const SkinProcess& self) {
    auto job = prepare_skin(args);
    if (!self.is_coordinator()) {
        ThreadPool pool(std::max(1U, args.threads));
        if (!job) return run_skin_worker(*self.ranks, job.error(), nullptr, pool);
        auto skin = make_skin(*job, self);
        if (!skin) return run_skin_worker(*self.ranks, skin.error(), nullptr, pool);
        return run_skin_worker(*self.ranks, job->force.get(), skin->get(), pool);
    }
    auto done = job ? coordinate_skin(*job, args, common, self) : Result<void>(job.error());
    if (self.ranks) shut_down_skin_workers(*self.ranks);
    return done;
}

}  // namespace

int respond_skin(const RespondArguments& args, const CommonArguments& common) {
    catch_interrupt();
    SkinProcess self;
    if (Ranks::are_started()) {
        auto ranks = Ranks::join();
        if (!ranks) return Ranks::reports_errors() ? report_error(ranks.error()) : static_cast<int>(ranks.error().code);
        if ((*ranks)->size() > 1) self.ranks = std::move(*ranks);
    }
    const auto done = run_as(args, common, self);
    return done ? 0 : report_error(done.error());
}

}  // namespace corpuscle
