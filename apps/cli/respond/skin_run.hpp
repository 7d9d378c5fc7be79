#pragma once
// A run of a skin: the afferents of --population under the force of one input.

#include "cli/respond/planned_run.hpp"
#include "report/skin/skin_report.hpp"
#include "run/skin/skin_scene.hpp"
#include "run/skin/skin_simulator.hpp"
#include "run/summary/silent_afferents.hpp"
#include "run/summary/skin_summary.hpp"

namespace corpuscle {

class SkinRun final : public PlannedRun {
    Ranks* ranks_;  // null: a single process
    std::unique_ptr<ForceSource> source_;
    SkinScene scene_;
    SkinRunNotes notes_;
    std::string name_;  // of the touch, stimulus or recording
    std::optional<SkinPopulation> population_;
    std::unique_ptr<Skin> skin_;  // the afferents that this process simulates
    std::unique_ptr<SkinCheckpoint> checkpoint_;
    SkinSummary summary_;
    SilenceDetector silence_;
    std::optional<SkinReport> report_;

    Result<void> make_skin();
    /// All that determines the response: the program's version, the force, all options except those of outputs, and the contents of the
    /// files that they name.
    Result<RunFingerprint> fingerprint() const;
    Result<void> open_checkpoint();
    // Notes and warnings, after the run:
    void add_force_notes();
    std::string stronger_stimulus_advice(double factor) const;
    void add_silence_notes();
    void add_rate_warnings();

public:
    /// `ranks`: the processes that share the run; null: a single process.
    SkinRun(const RespondArguments& args, const CommonArguments& common, Ranks* ranks) : PlannedRun(args, common), ranks_(ranks) {}
    /// For an MPI rank other than 0: plans the run and simulates its part of the afferents. Errors are sent to rank 0.
    void work();
    Result<void> plan() override;
    OutputRequest output_request() const override { return {.skin = &summary_}; }
    Sink& start_report() override { return report_.emplace(); }
    Result<std::vector<std::unique_ptr<BlockSimulator>>> simulators() override;
    std::vector<Sink*> summaries() override { return {&summary_, &silence_}; }
    nlohmann::ordered_json summarize(const RunStats&) override;
    std::string page(const nlohmann::ordered_json& document) const override;
    Result<void> finish(const RunStats&) override;
    std::string table() const override;
};

}  // namespace corpuscle
