#pragma once
// Every source of force through every afferent, block by block.

#include <functional>
#include <memory>
#include <vector>

#include "model/population.hpp"
#include "signal/source.hpp"

namespace corpuscle {

/// One source with one afferent on each of its channels. A unit is an afferent on a channel:
/// unit = first_unit + channel * afferents + afferent.
struct Input {
    const Source& source;
    std::string name;  ///< the source's; a second of the same name is "press (2)"
    std::span<const AfferentPlan> afferents;
    std::span<const std::span<const Probe>> probes;  ///< of each afferent; empty where nobody wants them and it is on lanes
    std::uint32_t first_unit = 0;
    std::size_t index = 0, of = 1;  ///< which input this is, of how many

    std::size_t units() const { return source.channels().size() * afferents.size(); }
    const AfferentPlan& afferent_of(std::size_t unit) const { return afferents[unit % afferents.size()]; }
    std::size_t channel_of(std::size_t unit) const { return unit / afferents.size(); }
    /// The channel as outputs call it: its name, with the source's before it if there are several sources.
    std::string channel_name(std::size_t channel) const;
};

/// What one block of force gave.
struct Answered {
    std::int64_t first = 0;  ///< number of the block's first sample
    const Frames& force;
    std::span<const Spike> spikes;                                ///< of all units, in order of time, then unit
    const std::vector<std::vector<std::vector<double>>>& probes;  ///< [unit of this input][probe][sample]; empty if nobody wants them
};

/// Takes what comes: a file, a table, a page. Whatever it refuses ends the run.
class Listener {
public:
    virtual ~Listener() = default;
    virtual bool wants_probes() const { return false; }
    virtual Result<void> begin(const Input&) { return {}; }
    virtual Result<void> block(const Input&, const Answered&) { return {}; }
    virtual Result<void> end(const Input&, std::int64_t /*samples*/) { return {}; }
};

struct Work {
    std::int64_t samples = 0;         ///< of force, over all channels
    std::int64_t afferent_steps = 0;  ///< samples times afferents
    std::int64_t spikes = 0;
    std::int64_t capped_steps = 0;                         ///< steps cut short by the cap on spikes a step
    std::int64_t clipped = 0;                              ///< samples beyond a sensor's electronics or converter
    std::int64_t overflowed = 0;                           ///< results too large for a digital afferent's words
    std::int64_t steps = 0, rejected = 0, iterations = 0;  ///< of circuits: in time, those taken again, and Newton's
    std::vector<std::string> outside;                      ///< what did not stay where an afferent works as designed
    std::vector<Spent> spent;  ///< of each afferent that is a circuit, over its channels; empty if none goes alone
    std::vector<Error> lost;   ///< a netlist that did not converge, and when: it said no more on its channel
};

struct RespondOptions {
    Method method = Method::exact;
    bool sampled = false;
    double noise = 0;        ///< of every membrane: see Run
    std::uint64_t seed = 0;  ///< of the noise
    Precision precision = Precision::in_double;
    Pool* pool = nullptr;      ///< threads; the answer does not depend on it; null: the caller's alone
    std::size_t block = 4096;  ///< samples; the answer does not depend on it
    /// Called once a block with the share done, 0 to 1; false stops the run.
    std::function<bool(double)> keep_on = [](double) { return true; };
};

/// Runs all sources through all afferents. Stopped by keep_on, it is an error of code `interrupted`.
Result<Work> respond(std::span<const std::unique_ptr<Source>> sources, std::span<const AfferentPlan> afferents,
                     std::span<Listener* const> listeners, const RespondOptions&);

/// What the user should know of noise: whom it does not reach.
std::vector<std::string> noise_warnings(std::span<const AfferentPlan> afferents, double noise);

/// What the user should know of the answer: what was cut short, clipped or too large for its words.
std::vector<std::string> work_warnings(const Work&);

/// What the user should know before trusting the answer: a rate too low for an afferent.
std::vector<std::string> rate_warnings(std::span<const std::unique_ptr<Source>> sources, std::span<const AfferentPlan> afferents);

}  // namespace corpuscle
