#pragma once
// Spikes of a skin's classes counted in even bins of time, written as the bins fill.

#include "study/bins.hpp"
#include "study/skin_written.hpp"

namespace corpuscle {

/// psth.csv: afferent,channel,units,from_s,to_s,spikes,rate_Hz; a class in a region is a row, bin after bin. The rate is of one unit:
/// spikes by units and seconds. Bins as in bins.hpp.
class SkinBinsFile final : public SkinWrittenFile {
    OutputFile file_;
    double bin_;  // s
    EvenBins bins_;
    std::vector<std::uint32_t> row_of_;  // of each unit

public:
    SkinBinsFile(OutputFile file, double bin);
    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinAnswered&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
