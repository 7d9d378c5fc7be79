#pragma once

#include <chrono>
#include <deque>

#include "circuit/raw.hpp"
#include "circuit/run.hpp"
#include "circuit/variants.hpp"
#include "io/output.hpp"
#include "io/output_check.hpp"
#include "verbs.hpp"

namespace corpuscle {

/// Where curves go as they come: a .raw file of all, or a table for each analysis, x.csv or x-1.csv, x-2.csv ..., whose rows begin with
/// the step they belong to, if there are several. A transient's points are written in blocks; the files can be read at any moment.
class CurveFiles final : public circuit::CurveSink {
    using Clock = std::chrono::steady_clock;
    const RunWords& words_;
    OutputCheck check_;
    bool several_, csv_;
    std::deque<OutputFile> files_;  // where each is stays the same
    std::string title_, label_;
    std::size_t analyses_ = 0, plots_ = 0;  // of the variant at work: how many analyses; plots so far
    // of the transient at work:
    OutputFile* file_ = nullptr;
    std::string rows_;  // not written yet
    std::size_t points_ = 0, count_at_ = 0;
    double time_ = 0, written_to_ = 0;  // of the newest point; of the last that is in the file
    Clock::time_point written_;
    bool streamed_ = false;   // a transient has come beyond its first point
    bool has_whole_ = false;  // some analysis was whole

    Result<void> write_out();
    Result<void> table(const circuit::Plot&, std::size_t count);
    std::string path_of(std::size_t count, std::size_t k) const;
    Result<OutputFile*> open(std::size_t count, std::size_t k, const std::string& head);

public:
    CurveFiles(const RunWords& words, bool several, bool overwrite)
        : words_(words), check_(overwrite), several_(several), csv_(words.out.ends_with(".csv")) {}

    /// Whether the files of a netlist with so many analyses may be written; before it runs.
    Result<void> check(std::size_t analysis_count) const;
    void next(const circuit::Variant&);
    Result<void> whole(std::span<const circuit::Plot>) override;
    Result<void> begin(const circuit::Plot& head) override;
    Result<void> point(std::span<const double> row) override;
    Result<void> end() override;

    /// Puts the files in their places.
    Result<void> finish();
    /// The same of a run that was broken off; a remark that says where, or "" if there is nothing to keep: of one that failed, rather than
    /// was interrupted, a transient's points are worth it.
    Result<std::string> finish_early(bool interrupted);
};

}  // namespace corpuscle
