// spikes.csv: afferent,channel,time_s; input after input, each in order of time. Times are on the clock of the input, to the nanosecond.

#include "run/sinks/file_sink.hpp"
#include "run/sinks/spike_lines.hpp"

namespace corpuscle {
namespace {

class SpikesFile final : public SpikeFileSink {
    std::vector<std::string> names_;  // "sa1,press" of each afferent of the current input
    fmt::memory_buffer text_;

    Result<void> add(const Input& input, std::span<const Spike> spikes) override {
        for (const auto& s : spikes) append_spike_line(text_, names_[input.afferent_of(s)], s, input.clock);
        return write_text(text_);
    }

public:
    using SpikeFileSink::SpikeFileSink;
    Result<void> open() {
        TRY(create("spikes.csv"));
        return files_[0].write(spike_lines_heading);
    }
    Result<void> begin(const Input& input) override {
        names_ = afferent_csv_names(input.population);
        return {};
    }
};

}  // namespace

extern const OutputFormat spikes_format = {
    .names = {"spikes.csv"},
    .make = make_file_sink<SpikesFile>,
    .is_written = [](const OutputRequest& request) { return !request.has("--events"); },
};

}  // namespace corpuscle
