#pragma once
// Counts the spikes of each class in each region of a skin in time bins of equal width, and writes each bin as it completes.

#include "run/sinks/skin_file_sink.hpp"
#include "run/sinks/time_bins.hpp"

namespace corpuscle {

/// psth.csv: afferent,channel,afferents,from_s,to_s,spikes,rate_Hz. `channel` is the region. One row for each class in
/// each region, bin after bin. The rate is the mean over the afferents: spikes divided by their number and the bin width. For the edges of
/// bins, see time_bins.hpp.
class SkinPsthFile final : public SkinFileSink {
    OutputFile file_;
    double bin_width_;  // s
    TimeBins bins_;
    std::vector<std::uint32_t> group_of_;  // for each afferent: the index of its class and region among the rows of a bin

public:
    SkinPsthFile(OutputFile file, double bin_width);
    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinRunBlock&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
