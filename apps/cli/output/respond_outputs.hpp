#pragma once
// The output files of one run of respond. They are created before the run and renamed to their final names after it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/verbs.hpp"
#include "io/output/output_check.hpp"
#include "report/respond/respond_report.hpp"
#include "run/sinks/file_sinks.hpp"

namespace corpuscle {

class RespondOutputs {
    std::string directory_;  // of --out; "" without it
    std::vector<std::unique_ptr<FileSink>> files_;
    std::optional<RespondReport> report_;
    std::optional<OutputFile> summary_file_, report_file_;
    std::vector<std::string> removed_;  // names of the removed files of an earlier run

    /// Creates a file of this name in the directory, for a sink of type F.
    template <class F, class... A>
    Result<void> add(const char* name, A... arguments);
    Result<void> open_directory(const RespondArguments&, const CopySpec&, std::optional<double> bin);
    Result<void> check(const RespondArguments&, const CopySpec&, const std::optional<std::string>& page,
                       std::vector<std::string> later_names, OutputCheck&);
    std::vector<std::string> paths() const;

public:
    RespondOutputs() = default;
    RespondOutputs(const RespondOutputs&) = delete;
    RespondOutputs& operator=(const RespondOutputs&) = delete;
    ~RespondOutputs();
    /// Creates the files. `later_names`: names of the files in the directory that are created only during the run, but must be checked
    /// before it.
    Result<void> open(const RespondArguments&, const CopySpec&, std::vector<std::string> later_names, OutputCheck&);
    /// Adds the sinks of all files to the sinks of the run.
    void add_sinks(std::vector<ResponseSink*>&);
    /// The names of the files that are written into the directory.
    std::vector<std::string> file_names() const;
    /// Writes the report page and summary.json (`document`), gives all files their final names, and removes stale files of an earlier run.
    Result<void> commit(const RunSummary&, std::span<const AfferentPlan>, const std::vector<std::string>& warnings,
                        const std::string& document, const std::string& command, const nlohmann::ordered_json& costs);
    /// The message that lists the written and removed files.
    std::string written_text() const;
};

}  // namespace corpuscle
