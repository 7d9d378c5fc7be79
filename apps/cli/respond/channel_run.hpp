#pragma once
// A run of afferents on channels: the afferents of --afferent, or copies of them, on every channel of every input.

#include "cli/respond/planned_run.hpp"
#include "report/respond/respond_report.hpp"
#include "run/summary/run_summary.hpp"
#include "run/summary/silent_afferents.hpp"

namespace corpuscle {

class ChannelRun final : public PlannedRun {
    std::vector<ParameterOverride> spreads_;  // of --spread; those that no afferent so far has used
    std::vector<AfferentPlan> afferents_;     // the afferents of --afferent
    CopySpec copy_spec_;
    std::vector<AfferentPlan> copies_;  // the simulated afferents: all copies, or without --copies the afferents themselves
    std::vector<std::unique_ptr<ForceSource>> sources_;
    std::vector<std::string> warnings_;
    RunSummary summary_;
    SilenceDetector silence_;
    std::optional<RespondReport> report_;

    Result<void> plan_afferents();
    Result<void> add_copies();
    Result<void> check_overrides() const;
    Result<void> check_afferent_count() const;
    void warn(std::string message);
    void warn_of_sensor_noise();
    void warn_of_rates();
    std::size_t netlist_count() const;

public:
    using PlannedRun::PlannedRun;
    Result<void> plan() override;
    OutputRequest output_request() const override;
    Sink& start_report() override;
    Result<std::vector<std::unique_ptr<BlockSimulator>>> simulators() override;
    std::vector<Sink*> summaries() override { return {&summary_, &silence_}; }
    nlohmann::ordered_json summarize(const RunStats&) override;
    std::string page(const nlohmann::ordered_json& document) const override;
    std::string table() const override;
    Result<void> finish(const RunStats&) override;
};

}  // namespace corpuscle
