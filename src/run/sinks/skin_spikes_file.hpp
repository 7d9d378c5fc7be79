#pragma once
// Spikes of a skin as text, written block by block.

#include <fmt/format.h>

#include "run/sinks/skin_file_sink.hpp"

namespace corpuscle {

/// spikes.csv: afferent,channel,time_s, as in SpikesFile; the channel is the region. In order of time. Times are on the clock of the force,
/// to the nanosecond.
class SkinSpikesFile final : public SkinFileSink {
    OutputFile file_;
    std::vector<std::string> names_and_regions_;  // of each afferent: "sa1#17,palm"
    fmt::memory_buffer text_;

    Result<void> put(const Clock&, std::span<const Spike>);

public:
    explicit SkinSpikesFile(OutputFile file);
    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinRunBlock&) override;
    Result<void> end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) override;
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
