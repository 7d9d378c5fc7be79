#pragma once
// Simulates the afferents of one input on all threads. Afferents share SIMD lanes if possible; the others are simulated alone.

#include "model/lane_population.hpp"
#include "study/afferent_run.hpp"
#include "study/lookahead_buffer.hpp"

namespace corpuscle {

class InputSimulator {
public:
    /// `wants_probes`: a sink wants probes; then every afferent is simulated alone, because lanes record no probes.
    static Result<InputSimulator> make(Input input, const RespondOptions& options, bool wants_probes);

    const Input& input() const { return input_; }
    /// Number of samples simulated so far, the same on each channel.
    std::int64_t samples() const { return samples_; }
    /// Warnings about afferents that left a valid range. There is one for each plan and range that was left; it names the channel that was
    /// outside for the longest time.
    std::vector<std::string> range_warnings() const;

    /// Simulates one block of all afferents and passes it to all sinks; returns false at the end of the source.
    Result<bool> simulate_block(ForceSource& source, std::span<ResponseSink* const> sinks, ThreadPool& pool, RunStats& stats);

private:
    /// Afferents that are packed together on SIMD lanes.
    struct LaneGroup {
        std::unique_ptr<LanePopulation> population;
        std::vector<std::uint32_t> afferents;  // indexes within the input, ascending
        bool shares_force;                     // all have the same force
    };
    /// An afferent that is simulated alone.
    struct ScalarAfferent {
        std::uint32_t afferent_index;
        State state;
        std::vector<Spike> spikes = {};
        std::int64_t truncated_steps = 0, saturated = 0, overflowed = 0, steps = 0, rejected = 0, iterations = 0;
        std::vector<RangeViolation> range_violations = {};  // for each of the afferent's ranges
        EnergyUse energy_use = {};
        std::optional<Error> error = {};
        bool diverged = false;  // a netlist that did not converge; it gives no more spikes
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
    Error with_afferent_name(Error error, std::size_t afferent_index) const;
    const double* force_of(std::size_t afferent_index) const { return force_.force[input_.channel_of(afferent_index)].data(); }

    Input input_;
    bool wants_probes_;
    Frames force_;
    LookaheadBuffer lookahead_;
    std::vector<std::unique_ptr<Afferent>> afferents_;  // for each plan; null if its afferents are on lanes
    std::vector<std::span<const Probe>> plan_probes_;   // for each plan; empty if its afferents are on lanes
    std::vector<LaneGroup> lane_groups_;
    std::vector<ScalarAfferent> scalars_;
    std::vector<Spike> spikes_;
    std::vector<std::vector<std::vector<double>>> probe_values_;  // [afferent of this input][probe][sample]; empty if no sink wants them
    std::int64_t samples_ = 0;
};

}  // namespace corpuscle
