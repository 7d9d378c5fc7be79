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

Result<void> SkinRun::plan() {
    if (args_.forces.size() != 1) return bad_usage(fmt::format("--population takes one FORCE, not {}", args_.forces.size()));
    overrides_ = unused_ = args_.settings;
    const auto* touch = args_.forces[0].touch;
    if (touch) add_touch_overrides(overrides_, *touch);
    source_ = TRY(open_source(touch ? ForceArgument{std::string(touch->force), true} : args_.forces[0], skin_rate));
    name_ = touch ? std::string(touch->name) : source_->name();
    scene_ = TRY(SkinScene::make({.population = args_.population,
                                  .contact = args_.contact,
                                  .taxels = args_.taxels,
                                  .has_layout = !args_.recording.layout.empty(),
                                  .touch = touch,
                                  .overrides = overrides_,
                                  .seed = options_.seed},
                                 *source_));
    keep_unused(unused_, scene_.unused);
    population_.emplace(*scene_.innervation, name_);
    outcome_.emplace(scene_, options_);
    return check_all_used(unused_, override_targets(scene_.innervation->plan, {"contact", source_->name()}));
}

Result<RunFingerprint> SkinRun::fingerprint() const {
    RunFingerprint all = {{"the program", fmt::format("version {}", version)}, {"FORCE", args_.forces[0].text}};
    for (const auto& [name, values] : common_.typed)
        if (name != "FORCE" && !is_output_option(name)) all.emplace_back(name, joined(values, " "));
    if (const auto& force = args_.forces[0]; !force.is_stimulus && !force.touch) TRY(add_contents(all, "recording", force.text));
    TRY(add_contents(all, "population file", args_.population));
    TRY(add_contents(all, "layout file", args_.recording.layout));
    TRY(add_contents(all, "taxel file", args_.taxels));
    all.emplace_back("contents of the table of sites", sites_checksum(scene_.innervation->plan.sites));
    return all;
}

Result<void> SkinRun::make_skin() {
    const auto set = TRY(instruction_set());
    const auto part =
        ranks_ ? SkinPart{static_cast<std::uint32_t>(ranks_->rank()), static_cast<std::uint32_t>(ranks_->size())} : SkinPart{};
    skin_ = TRY(Skin::make(scene_.innervation, options_.for_clock(source_->clock()), set, part));
    return {};
}

void SkinRun::work() {
    ThreadPool pool(std::max(1U, args_.threads));
    auto ready = plan();
    if (ready) ready = make_skin();
    ready ? run_skin_worker(*ranks_, scene_.force.get(), skin_.get(), pool) : run_skin_worker(*ranks_, ready.error(), nullptr, pool);
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
    inputs.push_back(std::make_unique<SkinSimulator>(*population_, make_input(*population_, name_, *source_), *scene_.force, *skin_,
                                                     checkpoint_.get(), ranks_));
    return inputs;
}

nlohmann::ordered_json SkinRun::summarize(const RunStats& stats) {
    outcome_->finish(*source_, scene_, stats, {args_.population, args_.recording.unit.has_value()});
    print_notes(name_, outcome_->notes.notes, common_.quiet);
    for (const auto& warning : outcome_->notes.warnings) print_warning(warning);
    return outcome_->document();
}

std::string SkinRun::page(const nlohmann::ordered_json&) const {
    return skin_page(outcome_->summary, *report_, outcome_->options, outcome_->notes, common_.command,
                     trials_ ? skin_trials_document(*trials_, trial_bin()) : nlohmann::ordered_json());
}

Result<void> SkinRun::finish(const RunStats&) {
    if (checkpoint_) checkpoint_->remove_files();
    return {};
}

std::string SkinRun::table() const { return format_table(outcome_->summary.table()); }

}  // namespace corpuscle
