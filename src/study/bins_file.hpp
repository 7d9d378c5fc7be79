#pragma once
// Spikes counted in even bins of time, written as the bins fill.

#include "study/bins.hpp"
#include "study/files.hpp"

namespace corpuscle {

/// psth.csv: afferent,channel,from_s,to_s,spikes,rate_Hz; bin after bin from an input's start, every unit in each. Bins as in bins.hpp.
class BinsFile final : public WrittenFile {
    OutputFile file_;
    double bin_;  // s
    EvenBins bins_;

public:
    BinsFile(OutputFile file, double bin);
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
