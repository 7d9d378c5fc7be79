#pragma once
// Simulates the afferents of one input on the threads of a pool. Afferents are packed together on SIMD lanes if possible; the others are
// simulated individually, in double precision.

#include "model/lane_population.hpp"
#include "run/afferent_run.hpp"
#include "run/lookahead_buffer.hpp"
#include "run/simulate.hpp"

namespace corpuscle {

class InputSimulator {
public:
    /// `wants_probes`: true if a sink wants probes. Then no afferent uses lanes, because lanes record no probes.
    static Result<InputSimulator> make(Input input, const RespondOptions& options, bool wants_probes);

    const Input& input() const { return input_; }
    /// Number of samples simulated so far, the same on each channel.
    std::int64_t samples() const { return samples_; }
    /// Warnings about quantities that were outside their valid range. There is one warning for each plan and range; it names the channel on
    /// which the quantity was outside for the longest time.
    std::vector<std::string> range_warnings() const;

    /// Reads the next block of the source, simulates all afferents and passes the response to all sinks. Returns false at the end of the
    /// source.
    Result<bool> simulate_block(ForceSource& source, std::span<ResponseSink* const> sinks, ThreadPool& pool, RunStats& stats);

private:
    /// Afferents that are packed together on SIMD lanes.
    struct LaneGroup {
        std::unique_ptr<LanePopulation> population;
        std::vector<std::uint32_t> afferents;  // indexes within the input, from 0, ascending
        bool shares_force;                     // true if all its afferents are on one channel
    };
    /// An afferent that is not on lanes.
    struct ScalarAfferent {
        std::uint32_t afferent_index;  // within the input, from 0
        AfferentSimulation simulation;
        // The following values are those of the last block.
        std::vector<Spike> spikes = {};
        std::int64_t truncated_steps = 0, saturated = 0, overflowed = 0, steps = 0, rejected = 0, iterations = 0;  // as in RunStats
        EnergyUse energy_use = {};
        std::optional<Error> error = {};
        // Counted since the start of the input, for each of Afferent::ranges().
        std::vector<RangeViolation> range_violations = {};
        bool diverged = false;  // true for a netlist that did not converge; it gives no more spikes
    };

    InputSimulator(Input input, std::size_t block, bool wants_probes);
    Result<void> place_afferents(const RespondOptions& options, InstructionSet set);
    Result<void> place_on_lanes(std::span<const std::size_t> plans, const SimulationOptions& run, const RespondOptions& options,
                                InstructionSet set);
    Result<void> simulate_lane_group(LaneGroup& group, ThreadPool& pool, RunStats& stats);
    void simulate_scalar(ScalarAfferent& scalar);
    Result<void> respond_to_force(ScalarAfferent& scalar, ResponseBlock& response, std::span<double* const> probe_values);
    Result<void> simulate_scalars(ThreadPool& pool, RunStats& stats);
    std::pair<const ScalarAfferent*, std::size_t> longest_violation(std::size_t plan, std::size_t range) const;
    /// The error, preceded by the names of the afferent and its channel.
    Error with_afferent_name(Error error, std::size_t afferent_index) const;
    /// The force of the current block on the channel of this afferent.
    const double* force_of(std::size_t afferent_index) const { return force_.force[input_.channel_of(afferent_index)].data(); }

    Input input_;
    bool wants_probes_;
    Frames force_;  // the current block
    LookaheadBuffer lookahead_;
    std::vector<std::unique_ptr<Afferent>> afferents_;  // for each plan: simulates it on every channel; null if its afferents are on lanes
    std::vector<std::span<const Probe>> plan_probes_;   // for each plan; empty if its afferents are on lanes
    std::vector<LaneGroup> lane_groups_;
    std::vector<ScalarAfferent> scalars_;
    std::vector<Spike> spikes_;  // of the current block
    // [afferent of this input][probe][sample of the current block]; empty if no sink wants probes.
    std::vector<std::vector<std::vector<double>>> probe_values_;
    std::int64_t samples_ = 0;  // on each channel, before the current block
};

}  // namespace corpuscle
