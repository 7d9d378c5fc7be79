#pragma once
// Simulates the afferents of one input on all threads: on SIMD lanes if possible, otherwise one by one.

#include "model/lane_population.hpp"
#include "study/ahead.hpp"
#include "study/respond.hpp"

namespace corpuscle {

class Units {
public:
    /// `probed`: a sink wants probes; then the afferents are simulated one by one.
    static Result<Units> make(Input input, const RespondOptions& options, bool probed);

    const Input& input() const { return input_; }
    std::int64_t samples() const { return samples_; }
    /// Ranges that afferents left: one sentence for each range, for the channel that was outside longest.
    std::vector<std::string> outside() const;

    /// Simulates one block of all afferents and passes it to all sinks; returns false at the end of the source.
    Result<bool> answer_block(ForceSource& source, std::span<Listener* const> sinks, ThreadPool& pool, Work& stats);

private:
    /// Afferents that are packed together on SIMD lanes.
    struct Crowd {
        std::unique_ptr<LanePopulation> population;
        std::vector<std::uint32_t> units;  // indexes within the input, ascending
        bool one_channel;                  // all have the same force
    };
    /// An afferent that is simulated alone.
    struct Single {
        std::uint32_t unit;
        State state;
        std::vector<Spike> spikes = {};
        std::int64_t capped = 0, clipped = 0, overflowed = 0, steps = 0, rejected = 0, iterations = 0;
        std::vector<RangeViolation> outside = {};  // for each of the afferent's ranges
        EnergyUse spent = {};
        std::optional<Error> error = {};
        bool lost = false;  // a netlist that did not converge; it gives no more spikes
    };

    Units(Input input, std::size_t block, bool probed);
    Result<void> seat(const RespondOptions& options, InstructionSet set);
    Result<void> seat_crowds(std::span<const std::size_t> plans, const SimulationOptions& run, const RespondOptions& options, InstructionSet set);
    Result<void> answer_crowd(Crowd& group, ThreadPool& pool, Work& stats);
    void answer_single(Single& single);
    Result<void> answer_force(Single& single, ResponseBlock& response, std::span<double* const> probe_values);
    Result<void> answer_singles(ThreadPool& pool, Work& stats);
    std::pair<const Single*, std::size_t> longest_outside(std::size_t plan, std::size_t range) const;
    Error of_unit(Error error, std::size_t afferent_index) const;
    const double* force_of(std::size_t afferent_index) const { return force_.force[input_.channel_of(afferent_index)].data(); }

    Input input_;
    bool probed_;
    Frames force_;
    Ahead ahead_;
    std::vector<std::unique_ptr<Afferent>> afferents_;  // for each plan; null if its afferents are on lanes
    std::vector<std::span<const Probe>> probes_of_;
    std::vector<Crowd> crowds_;
    std::vector<Single> singles_;
    std::vector<Spike> spikes_;
    std::vector<std::vector<std::vector<double>>> shown_;
    std::int64_t samples_ = 0;
};

}  // namespace corpuscle
