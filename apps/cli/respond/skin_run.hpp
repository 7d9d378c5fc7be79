#pragma once
// A run of a skin: the afferents of --population under the force of one input.

#include "cli/respond/planned_run.hpp"
#include "report/skin/skin_page.hpp"
#include "run/skin/skin_simulator.hpp"
#include "run/summary/silent_afferents.hpp"
#include "run/summary/skin_summary.hpp"

namespace corpuscle {

/// The parts of a run of a skin, planned from the arguments.
struct SkinJob : RespondJob {
    std::unique_ptr<ForceSource> source;
    std::shared_ptr<const Innervation> skin;
    std::unique_ptr<Contact> contact;  ///< null: each channel is the force at one site
    std::unique_ptr<SkinForce> force;
    SkinRunNotes notes;
    std::string name;       ///< of the touch, stimulus or recording
    std::string skin_note;  ///< note that a sensor array is treated as skin; "" if it is not
};

/// Reads the options, opens the force and places the afferents.
Result<SkinJob> plan_skin_job(const RespondArguments&, bool quiet);
/// All that determines the response: the program's version, the force, all options except those of outputs, and the contents of the files
/// that they name.
Result<RunFingerprint> fingerprint_of(const SkinJob&, const RespondArguments&, const CommonArguments&);
/// After the run: adds all notes and warnings to job.notes.
void collect_notes(SkinJob&, const RespondArguments&, const SkinSummary&, const SilenceDetector&);
/// For an MPI rank other than 0: plans the run and simulates its part of the afferents. Errors are sent to rank 0.
void work_for_skin_run(const RespondArguments&, Ranks&);

class SkinRun final : public PlannedRun {
    SkinJob job_;
    const RespondArguments& args_;
    const CommonArguments& common_;
    Ranks* ranks_;  // null: a single process
    SkinPopulation population_;
    std::unique_ptr<Skin> skin_;
    std::unique_ptr<SkinCheckpoint> checkpoint_;
    SkinSummary summary_;
    SilenceDetector silence_;
    std::optional<SkinReport> report_;

    Result<void> open_checkpoint();

public:
    SkinRun(SkinJob job, const RespondArguments& args, const CommonArguments& common, Ranks* ranks)
        : job_(std::move(job)), args_(args), common_(common), ranks_(ranks), population_(*job_.skin, job_.name) {}
    OutputRequest output_request() const override { return {.skin = &summary_}; }
    Sink& start_report() override { return report_.emplace(); }
    Result<std::vector<std::unique_ptr<BlockSimulator>>> simulators() override;
    std::vector<Sink*> summaries() override { return {&summary_, &silence_}; }
    const RespondOptions& options() const override { return job_.options; }
    Error interruption(Error) const override;
    nlohmann::ordered_json summarize(const RunStats&) override;
    std::string page(const nlohmann::ordered_json& document) const override;
    void remove_checkpoint() override;
    std::string table() const override;
};

}  // namespace corpuscle
