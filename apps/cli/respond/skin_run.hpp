#pragma once
// A run of a skin: the afferents of --population under the force of one input.

#include "cli/respond/planned_run.hpp"
#include "report/skin/skin_report.hpp"
#include "report/trials_document.hpp"
#include "run/skin/skin_outcome.hpp"
#include "run/skin/skin_simulator.hpp"

namespace corpuscle {

class SkinRun final : public PlannedRun {
    Ranks* ranks_;  // null: a single process
    std::unique_ptr<ForceSource> source_;
    SkinScene scene_;
    std::string name_;  // of the touch, stimulus or recording
    std::optional<SkinPopulation> population_;
    std::unique_ptr<Skin> skin_;  // the afferents that this process simulates
    std::unique_ptr<SkinCheckpoint> checkpoint_;
    std::optional<SkinOutcome> outcome_;  // after plan()
    std::optional<SkinReport> report_;

    Result<void> make_skin();
    /// All that determines the response: the program's version, the force, all options except those of outputs, and the contents of the
    /// files that they name.
    Result<RunFingerprint> fingerprint() const;
    Result<void> open_checkpoint();

public:
    /// `ranks`: the processes that share the run; null: a single process.
    SkinRun(const RespondArguments& args, const CommonArguments& common, Ranks* ranks) : PlannedRun(args, common), ranks_(ranks) {}
    /// For an MPI rank other than 0: plans the run and simulates its part of the afferents. Errors are sent to rank 0.
    void work();
    Result<void> plan() override;
    OutputRequest output_request() const override { return {.skin = &outcome_->summary}; }
    Sink& start_report() override { return report_.emplace(); }
    Result<std::vector<std::unique_ptr<BlockSimulator>>> simulators() override;
    std::vector<Sink*> summaries() override { return outcome_->sinks(); }
    nlohmann::ordered_json summarize(const RunStats&) override;
    std::string page(const nlohmann::ordered_json& document) const override;
    Result<void> finish(const RunStats&) override;
    std::string table() const override;
};

}  // namespace corpuscle
