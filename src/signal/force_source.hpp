#pragma once
// The interface of a source of force: a stimulus or a recording, read in blocks of samples.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signal/clock.hpp"
#include "signal/error.hpp"

namespace corpuscle {

/// Position of a sensor in m, or as written in the layout file if this has no unit of length.
struct Position {
    double x = 0, y = 0, z = 0;
};

/// One channel of force. Id, name and position appear in every output.
struct Channel {
    std::uint32_t id = 0;
    std::string name;  ///< from the file's header or the stimulus; otherwise ch1, ch2 ...
    std::optional<Position> position = {};
};

/// A named time window [from, to) in seconds, such as a phase of the thesis's experiment.
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
    std::uint32_t channel = 0;
    std::string_view name;  ///< such as "hum"
    double value = 0;
    std::string_view unit;
};

/// The recording quality of a source: metrics, descriptions of its faults, and warnings about faults that make the response doubtful.
struct RecordingQuality {
    std::vector<QualityMetric> metrics = {};
    std::vector<std::string> descriptions = {}, warnings = {};
};

/// A block of samples, at the same times for all channels: force[channel][sample], newtons.
struct Frames {
    explicit Frames(std::size_t channels, std::size_t capacity) : force(channels, std::vector<double>(capacity)), capacity(capacity) {}
    std::vector<std::vector<double>> force;
    std::size_t capacity;
    std::size_t count = 0;  ///< number of samples filled
};

class ForceSource {
public:
    virtual ~ForceSource() = default;
    virtual const std::string& name() const = 0;
    virtual const Clock& clock() const = 0;
    virtual const std::vector<Channel>& channels() const = 0;
    /// The fraction that has been read, 0 to 1, for a progress display.
    virtual double progress() const = 0;
    /// The phases of a stimulus; empty if it has none.
    virtual std::vector<Phase> phases() const { return {}; }
    /// Frequency of repetition, Hz; 0 if the force is not periodic.
    virtual double cycle_frequency() const { return 0; }
    /// A short description.
    virtual std::string description() const = 0;
    virtual std::vector<MetadataEntry> metadata() const { return {}; }
    /// Notes for the user about how the source was read.
    virtual std::vector<std::string> notes() const { return {}; }
    /// The recording quality of the part read so far.
    virtual RecordingQuality quality() const { return {}; }
    /// Fills the next block; a count of 0 marks the end.
    virtual Result<void> read(Frames&) = 0;
};

}  // namespace corpuscle
