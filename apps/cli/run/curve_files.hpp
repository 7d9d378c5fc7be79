#pragma once
// The files with curves that `corpuscle run --out` writes.

#include <chrono>
#include <deque>

#include "circuit/output/plot_formats.hpp"
#include "circuit/run_directives.hpp"
#include "circuit/variant/netlist_variants.hpp"
#include "io/output/output_check.hpp"
#include "io/output/output_file.hpp"

namespace corpuscle {

/// Writes curves while they are computed: either one .raw file, or one CSV table for each plot (x.csv, or x-1.csv, x-2.csv ... if there are
/// several). With .step or .mc, each CSV row begins with the label of its variant (a step or a chip). The points of a transient are written
/// in blocks; the files are readable at any time.
class CurveFiles final : public circuit::PointSink {
    using Clock = std::chrono::steady_clock;
    std::string path_;  // x.raw or x.csv; "": no files
    OutputCheck check_;
    bool is_ascii_, has_steps_, is_csv_;  // is_ascii_: a .raw file is written as text; has_steps_: the netlist has several variants
    std::deque<OutputFile> files_;        // all files so far; a deque keeps their addresses, which file_ and open() use
    // The current variant:
    std::string title_, label_;
    std::size_t expected_count_ = 0, plot_count_ = 0;  // number of plots of its analyses; number of its CSV tables begun so far
    // The current plot:
    circuit::Plot head_;  // without values
    OutputFile* file_ = nullptr;
    OutputFile* transient_file_ = nullptr;       // of the last transient; null before the first of the variant
    std::string rows_;                           // points that are not written yet, in the format of the file
    std::size_t point_count_ = 0;                // points so far, including those in rows_
    std::size_t count_offset_ = 0;               // position of the point count in a .raw file, bytes
    double newest_time_ = 0, written_time_ = 0;  // s: newest point; last point written to the file
    Clock::time_point last_write_;
    // All variants:
    bool has_streamed_ = false;        // true if a transient has delivered more than its first point
    bool has_complete_plots_ = false;  // true if an analysis other than a transient has delivered its plots

    bool is_transient() const { return !head_.curves.empty() && head_.curves[0].name == "time"; }
    Result<void> write_pending();
    /// Path of file `index`, from 0, of `file_count` files: x.csv if it is the only one, otherwise x-1.csv for index 0.
    std::string path_of(std::size_t file_count, std::size_t index) const;
    Result<OutputFile*> open(std::size_t file_count, std::size_t index, const std::string& head);

public:
    CurveFiles(const std::string& path, bool is_ascii, bool has_steps, bool overwrite)
        : path_(path), check_(overwrite), is_ascii_(is_ascii), has_steps_(has_steps), is_csv_(path.ends_with(".csv")) {}

    /// Call before the analyses of each variant. The first call checks that the files may be written.
    Result<void> begin_variant(const circuit::Variant&);
    Result<void> begin(const circuit::Plot& head) override;
    Result<void> add_point(const circuit::PlotRow& row) override;
    Result<void> end() override;

    /// Renames the finished files to their final names.
    Result<void> finish();
    /// Renames the files of an incomplete run to their final names. Returns a note that says in which variant and at what time they end, or
    /// "" if no file was kept. After a failure, files are kept only if they have points of a transient; after an interruption, also if they
    /// have a complete analysis.
    Result<std::string> finish_early(bool interrupted);
};

}  // namespace corpuscle
