#pragma once
// A run of afferents on channels: the afferents of --afferent, or copies of them, on every channel of every input.

#include "cli/respond/planned_run.hpp"
#include "report/respond/respond_report.hpp"
#include "report/trials_document.hpp"
#include "run/channels/channel_outcome.hpp"

namespace corpuscle {

class ChannelRun final : public PlannedRun {
    ChannelPlan plan_;
    std::vector<std::unique_ptr<ForceSource>> sources_;
    std::vector<std::string> labels_;  // with --by: of the trials that the sources are
    std::optional<ChannelOutcome> outcome_;  // after plan()
    std::size_t printed_notes_ = 0, printed_warnings_ = 0;
    std::optional<RespondReport> report_;

    Result<void> open_sources();
    Result<void> open_trials(const ForceArgument&);
    Result<void> plan_trials() override;
    Result<void> check_overrides() const;
    std::size_t channel_count() const;
    void print_new_notes();
    std::size_t netlist_count() const;

public:
    using PlannedRun::PlannedRun;
    Result<void> plan() override;
    OutputRequest output_request() const override;
    Sink& start_report() override;
    Result<std::vector<std::unique_ptr<BlockSimulator>>> simulators() override;
    std::vector<Sink*> summaries() override { return outcome_->sinks(); }
    nlohmann::ordered_json summarize(const RunStats&) override;
    std::string page(const nlohmann::ordered_json& document) const override;
    std::string table() const override;
    Result<void> finish(const RunStats&) override;
};

}  // namespace corpuscle
