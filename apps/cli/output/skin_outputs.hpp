#pragma once
// The output files of one skin run. They are created before the run and renamed to their final names after it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/verbs.hpp"
#include "io/output/output_check.hpp"
#include "report/skin/skin_page.hpp"
#include "run/sinks/skin_file_sink.hpp"

namespace corpuscle {

class SkinOutputs {
    std::string directory_;  // of --out; "" without it
    std::vector<std::unique_ptr<SkinFileSink>> files_;
    std::optional<SkinReport> report_;
    std::optional<OutputFile> summary_file_, report_file_;
    std::vector<std::string> removed_;  // names of the removed files of an earlier run

    /// Creates a file of this name in the directory, for a sink of type F.
    template <class F, class... A>
    Result<void> add(const std::string& name, const A&... arguments);
    Result<void> open_directory(const RespondArguments&, const SkinSummary&, const std::optional<std::string>& page, OutputCheck&);
    std::vector<std::string> paths() const;

public:
    SkinOutputs() = default;
    SkinOutputs(const SkinOutputs&) = delete;
    SkinOutputs& operator=(const SkinOutputs&) = delete;
    ~SkinOutputs();
    /// Creates the files. afferents.csv is written from the summary, which must therefore precede these sinks among the sinks of the run.
    Result<void> open(const RespondArguments&, const SkinSummary&, OutputCheck&);
    /// Adds the sinks of all files to the sinks of the run.
    void add_sinks(std::vector<SkinSink*>&);
    /// The names of the files that are written into the directory.
    std::vector<std::string> file_names() const;
    /// Writes the report page and summary.json (`document`), gives all files their final names, and removes stale files of an earlier run.
    Result<void> commit(const SkinSummary&, const SkinRunNotes&, const std::string& document, const std::string& command);
    /// The message that lists the written and removed files.
    std::string written_text() const;
};

}  // namespace corpuscle
