#pragma once
// Simulates the afferents on the channels of one input on the threads of a pool. Afferents are packed together on SIMD lanes if possible;
// the others are simulated individually, in double precision.

#include "run/channels/channel_population.hpp"
#include "run/channels/lookahead_buffer.hpp"
#include "run/run_inputs.hpp"
#include "run/simulate.hpp"

namespace corpuscle {

class ChannelSimulator final : public BlockSimulator {
public:
    /// The sources and the plans must outlive the simulator. `index`: of the source. `first_afferent`: see Input.
    ChannelSimulator(std::span<const std::unique_ptr<ForceSource>> sources, std::size_t index, std::span<const AfferentPlan> plans,
                     std::uint32_t first_afferent);

    Result<void> start(const RespondOptions&, bool wants_probes) override;
    const Input& input() const override { return input_; }
    Result<RunBlock> next(ThreadPool&, RunStats&) override;
    double progress() const override { return source_.progress(); }
    Result<void> finish(std::vector<Spike>&, RunStats&) override;

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
        std::optional<ResponseBlock> response = {};  // its probes are not valid after the block
        std::optional<Error> error = {};
        // Counted since the start of the input, for each of Afferent::ranges().
        std::vector<RangeViolation> range_violations = {};
        bool diverged = false;  // true for a netlist that did not converge; it gives no more spikes
    };

    Result<std::vector<bool>> place_on_lanes(const SimulationOptions& run, const RespondOptions& options, InstructionSet set);
    Result<void> make_lane_groups(std::span<const std::size_t> plans, const SimulationOptions& run, Precision, InstructionSet set);
    void make_scalar_afferents(const std::vector<bool>& is_scalar, const SimulationOptions& run);
    Result<void> simulate_lane_group(LaneGroup& group, ThreadPool& pool, RunStats& stats);
    void simulate_scalar(ScalarAfferent& scalar);
    Result<void> simulate_scalars(ThreadPool& pool, RunStats& stats);
    std::pair<const ScalarAfferent*, std::size_t> longest_violation(std::size_t plan, std::size_t range) const;
    std::vector<std::string> range_warnings() const;
    /// The error, preceded by the names of the afferent and its channel.
    Error with_afferent_name(Error error, std::size_t afferent_index) const;
    /// The force of the current block on the channel of this afferent.
    const double* force_of(std::size_t afferent_index) const { return force_.force[population_.channel_of(afferent_index)].data(); }

    ForceSource& source_;
    ChannelPopulation population_;
    Input input_;
    bool wants_probes_ = false;
    Frames force_{0, 0};                             // the current block
    std::vector<std::span<const double>> channels_;  // its force on each channel
    LookaheadBuffer lookahead_{0, 0};
    std::vector<std::unique_ptr<Afferent>> afferents_;  // for each plan: simulates it on every channel; null if its afferents are on lanes
    std::vector<LaneGroup> lane_groups_;
    std::vector<ScalarAfferent> scalars_;
    std::vector<Spike> spikes_;  // of the current block
    // [afferent of this input][probe][sample of the current block]; empty if no sink wants probes.
    std::vector<std::vector<std::vector<double>>> probe_values_;
    std::int64_t samples_ = 0;  // on each channel, before the current block
};

/// The simulators of all sources of a run, with one afferent of each plan on every channel.
std::vector<std::unique_ptr<BlockSimulator>> make_channel_simulators(std::span<const std::unique_ptr<ForceSource>>,
                                                                     std::span<const AfferentPlan> plans);

}  // namespace corpuscle
