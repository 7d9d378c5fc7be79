#pragma once
// The boundary everything stands on: an afferent answers a block of force with spikes. Virtual once a block.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signal/error.hpp"
#include "signal/spike.hpp"

namespace corpuscle {

/// An inner quantity that an afferent can show: a component of its current, its membrane.
struct Probe {
    std::string_view name, unit;
};

/// All that an afferent carries from block to block. Copy it to try twice; pack it to resume elsewhere.
struct State {
    std::string format;          ///< what the values mean, with its version: "sa1b+lif-b/1"
    std::int64_t step = 0;       ///< samples answered so far
    std::vector<double> values;  ///< SI
};

std::vector<std::byte> pack(const State&);
Result<State> unpack(std::span<const std::byte>);

/// Where an afferent puts its answer.
struct Answer {
    std::vector<Spike>& spikes;  ///< appended in time order; the unit is the caller's
    std::uint32_t unit = 0;
    /// If not empty: one array a probe, each as long as the block of force, to be filled.
    std::span<double* const> probes = {};
    std::int64_t capped = 0;      ///< steps whose spikes were more than the cap allows
    std::int64_t clipped = 0;     ///< samples beyond what a sensor's electronics or a converter can tell
    std::int64_t overflowed = 0;  ///< results too large for a digital afferent's words, kept at the largest
};

/// Which of several channels that share their electronics: a converter takes them in turn.
struct Turn {
    std::uint32_t channel = 0, of = 1;
};

/// The place of the first number that is infinite or none; the size if there is none such.
std::size_t first_not_finite(std::span<const double>);

/// Refuses a state that is another afferent's, and a force that is not finite.
Result<void> check_block(std::string_view name, std::string_view format, std::size_t values, const State&, std::span<const double> force);

class Afferent {
public:
    Afferent() = default;
    Afferent(const Afferent&) = delete;
    Afferent& operator=(const Afferent&) = delete;
    virtual ~Afferent() = default;
    virtual std::span<const Probe> probes() const = 0;
    /// The state before the first sample. The first sample also sets the force that went before it.
    virtual State start(Turn = {}) const = 0;
    /// Answers the next block (force in newtons, one sample a T). Blocks of any size give the same spikes.
    virtual Result<void> respond(std::span<const double> force, State&, Answer&) const = 0;
};

}  // namespace corpuscle
