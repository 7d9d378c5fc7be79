#pragma once
// The output files of one skin run. They are created before the run and renamed to their final names after it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/output_check.hpp"
#include "report/skin_page.hpp"
#include "study/skin_file_sink.hpp"
#include "verbs.hpp"

namespace corpuscle {

class SkinOutputs {
    std::string directory_;
    std::vector<std::unique_ptr<SkinFileSink>> files_;
    std::optional<SkinReport> report_;
    std::optional<OutputFile> summary_file_, report_file_;
    std::vector<std::string> removed_;

    template <class F, class... A>
    Result<void> add(const std::string& name, const A&... arguments);
    Result<void> open_directory(const RespondArguments&, const SkinSummary&, const std::optional<std::string>& page, OutputCheck&);
    std::vector<std::string> paths() const;

public:
    SkinOutputs() = default;
    SkinOutputs(const SkinOutputs&) = delete;
    SkinOutputs& operator=(const SkinOutputs&) = delete;
    ~SkinOutputs();
    /// Creates the files. Some of them write counts of the summary, which must therefore precede them in the list of sinks.
    Result<void> open(const RespondArguments&, const SkinSummary&, OutputCheck&);
    void add_listeners(std::vector<SkinSink*>&);
    std::vector<std::string> file_names() const;
    Result<void> commit(const SkinSummary&, const SkinRunNotes&, const std::string& document, const std::string& command);
    std::string written_text() const;
};

}  // namespace corpuscle
