#pragma once
// Position and response of every afferent of a skin, one row each.

#include "study/skin_file_sink.hpp"
#include "study/skin_summary.hpp"

namespace corpuscle {

/// afferents.csv: afferent_index,afferent,region,x_mm,y_mm,delay_ms,spikes,first_spike_s,touched_s,rate_Hz. `afferent_index` is
/// Spike::afferent_index; the rate is over the complete force. The counts come from the summary, which must precede this file among the
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
