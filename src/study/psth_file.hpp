#pragma once
// Counts spikes in time bins of equal width and writes each bin as it completes.

#include "study/file_sinks.hpp"
#include "study/time_bins.hpp"

namespace corpuscle {

/// psth.csv: afferent,channel,from_s,to_s,spikes,rate_Hz. Bins in order from the input's start, with a line for each afferent. Bins as in
/// time_bins.hpp.
class PsthFile final : public FileSink {
    OutputFile file_;
    double bin_width_;  // s
    TimeBins bins_;

public:
    PsthFile(OutputFile file, double bin);
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const RunBlock&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
