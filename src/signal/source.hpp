#pragma once
// Where force comes from: a stimulus or a recording, read in blocks of samples.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "signal/clock.hpp"
#include "signal/error.hpp"

namespace corpuscle {

/// Where a sensor sits; m, or as a layout file without a unit has it.
struct Position {
    double x = 0, y = 0, z = 0;
};

/// One stream of force. The id, the name and the position follow it to every output.
struct Channel {
    std::uint32_t id = 0;
    std::string name;  ///< from the file's header or the stimulus; else ch1, ch2 ...
    std::optional<Position> position = {};
};

/// A stretch of time with a name, [from, to) in seconds: the phases of the thesis's experiment.
struct Phase {
    std::string name;
    double from = 0, to = 0;
};

/// Something that a source was given: a stimulus's parameter, how a recording is read.
struct Fact {
    std::string name;
    double value = 0;
    std::string unit;
};

/// Something measured of how well a channel was recorded.
struct Finding {
    std::uint32_t channel = 0;
    std::string_view name;  ///< "hum", "strays"
    double value = 0;
    std::string_view unit;
};

/// How well a source was recorded: the numbers, the same in words, and what makes the answer doubtful.
struct Quality {
    std::vector<Finding> findings = {};
    std::vector<std::string> sentences = {}, warnings = {};
};

/// Samples of all channels over the same instants: force[channel][sample], newtons.
struct Frames {
    explicit Frames(std::size_t channels, std::size_t capacity) : force(channels, std::vector<double>(capacity)), capacity(capacity) {}
    std::vector<std::vector<double>> force;
    std::size_t capacity;
    std::size_t count = 0;  ///< samples filled
};

class Source {
public:
    virtual ~Source() = default;
    virtual const std::string& name() const = 0;
    virtual const Clock& clock() const = 0;
    virtual const std::vector<Channel>& channels() const = 0;
    /// How much of it has been read, 0 to 1; for progress.
    virtual double done() const = 0;
    virtual std::vector<Phase> phases() const { return {}; }
    /// How often it repeats itself, Hz; 0 if it does not.
    virtual double cycle() const { return 0; }
    /// What it is, in a few words.
    virtual std::string sentence() const = 0;
    virtual std::vector<Fact> facts() const { return {}; }
    /// What the user should know of how the source was read, in sentences.
    virtual std::vector<std::string> remarks() const { return {}; }
    /// How good what has been read so far is.
    virtual Quality quality() const { return {}; }
    /// Fills the next block; count 0 is the end.
    virtual Result<void> read(Frames&) = 0;
};

}  // namespace corpuscle
