#pragma once
// The interface of a source of force: a stimulus or a recording, read in blocks of samples.

#include <string_view>
#include <vector>

#include "core/clock.hpp"

namespace corpuscle {

/// Position of a sensor in m. If the layout file states no unit of length, the numbers are as in the file.
struct Position {
    double x = 0, y = 0, z = 0;
};

/// One channel of force.
struct Channel {
    std::uint32_t id = 0;                   ///< index of the channel in its source, counted from 0
    std::string name;                       ///< of the column in the file's header, or of the stimulus; otherwise ch1, ch2 ...
    std::optional<Position> position = {};  ///< of the channel's sensor, from the layout file
};

/// A named time window [from, to), in seconds from the start of the stimulus.
struct Phase {
    std::string name;
    double from = 0, to = 0;
};

/// A property of a source: a parameter of a stimulus, or an option with which a recording is read.
struct MetadataEntry {
    std::string name;
    double value = 0;
    std::string unit;
};

/// A measure of a channel's recording quality.
struct QualityMetric {
    std::uint32_t channel = 0;  ///< Channel::id
    std::string_view name;      ///< such as "hum"
    double value = 0;
    std::string_view unit;
};

/// The recording quality of a source: metrics, descriptions of its faults, and warnings about faults that make the response doubtful.
struct RecordingQuality {
    std::vector<QualityMetric> metrics = {};
    std::vector<std::string> descriptions = {}, warnings = {};
};

/// A block of consecutive samples of all channels: force[channel][sample], in newtons. All channels have the same sample times.
struct Frames {
    explicit Frames(std::size_t channels, std::size_t capacity, bool with_shear = false)
        : force(channels, std::vector<double>(capacity)), capacity(capacity) {
        if (with_shear) shear_x = shear_y = force;
    }
    std::vector<std::vector<double>> force;
    /// The tangential force of each channel, N; empty if the reader of the block does not want it. Only a source with has_shear() fills it.
    std::vector<std::vector<double>> shear_x = {}, shear_y = {};
    std::size_t capacity;   ///< samples of each channel for which there is memory
    std::size_t count = 0;  ///< number of samples that read() has filled, equal for all channels
};

/// A source of force. All its channels have the same clock.
class ForceSource {
public:
    virtual ~ForceSource() = default;
    virtual const std::string& name() const = 0;
    virtual const Clock& clock() const = 0;
    virtual const std::vector<Channel>& channels() const = 0;
    /// True if the channels are sensors with three axes: `force` is then their normal force, and read() fills the shear of a block that
    /// has it.
    virtual bool has_shear() const { return false; }
    /// True if the force was measured: it is read from a file.
    virtual bool is_recording() const { return false; }
    /// The fraction of the source that has been read, 0 to 1, for a progress display.
    virtual double progress() const = 0;
    /// The phases of a stimulus; empty if it has none.
    virtual std::vector<Phase> phases() const { return {}; }
    /// Frequency at which the force repeats, Hz; 0 if the force is not periodic.
    virtual double cycle_frequency() const { return 0; }
    /// A short description of the source for the user.
    virtual std::string description() const = 0;
    virtual std::vector<MetadataEntry> metadata() const { return {}; }
    /// Notes for the user about how the source was read.
    virtual std::vector<std::string> notes() const { return {}; }
    /// The recording quality of the part read so far.
    virtual RecordingQuality quality() const { return {}; }
    /// Reads the next samples, up to the capacity of the block, and sets its count. A count of 0 marks the end of the source.
    virtual Result<void> read(Frames&) = 0;
};

/// Reads a source to its end: the force of its first channel, N.
inline Result<std::vector<double>> read_channel(ForceSource& source) {
    std::vector<double> out;
    for (Frames block(source.channels().size(), 4096);;) {
        TRY(source.read(block));
        if (block.count == 0) return out;
        out.insert(out.end(), block.force[0].begin(), block.force[0].begin() + static_cast<std::ptrdiff_t>(block.count));
    }
}

}  // namespace corpuscle
