#pragma once
// The arguments of `corpuscle respond`, and a run with them: afferents on channels (channel_run.hpp) or a skin (skin_run.hpp).

#include "cli/arguments/shared_arguments.hpp"
#include "run/run_inputs.hpp"
#include "run/sinks.hpp"
#include "run/trials/trial_collector.hpp"

namespace corpuscle {

/// The files that the run writes.
struct OutputArguments {
    std::string directory;                                    ///< of --out; "": not given
    std::optional<std::string> page;                          ///< path of the report page; no value without --report
    std::string checkpoint;                                   ///< "": not given
    std::map<std::string, std::string, std::less<>> formats;  ///< the options of the output formats (run/sinks.hpp)
    std::vector<std::string> nwb_fields;                      ///< of --nwb-field
};

struct RespondArguments {
    std::vector<ForceArgument> forces;
    std::vector<std::string> afferents;  ///< of --afferent; default: sa1, fa1. They are read only if there is no --population
    std::vector<ParameterOverride> settings, spreads;
    NetlistArguments netlists;
    RecordingOptions recording;  ///< `rate` also applies to stimuli
    RespondOptions simulation;
    TrialOptions trials;
    OutputArguments outputs;
    std::string report_file;                  ///< of --report; "" without a name
    std::string population, contact, taxels;  ///< options of a skin; "": not given
    std::uint32_t copies = 0;                 ///< 0: not given
    std::uint32_t threads = 0;                ///< 0: one per core, or one per MPI rank
};

/// True for an option that changes where or how results are written and how fast, but not the response.
bool is_output_option(std::string_view name);

/// Runs the verb. Returns the exit status.
int respond(const RespondArguments&, const CommonArguments&);

class PlannedRun {
protected:
    const RespondArguments& args_;
    const CommonArguments& common_;
    std::vector<ParameterOverride> overrides_, unused_;  // unused_: those of the user that no part of the run so far has used
    RespondOptions options_;
    std::unique_ptr<TrialCollector> trials_;  // null without trials

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
    /// Reads the table of trials, if trials are requested. Call it after plan().
    virtual Result<void> plan_trials();
    TrialCollector* trials() const { return trials_.get(); }
    /// The width of the bins of histograms over trials, s: that of --bin, or one that suits them. Call it after the run.
    double trial_bin() const;
    /// The properties of the run for the output formats. `directory`, `options` and `trials` are set by the caller.
    virtual OutputRequest output_request() const = 0;
    /// The sink of the report page. From then on, the page is part of the run.
    virtual Sink& start_report() = 0;
    /// The simulators of all inputs. Call it once.
    virtual Result<std::vector<std::unique_ptr<BlockSimulator>>> simulators() = 0;
    /// The summaries, which precede all other sinks.
    virtual std::vector<Sink*> summaries() = 0;
    const RespondOptions& options() const { return options_; }

    // The following are called after the run, in this order.
    /// Collects and prints the notes and warnings of the run. Returns summary.json, without its list of files.
    virtual nlohmann::ordered_json summarize(const RunStats&) = 0;
    /// The report page. `document`: of this run.
    virtual std::string page(const nlohmann::ordered_json& document) const = 0;
    /// Called when all outputs have their final names. Success, or the error of a run that is complete but not correct.
    virtual Result<void> finish(const RunStats&) = 0;
    /// The result as text for a terminal.
    virtual std::string table() const = 0;
};

/// The output files of one run. They are created before the run and renamed to their final names after it.
class RunOutputs {
    std::string directory_;  // of --out; "" without it
    std::vector<std::unique_ptr<FileSink>> files_;
    Sink* report_ = nullptr;  // null without --report
    std::optional<OutputFile> summary_file_, report_file_;
    std::vector<std::string> removed_;  // names of the removed files of an earlier run

    std::vector<std::string> paths() const;

public:
    RunOutputs() = default;
    RunOutputs(const RunOutputs&) = delete;
    RunOutputs& operator=(const RunOutputs&) = delete;
    ~RunOutputs();
    /// Checks that all files may be written, and creates them.
    Result<void> open(const OutputArguments&, PlannedRun&, const CommonArguments&);
    /// Adds the sinks of all files to the sinks of the run.
    void add_sinks(std::vector<Sink*>&) const;
    /// The names of the files that are written into the directory.
    std::vector<std::string> file_names() const;
    /// Writes the report page and summary.json, gives all files their final names, and removes stale files of an earlier run.
    Result<void> commit(const PlannedRun&, const nlohmann::ordered_json& document);
    /// The message that lists the written and removed files.
    std::string written_text() const;
};

}  // namespace corpuscle
