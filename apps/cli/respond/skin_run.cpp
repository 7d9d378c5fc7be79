#include "cli/respond/skin_run.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/output/terminal.hpp"

namespace corpuscle {
namespace {

/// The afferents of a skin that this process simulates.
Result<std::unique_ptr<Skin>> make_skin(const SkinJob& job, const Ranks* ranks) {
    const auto set = TRY(instruction_set());
    const auto part = ranks ? SkinPart{static_cast<std::uint32_t>(ranks->rank()), static_cast<std::uint32_t>(ranks->size())} : SkinPart{};
    return Skin::make(job.skin, job.options.for_clock(job.source->clock()), set, part);
}

}  // namespace

void work_for_skin_run(const RespondArguments& args, Ranks& ranks) {
    ThreadPool pool(std::max(1U, args.threads));
    auto job = plan_skin_job(args, true);
    if (!job) return run_skin_worker(ranks, job.error(), nullptr, pool);
    auto skin = make_skin(*job, &ranks);
    if (!skin) return run_skin_worker(ranks, skin.error(), nullptr, pool);
    run_skin_worker(ranks, job->force.get(), skin->get(), pool);
}

Result<void> SkinRun::open_checkpoint() {
    if (args_.outputs.checkpoint.empty()) return {};
    if (ranks_) return bad_usage("--checkpoint works with one process only, not under mpirun");
    auto fingerprint = TRY(fingerprint_of(job_, args_, common_));
    checkpoint_ = TRY(SkinCheckpoint::open(args_.outputs.checkpoint, *skin_, std::move(fingerprint)));
    if (checkpoint_->resumed_samples() > 0 && !common_.quiet)
        print_message(fmt::format("resuming after {:.3f} s, from {}",
                                  job_.source->clock().T() * static_cast<double>(checkpoint_->resumed_samples()),
                                  args_.outputs.checkpoint));
    return {};
}

Result<std::vector<std::unique_ptr<BlockSimulator>>> SkinRun::simulators() {
    skin_ = TRY(make_skin(job_, ranks_));
    TRY(open_checkpoint());
    const SkinRunParts parts{ranks_, checkpoint_.get()};
    std::vector<std::unique_ptr<BlockSimulator>> inputs;
    inputs.push_back(
        std::make_unique<SkinSimulator>(population_, make_input(population_, job_.name, *job_.source), *job_.force, *skin_, parts));
    return inputs;
}

Error SkinRun::interruption(Error error) const {
    if (checkpoint_) error.message = fmt::format("interrupted; the same command resumes from {}", args_.outputs.checkpoint);
    return error;
}

nlohmann::ordered_json SkinRun::summarize(const RunStats& stats) {
    job_.notes.stats = stats;
    collect_notes(job_, args_, summary_, silence_);
    for (const auto& r : common_.quiet ? std::vector<std::string>{} : job_.notes.notes) print_message(fmt::format("{}: {}", job_.name, r));
    for (const auto& warning : job_.notes.warnings) print_warning(warning);
    return summary_.document(job_.options, job_.notes);
}

std::string SkinRun::page(const nlohmann::ordered_json&) const {
    return skin_page(summary_, *report_, job_.options, job_.notes, common_.command);
}

void SkinRun::remove_checkpoint() {
    if (checkpoint_) checkpoint_->remove_files();
}

std::string SkinRun::table() const { return format_table(summary_.table()); }

}  // namespace corpuscle
