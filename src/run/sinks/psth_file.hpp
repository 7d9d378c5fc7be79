#pragma once
// Counts spikes in time bins of equal width and writes each bin as it completes.

#include "run/sinks/file_sinks.hpp"
#include "run/sinks/time_bins.hpp"

namespace corpuscle {

/// psth.csv: afferent,channel,from_s,to_s,spikes,rate_Hz. One line for each afferent, bin after bin from the start of the input. from_s and
/// to_s are on the clock of the input. For the edges of bins, see time_bins.hpp.
class PsthFile final : public FileSink {
    OutputFile file_;
    double bin_width_;  // s
    TimeBins bins_;

public:
    PsthFile(OutputFile file, double bin_width);
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
