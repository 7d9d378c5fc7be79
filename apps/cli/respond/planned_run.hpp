#pragma once
// A run of respond: afferents on channels (channel_run.hpp) or a skin (skin_run.hpp).

#include <nlohmann/json_fwd.hpp>

#include "cli/respond/respond_arguments.hpp"
#include "core/parameter_override.hpp"
#include "run/run_inputs.hpp"
#include "run/sinks.hpp"

namespace corpuscle {

class PlannedRun {
protected:
    const RespondArguments& args_;
    const CommonArguments& common_;
    std::vector<ParameterOverride> overrides_, unused_;  // unused_: those of the user that no part of the run so far has used
    RespondOptions options_;

    /// Opens a force with the overrides, and with a progress bar unless --quiet was given. `rate`: default sampling rate of stimuli, Hz.
    Result<std::unique_ptr<ForceSource>> open_source(const ForceArgument&, double rate);

public:
    /// The arguments outlive the run.
    PlannedRun(const RespondArguments& args, const CommonArguments& common) : args_(args), common_(common), options_(args.simulation) {}
    PlannedRun(const PlannedRun&) = delete;
    PlannedRun& operator=(const PlannedRun&) = delete;
    virtual ~PlannedRun() = default;
    /// Plans the afferents and opens the force. Call it first.
    virtual Result<void> plan() = 0;
    /// The properties of the run for the output formats. `directory` and `options` are set by the caller.
    virtual OutputRequest output_request() const = 0;
    /// The sink of the report page. From then on, the page is part of the run.
    virtual Sink& start_report() = 0;
    /// The simulators of all inputs. Call it once.
    virtual Result<std::vector<std::unique_ptr<BlockSimulator>>> simulators() = 0;
    /// The summaries, which precede all other sinks.
    virtual std::vector<Sink*> summaries() = 0;
    const RespondOptions& options() const { return options_; }
    /// Explains how to continue after an interruption.
    virtual Error interruption(Error error) const { return error; }

    // The following are called after the run, in this order.
    /// Collects and prints the notes and warnings of the run. Returns summary.json, without its list of files.
    virtual nlohmann::ordered_json summarize(const RunStats&) = 0;
    /// The report page. `document`: of this run.
    virtual std::string page(const nlohmann::ordered_json& document) const = 0;
    /// Called when all outputs have their final names.
    virtual void remove_checkpoint() {}
    /// The result as text for a terminal.
    virtual std::string table() const = 0;
    /// Success, or the error of a run that is complete but not correct.
    virtual Result<void> verdict(const RunStats&) const { return {}; }
};

}  // namespace corpuscle
