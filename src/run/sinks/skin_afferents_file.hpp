#pragma once
// A file with the position and the response of every afferent of a skin.

#include "run/sinks/skin_file_sink.hpp"
#include "run/summary/skin_summary.hpp"

namespace corpuscle {

/// afferents.csv: afferent_index,afferent,region,x_mm,y_mm,delay_ms,spikes,first_spike_s,touched_s,rate_Hz. `afferent_index` is
/// Spike::afferent_index. delay_ms is the conduction delay, first_spike_s a time on the clock of the input, touched_s a duration. rate_Hz
/// is the number of spikes divided by the duration of the force. All values come from the summary, which must precede this file among the
/// sinks.
class SkinAfferentsFile final : public SkinFileSink {
    OutputFile file_;
    const SkinSummary& summary_;

public:
    SkinAfferentsFile(OutputFile file, const SkinSummary& summary) : file_(std::move(file)), summary_(summary) {}
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
