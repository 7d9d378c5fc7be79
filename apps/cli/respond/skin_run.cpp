#include "cli/respond/skin_run.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/output/terminal.hpp"
#include "core/text/ascii_text.hpp"
#include "core/version.hpp"
#include "skin/plan/skin_plan.hpp"
#include "skin/taxel/taxel_map.hpp"

namespace corpuscle {
namespace {

constexpr double skin_rate = 1e3;  // Hz, default sample rate of stimuli
constexpr std::string_view default_indenter = "flat";

/// Adds the settings of a touch as overrides. Overrides of the user take precedence.
void add_touch_overrides(std::vector<ParameterOverride>& overrides, const NamedTouch& touch) {
    const auto add = [&](std::string_view target, const std::vector<Setting>& settings) {
        for (const auto& s : settings)
            if (std::none_of(overrides.begin(), overrides.end(),
                             [&](const ParameterOverride& entry) { return entry.target == target && entry.parameter == s.name; }))
                overrides.push_back({std::string(target), std::string(s.name), fmt::format("{}", s.value)});
    };
    add("contact", touch.settings);
    add(touch.force, touch.force_settings);
}

/// True for an option that changes where or how results are written and how fast, but not the response.
bool is_output_option(std::string_view name) {
    constexpr std::string_view options[] = {"--checkpoint", "--out", "--report", "--overwrite", "--quiet", "--json", "--threads"};
    const auto is_of = [&](const OutputFormat* format) { return format->option == name; };
    return std::find(std::begin(options), std::end(options), name) != std::end(options) ||
           std::any_of(std::begin(output_formats), std::end(output_formats), is_of);
}

/// Adds the checksum of a file's contents, if the file exists. `kind`: "recording", "population file" ...
Result<void> add_contents(RunFingerprint& all, const std::string& kind, const std::string& path) {
    std::error_code status;
    if (!std::filesystem::is_regular_file(path, status)) return {};
    const auto contents = TRY(checksum_of_file(path));
    all.emplace_back(fmt::format("contents of the {}", kind), contents);
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

}  // namespace

/// Makes force_ from a recording of taxels.
Result<void> SkinRun::open_taxels() {
    if (!args_.contact.empty()) return bad_usage("--contact presses one force on the skin, and --taxels spreads those of taxels; use one");
    if (!args_.recording.layout.empty()) return bad_usage("--layout and --taxels both say where the channels are; use --taxels only");
    const auto layout = TRY(read_taxel_layout(args_.taxels));
    TRY(check_shear(layout, *source_));
    std::vector<std::string> names;
    for (const auto& c : source_->channels()) names.push_back(c.name);
    const auto taxels = TRY(match_taxels(layout, names, source_->name()));
    const auto& sites = innervation_->plan.sites;
    auto map = TRY(map_taxels(layout, sites));
    taxel_notes_ = map.notes;
    auto texture = TRY(make_taxel_texture(overrides_, sites, source_->clock().rate(), innervation_->plan.seed));
    keep_unused(unused_, texture.unused);
    if (texture.result)
        for (auto& note : texture.result->notes()) taxel_notes_.push_back(std::move(note));
    force_ = make_taxel_force(*source_, layout, std::move(map), taxels, sites.size(), std::move(texture.result));
    return {};
}

/// Makes force_: with an indenter if the force has one channel and the skin several sites, otherwise from one channel for each site.
Result<void> SkinRun::open_contact(std::string indenter, const NamedTouch* touch) {
    if (!args_.taxels.empty()) return open_taxels();
    const auto& sites = innervation_->plan.sites;
    const std::size_t channels = source_->channels().size();
    if (channels > 1 || sites.size() == 1) {
        if (!indenter.empty())
            return bad_usage(channels > 1 ? fmt::format("--contact {}: {} has {} channels; an indenter needs a force of one channel",
                                                        indenter, source_->name(), channels)
                                          : fmt::format("--contact {}: the skin has one site; an indenter needs several", indenter));
        auto at = TRY(match_sites(innervation_->plan, *source_));
        force_ = make_site_force(*source_, std::move(at), sites.size());
        return {};
    }
    if (indenter.empty()) indenter = touch ? touch->indenter : default_indenter;
    auto contact = TRY(make_contact(indenter, overrides_, sites, source_->clock(), innervation_->plan.seed));
    keep_unused(unused_, contact.unused);
    contact_ = std::move(contact.result);
    force_ = make_pressed_force(*source_, *contact_);
    return {};
}

/// Loads the population, applies the overrides to its classes, and places its afferents.
Result<void> SkinRun::place_afferents() {
    auto plan = TRY(load_skin_plan(args_.population, source_->channels()));
    auto applied = TRY(apply_overrides(std::move(plan), overrides_));
    keep_unused(unused_, applied.unused);
    auto& skin_plan = applied.result;
    if (options_.seed != 0) skin_plan.seed = options_.seed;  // 0, the default, keeps the seed of the population file
    if (source_->channels().size() == 1 || !args_.taxels.empty()) skin_note_ = treat_as_skin(skin_plan);
    innervation_ = TRY(innervate(std::move(skin_plan)));
    return {};
}

Result<void> SkinRun::plan() {
    if (args_.forces.size() != 1) return bad_usage(fmt::format("--population takes one FORCE, not {}", args_.forces.size()));
    overrides_ = unused_ = args_.settings;
    const auto* touch = args_.forces[0].touch;
    if (touch) add_touch_overrides(overrides_, *touch);
    source_ = TRY(open_source(touch ? ForceArgument{std::string(touch->force), true} : args_.forces[0], skin_rate));
    name_ = touch ? std::string(touch->name) : source_->name();
    TRY(place_afferents());
    population_.emplace(*innervation_, name_);
    TRY(open_contact(args_.contact, touch));
    return check_all_used(unused_, override_targets(innervation_->plan, {"contact", source_->name()}));
}

Result<RunFingerprint> SkinRun::fingerprint() const {
    RunFingerprint all = {{"the program", fmt::format("version {}", version)}, {"FORCE", args_.forces[0].text}};
    for (const auto& [name, values] : common_.typed)
        if (name != "FORCE" && !is_output_option(name)) all.emplace_back(name, joined(values, " "));
    if (const auto& force = args_.forces[0]; !force.is_stimulus && !force.touch) TRY(add_contents(all, "recording", force.text));
    TRY(add_contents(all, "population file", args_.population));
    TRY(add_contents(all, "layout file", args_.recording.layout));
    TRY(add_contents(all, "taxel file", args_.taxels));
    all.emplace_back("contents of the table of sites", sites_checksum(innervation_->plan.sites));
    return all;
}

Result<void> SkinRun::make_skin() {
    const auto set = TRY(instruction_set());
    const auto part =
        ranks_ ? SkinPart{static_cast<std::uint32_t>(ranks_->rank()), static_cast<std::uint32_t>(ranks_->size())} : SkinPart{};
    skin_ = TRY(Skin::make(innervation_, options_.for_clock(source_->clock()), set, part));
    return {};
}

void SkinRun::work() {
    ThreadPool pool(std::max(1U, args_.threads));
    auto ready = plan();
    if (ready) ready = make_skin();
    ready ? run_skin_worker(*ranks_, force_.get(), skin_.get(), pool) : run_skin_worker(*ranks_, ready.error(), nullptr, pool);
}

Result<void> SkinRun::open_checkpoint() {
    if (args_.outputs.checkpoint.empty()) return {};
    if (ranks_) return bad_usage("--checkpoint works with one process only, not under mpirun");
    auto current = TRY(fingerprint());
    checkpoint_ = TRY(SkinCheckpoint::open(args_.outputs.checkpoint, *skin_, std::move(current)));
    if (checkpoint_->resumed_samples() > 0 && !common_.quiet)
        print_message(fmt::format("resuming after {:.3f} s, from {}",
                                  source_->clock().T() * static_cast<double>(checkpoint_->resumed_samples()), args_.outputs.checkpoint));
    return {};
}

Result<std::vector<std::unique_ptr<BlockSimulator>>> SkinRun::simulators() {
    TRY(make_skin());
    TRY(open_checkpoint());
    std::vector<std::unique_ptr<BlockSimulator>> inputs;
    inputs.push_back(std::make_unique<SkinSimulator>(*population_, make_input(*population_, name_, *source_), *force_, *skin_,
                                                     checkpoint_.get(), ranks_));
    return inputs;
}

nlohmann::ordered_json SkinRun::summarize(const RunStats& stats) {
    notes_.stats = stats;
    add_force_notes();
    add_silence_notes();
    add_rate_warnings();
    print_notes(name_, notes_.notes, common_.quiet);
    for (const auto& warning : notes_.warnings) print_warning(warning);
    return summary_.document(options_, notes_);
}

std::string SkinRun::page(const nlohmann::ordered_json&) const { return skin_page(summary_, *report_, options_, notes_, common_.command); }

Result<void> SkinRun::finish(const RunStats&) {
    if (checkpoint_) checkpoint_->remove_files();
    return {};
}

std::string SkinRun::table() const { return format_table(summary_.table()); }

}  // namespace corpuscle
