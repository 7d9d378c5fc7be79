#pragma once

#include <chrono>
#include <deque>

#include "circuit/netlist_variants.hpp"
#include "circuit/plot_formats.hpp"
#include "circuit/run_directives.hpp"
#include "io/output_check.hpp"
#include "io/output_file.hpp"
#include "verbs.hpp"

namespace corpuscle {

/// Writes curves while they are computed: either one .raw file, or one CSV table per analysis (x.csv, or x-1.csv, x-2.csv ...).
/// With .step or .mc each CSV row begins with its step or chip. A transient's points are written in blocks; the files are readable at any
/// time.
class CurveFiles final : public circuit::CurveSink {
    using Clock = std::chrono::steady_clock;
    const RunArguments& arguments_;
    OutputCheck check_;
    bool has_steps_, is_csv_;
    std::deque<OutputFile> files_;  // a deque keeps addresses stable
    std::string title_, label_;
    std::size_t analysis_count_ = 0, plot_count_ = 0;  // of the current variant: number of analyses; plots written so far
    // state of the current transient:
    OutputFile* file_ = nullptr;
    std::string rows_;  // points that are not written yet, in the format of the file
    std::size_t point_count_ = 0;
    std::size_t count_offset_ = 0;               // position of the point count in a .raw file, bytes
    double newest_time_ = 0, written_time_ = 0;  // s: newest point; last point written to the file
    Clock::time_point last_write_;
    bool has_streamed_ = false;        // a transient has delivered more than its first point
    bool has_complete_plots_ = false;  // an analysis has delivered complete plots

    Result<void> write_pending();
    Result<void> write_table(const circuit::Plot&, std::size_t count);
    std::string path_of(std::size_t file_count, std::size_t index) const;
    Result<OutputFile*> open(std::size_t file_count, std::size_t index, const std::string& head);

public:
    CurveFiles(const RunArguments& arguments, bool has_steps, bool overwrite)
        : arguments_(arguments), check_(overwrite), has_steps_(has_steps), is_csv_(arguments.out.ends_with(".csv")) {}

    /// Checks before the run that the files of a netlist with this many analyses may be written.
    Result<void> check(std::size_t analysis_count) const;
    void begin_variant(const circuit::Variant&);
    Result<void> add_plots(std::span<const circuit::Plot>) override;
    Result<void> begin(const circuit::Plot& head) override;
    Result<void> add_point(std::span<const double> row) override;
    Result<void> end() override;

    /// Renames the finished files to their final names.
    Result<void> finish();
    /// Finishes the files of an incomplete run. Returns a note that says at which point they end, or "" if no file was kept.
    /// After a failure only the points of a transient are kept; after an interruption complete analyses are kept, too.
    Result<std::string> finish_early(bool interrupted);
};

}  // namespace corpuscle
