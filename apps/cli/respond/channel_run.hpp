#pragma once
// A run of afferents on channels: the afferents of --afferent, or copies of them, on every channel of every input.

#include "cli/respond/planned_run.hpp"
#include "report/respond/respond_report.hpp"
#include "run/summary/run_summary.hpp"
#include "run/summary/silent_afferents.hpp"

namespace corpuscle {

/// The parts of a run on channels, planned from the arguments.
struct ChannelJob : RespondJob {
    std::vector<ParameterOverride> spreads;  // of --spread; those that no afferent so far has used
    std::vector<AfferentPlan> afferents;     // the afferents of --afferent
    CopySpec copy_spec;
    std::vector<AfferentPlan> copies;  // the simulated afferents: all copies, or without --copies the afferents themselves
    std::vector<std::unique_ptr<ForceSource>> sources;
    std::vector<std::string> warnings;
};

/// Reads the options, plans the afferents and opens the sources.
Result<ChannelJob> plan_channel_job(const RespondArguments&, bool quiet);

class ChannelRun final : public PlannedRun {
    ChannelJob job_;
    std::string command_;
    bool quiet_;
    RunSummary summary_;
    SilenceDetector silence_;
    std::optional<RespondReport> report_;

    void warn(std::string message);
    void warn_of_rates();

public:
    ChannelRun(ChannelJob job, const CommonArguments& common) : job_(std::move(job)), command_(common.command), quiet_(common.quiet) {}
    OutputRequest output_request() const override;
    Sink& start_report() override;
    Result<std::vector<std::unique_ptr<BlockSimulator>>> simulators() override;
    std::vector<Sink*> summaries() override { return {&summary_, &silence_}; }
    const RespondOptions& options() const override { return job_.options; }
    nlohmann::ordered_json summarize(const RunStats&) override;
    std::string page(const nlohmann::ordered_json& document) const override;
    std::string table() const override;
    Result<void> verdict(const RunStats&) const override;
};

}  // namespace corpuscle
