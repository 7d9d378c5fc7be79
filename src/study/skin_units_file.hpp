#pragma once
// Every unit of a skin, where it is and what it said: a row a unit.

#include "study/skin_summary.hpp"
#include "study/skin_written.hpp"

namespace corpuscle {

/// units.csv: unit,afferent,region,x_mm,y_mm,delay_ms,spikes,first_spike_s,touched_s,rate_Hz. `unit` is the number that spikes have, the
/// rate is over the whole force. Of what the summary counted, which stands before it among the listeners.
class SkinUnitsFile final : public SkinWrittenFile {
    OutputFile file_;
    const SkinSummary& summary_;

public:
    SkinUnitsFile(OutputFile file, const SkinSummary& summary) : file_(std::move(file)), summary_(summary) {}
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
