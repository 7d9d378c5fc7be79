#pragma once
// Spikes counted in even bins of time, written as the bins fill.

#include "study/files.hpp"

namespace corpuscle {

/// psth.csv: afferent,channel,from_s,to_s,spikes,rate_Hz; bin after bin from an input's start, every unit in each; the last bin ends
/// with the input. A bin owns its start, not its end; a spike that misses an edge by less than 1e-9 of a bin stands on it.
class BinsFile final : public WrittenFile {
    OutputFile file_;
    double bin_;  // s
    Clock since_start_;
    double t0_ = 0;                  // s, of the input at work, by the clock of the spikes' file
    std::int64_t at_ = 0;            // the bin that fills
    std::vector<std::int64_t> now_;  // spikes in it, of each unit
    std::vector<std::string> names_;
    fmt::memory_buffer text_;

    std::int64_t bin_of(double t) const;
    void put(double to);
    void fill_up_to(std::int64_t bin);

public:
    BinsFile(OutputFile file, double bin);
    Result<void> begin(const Input&) override;
    Result<void> block(const Input&, const Answered&) override;
    Result<void> end(const Input&, std::int64_t samples) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
