#pragma once
// The output files of one run of respond. They are created before the run and renamed to their final names after it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/respond/planned_run.hpp"
#include "io/output/output_check.hpp"

namespace corpuscle {

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
    Result<void> open(const OutputArguments&, PlannedRun&, bool overwrite);
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
