#include "cli/respond/skin_run.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/output/terminal.hpp"

namespace corpuscle {

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

Error SkinRun::interruption(Error error) const {
    if (checkpoint_) error.message = fmt::format("interrupted; the same command resumes from {}", args_.outputs.checkpoint);
    return error;
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

void SkinRun::remove_checkpoint() {
    if (checkpoint_) checkpoint_->remove_files();
}

std::string SkinRun::table() const { return format_table(summary_.table()); }

}  // namespace corpuscle
