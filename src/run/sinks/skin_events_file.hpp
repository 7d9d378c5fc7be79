#pragma once
// Spikes of a skin as events (doc/events.md), written block by block.

#include "io/spikes/events.hpp"
#include "run/sinks/skin_file_sink.hpp"

namespace corpuscle {

class SkinEventsFile final : public SkinFileSink {
    OutputFile file_;
    std::string format_name_;
    std::unique_ptr<EventFormat> format_;
    std::string bytes_;  // of the current block

    Result<void> put(std::span<const Spike>);

public:
    /// `format`: the name of one of event_formats().
    SkinEventsFile(OutputFile file, std::string format) : file_(std::move(file)), format_name_(std::move(format)) {}
    Result<void> begin(const SkinInput&) override;
    Result<void> block(const SkinInput&, const SkinRunBlock& block) override { return put(block.spikes); }
    Result<void> end(const SkinInput&, std::int64_t, std::span<const Spike> last) override { return put(last); }
    std::vector<std::string> paths() const override { return {file_.path()}; }
    Result<void> commit() override { return file_.commit(); }
};

}  // namespace corpuscle
