// Simulates the afferents on the channels of one input on the threads of a pool. Afferents are packed together on SIMD lanes if possible;
// the others are simulated individually, in double precision.

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "run/channels/channel_population.hpp"
#include "run/channels/channel_warnings.hpp"
#include "run/channels/lookahead_buffer.hpp"
#include "run/interruption.hpp"
#include "run/run_inputs.hpp"
#include "run/simulate.hpp"

namespace corpuscle {
namespace {

/// Smallest number of afferents of one group for which SIMD lanes are used; with fewer, most lanes would be empty.
constexpr std::size_t min_lane_group = 4;

/// Number of samples per block: options.block, or fewer, to limit the memory for force or probes to about 64 MB (max_values numbers), and
/// to report progress often enough with very many afferents (max_steps samples, summed over the afferents). `probes_per_afferent` is an
/// estimate.
std::size_t block_size(const ChannelPopulation& population, const RespondOptions& options, bool wants_probes) {
    constexpr std::size_t max_values = std::size_t{1} << 23, max_steps = std::size_t{1} << 28, probes_per_afferent = 8;
    const std::size_t values = wants_probes ? population.size() * probes_per_afferent : population.channels();
    return std::clamp<std::size_t>(std::min(max_values / (values + 1), max_steps / (population.size() + 1)), 1, options.block);
}

/// Plans with equal keys can share SIMD lanes: they have the same components and the same values of the parameters that lanes must share.
std::string lane_key(const AfferentPlan& plan) {
    std::string key = plan.composition();
    for (std::size_t k = 0; k < plan.values.size(); ++k)
        if ((*plan.parameters)[k].info.is_shared_by_copies) key += fmt::format(" {}", plan.values[k]);
    return key;
}

/// The name of source n of a run. If earlier sources have the same name, a number is appended: "press (2)".
std::string unique_name(std::span<const std::unique_ptr<ForceSource>> sources, std::size_t n) {
    int same = 1;
    for (std::size_t k = 0; k < n; ++k) same += sources[k]->name() == sources[n]->name();
    return same == 1 ? sources[n]->name() : fmt::format("{} ({})", sources[n]->name(), same);
}

class ChannelSimulator final : public BlockSimulator {
public:
    /// The sources and the plans must outlive the simulator. `index`: of the source. `first_afferent`: see Input.
    ChannelSimulator(std::span<const std::unique_ptr<ForceSource>> sources, std::size_t index, std::span<const AfferentPlan> plans,
                     std::uint32_t first_afferent)
        : source_(*sources[index]), population_(source_, plans, unique_name(sources, index), sources.size() == 1),
          input_(make_input(population_, unique_name(sources, index), source_)) {
        input_.first_afferent = first_afferent, input_.index = index, input_.input_count = sources.size();
    }

    Result<void> start(const RespondOptions& options, bool wants_probes) override {
        const auto set = TRY(instruction_set());
        wants_probes_ = wants_probes, should_continue_ = options.should_continue;
        force_ = Frames(population_.channels(), block_size(population_, options, wants_probes));
        const auto run = options.for_clock(input_.clock);
        const auto is_scalar = TRY(place_on_lanes(run, options, set));
        make_scalar_afferents(is_scalar, run);
        return {};
    }

    const Input& input() const override { return input_; }

    Result<RunBlock> next(ThreadPool& pool, RunStats& stats) override {
        interruption_.begin([this, done = completed_fraction(input_, source_.progress())] { return should_continue_(done); });
        TRY(lookahead_.next(source_, force_));
        if (force_.count == 0) return RunBlock{};
        spikes_.clear();
        for (auto& group : lane_groups_) TRY(simulate_lane_group(group, pool, stats));
        TRY(simulate_scalars(pool, stats));
        if (!std::is_sorted(spikes_.begin(), spikes_.end())) std::sort(spikes_.begin(), spikes_.end());
        const auto first = samples_, steps = static_cast<std::int64_t>(force_.count);
        samples_ += steps;
        stats.samples += steps * static_cast<std::int64_t>(population_.channels());
        stats.afferent_steps += steps * static_cast<std::int64_t>(population_.size());
        stats.spikes += static_cast<std::int64_t>(spikes_.size());
        channels_.clear();
        for (const auto& channel : force_.force) channels_.emplace_back(channel.data(), force_.count);
        return RunBlock{first, force_.count, channels_, {}, spikes_, probe_values_};
    }

    double progress() const override { return source_.progress(); }

    Result<void> finish(std::vector<Spike>&, RunStats& stats) override {
        input_.quality = source_.quality();
        for (auto& warning : range_warnings()) stats.range_warnings.push_back(std::move(warning));
        return {};
    }

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

    /// Decides for each plan whether its afferents use lanes, and makes the lane groups. Returns for each plan whether its afferents are
    /// simulated individually. Single precision needs lanes.
    Result<std::vector<bool>> place_on_lanes(const SimulationOptions& run, const RespondOptions& options, InstructionSet set) {
        const auto plans = population_.plans();
        const bool in_float = options.precision == Precision::single_precision;
        if (in_float && set == InstructionSet::scalar) return bad_usage("float needs SIMD lanes: CORPUSCLE_ISA=scalar has none");
        std::vector<bool> is_scalar(plans.size());
        std::map<std::string, std::vector<std::size_t>> groups;  // of plans that can share lanes, by their keys
        for (std::size_t k = 0; k < plans.size(); ++k) {
            if (can_use_lanes(plans[k], run))
                groups[lane_key(plans[k])].push_back(k);
            else
                is_scalar[k] = true;
        }
        const auto scalar = static_cast<std::size_t>(std::find(is_scalar.begin(), is_scalar.end(), true) - is_scalar.begin());
        if (in_float && (wants_probes_ || scalar < plans.size()))
            return bad_usage(wants_probes_
                                 ? "float precision cannot record probes: remove --float, or --probe and --probe-files"
                                 : fmt::format("{}: {} cannot run in float", plans[scalar].name, plans[scalar].traits().lane_obstacles));
        for (const auto& [key, group] : groups) {
            if (!in_float && (wants_probes_ || set == InstructionSet::scalar || group.size() * population_.channels() < min_lane_group))
                for (const auto k : group) is_scalar[k] = true;
            else
                TRY(make_lane_groups(group, run, options.precision, set));
        }
        return is_scalar;
    }

    /// Makes one lane population for all channels or, if there are at least as many plans as channels, one population for each channel,
    /// whose afferents then share their force.
    Result<void> make_lane_groups(std::span<const std::size_t> plans, const SimulationOptions& run, Precision precision,
                                  InstructionSet set) {
        const std::size_t channels = population_.channels(), plan_count = population_.plans().size();
        const bool by_channel = plans.size() >= channels;
        LaneGroup group{{}, {}, by_channel};
        std::vector<const AfferentPlan*> lane_plans;
        for (std::size_t c = 0; c < channels; ++c) {
            for (const auto k : plans) {
                group.afferents.push_back(static_cast<std::uint32_t>(c * plan_count + k));
                // PopulationPlan::plans has one plan for all afferents, or one for each of them.
                if (plans.size() > 1) lane_plans.push_back(&population_.plans()[k]);
            }
            if (!by_channel && c + 1 < channels) continue;
            if (plans.size() == 1) lane_plans = {&population_.plans()[plans[0]]};
            std::vector<std::uint32_t> indexes;
            for (const auto u : group.afferents) indexes.push_back(input_.first_afferent + u);
            group.population = TRY(make_lane_population({lane_plans, group.afferents.size(), indexes, precision}, run, set));
            lane_groups_.push_back(std::exchange(group, {{}, {}, by_channel}));
            lane_plans.clear();
        }
        return {};
    }

    void make_scalar_afferents(const std::vector<bool>& is_scalar, const SimulationOptions& run) {
        const auto plans = population_.plans();
        const auto channels = population_.channels();
        afferents_.resize(plans.size());
        std::vector<std::span<const Probe>> probes(plans.size());
        std::int64_t delay = 0;
        for (std::size_t k = 0; k < plans.size(); ++k) {
            if (!is_scalar[k]) continue;
            afferents_[k] = make_afferent(plans[k], run), probes[k] = afferents_[k]->probes();
            delay = std::max(delay, afferents_[k]->delay());
        }
        population_.set_probes(std::move(probes));
        lookahead_ = LookaheadBuffer(channels, static_cast<std::size_t>(delay));
        for (std::size_t u = 0; u < population_.size(); ++u) {
            if (wants_probes_) probe_values_.emplace_back(population_.probes(u).size(), std::vector<double>(force_.capacity));
            const auto* afferent = afferents_[u % plans.size()].get();
            if (!afferent) continue;
            const ChannelSlot slot{static_cast<std::uint32_t>(population_.channel_of(u)), static_cast<std::uint32_t>(channels)};
            scalars_.push_back({static_cast<std::uint32_t>(u), AfferentSimulation(*afferent, slot)});
            scalars_.back().range_violations.resize(afferent->ranges().size());
        }
    }

    Result<void> simulate_lane_group(LaneGroup& group, ThreadPool& pool, RunStats& stats) {
        std::vector<const double*> columns;
        PopulationForce force;
        if (group.shares_force) {
            force = ForceProfile{{force_of(group.afferents[0]), force_.count}};
        } else {
            for (const auto u : group.afferents) columns.push_back(force_of(u));
            force = ForceColumns{columns};
        }
        PopulationResponse response{&spikes_};
        if (auto ok = group.population->respond(force, force_.count, response, pool); !ok)
            return with_afferent_name(ok.error(), group.afferents[response.failed_afferent]);
        stats.truncated_steps += response.truncated_steps;
        return {};
    }

    /// Simulates an afferent for one block. The probes of a netlist that did not converge are NaN from the next block on. `thread`: index
    /// of this thread in the pool.
    void simulate_scalar(ScalarAfferent& scalar, unsigned thread) {
        const std::size_t u = scalar.afferent_index;
        std::vector<double*> probe_values;
        if (wants_probes_)
            for (auto& p : probe_values_[u]) probe_values.push_back(p.data());
        const auto delay = static_cast<std::size_t>(afferents_[u % afferents_.size()]->delay());
        const auto force =
            delay > 0 ? lookahead_.samples(population_.channel_of(u), force_.count + delay) : std::span(force_of(u), force_.count);
        scalar.spikes.clear();
        auto& response = scalar.response.emplace(
            ResponseBlock{scalar.spikes, input_.first_afferent + scalar.afferent_index, probe_values, scalar.range_violations});
        response.should_stop = [this, thread] { return thread == 0 ? interruption_.ask() : interruption_.is_stopped(); };
        if (scalar.diverged)
            for (double* p : probe_values) std::fill_n(p, force_.count, std::numeric_limits<double>::quiet_NaN());
        else if (auto ok = scalar.simulation.respond(force, response); !ok)
            scalar.error = with_afferent_name(ok.error(), u);
    }

    Result<void> simulate_scalars(ThreadPool& pool, RunStats& stats) {
        pool.for_each(
            scalars_.size(), [this](std::size_t k, unsigned thread) { simulate_scalar(scalars_[k], thread); },
            [this] { interruption_.ask(); });
        interruption_.rethrow();
        if (interruption_.is_stopped()) return interrupted_error();
        for (auto& s : scalars_) {
            // An afferent whose solver may diverge is left out from now on if it does; any other error ends the run.
            if (s.error && !(s.error->code == ErrorCode::not_converged && population_.plan_of(s.afferent_index).traits().may_diverge))
                return *s.error;
            if (s.error) s.diverged = true, stats.diverged.push_back(*std::exchange(s.error, {}));
            spikes_.insert(spikes_.end(), s.spikes.begin(), s.spikes.end());
            const auto& r = *s.response;
            stats.truncated_steps += r.truncated_steps, stats.saturated += r.saturated, stats.overflowed += r.overflowed;
            stats.steps += r.steps, stats.rejected += r.rejected_steps, stats.iterations += r.newton_iterations;
            stats.energy_use.resize(afferents_.size());
            stats.energy_use[s.afferent_index % afferents_.size()] += r.energy_use;
        }
        return {};
    }

    /// Among the afferents of one plan, one for each channel: the one that was outside a range for the longest time, null if none was; and
    /// the number of afferents that were outside it.
    std::pair<const ScalarAfferent*, std::size_t> longest_violation(std::size_t plan, std::size_t range) const {
        const ScalarAfferent* longest = nullptr;
        std::size_t count = 0;
        for (const auto& s : scalars_) {
            if (s.afferent_index % afferents_.size() != plan || s.range_violations[range].samples == 0) continue;
            ++count;
            if (!longest || s.range_violations[range].samples > longest->range_violations[range].samples) longest = &s;
        }
        return {longest, count};
    }

    std::vector<std::string> range_warnings() const {
        std::vector<std::string> warnings;
        for (std::size_t plan = 0; plan < afferents_.size(); ++plan) {
            const auto ranges = afferents_[plan] ? afferents_[plan]->ranges() : std::span<const ValidRange>{};
            for (std::size_t r = 0; r < ranges.size(); ++r) {
                const auto [scalar, count] = longest_violation(plan, r);
                if (!scalar) continue;
                warnings.push_back(range_warning(population_.plans()[plan].name, population_.channel_name(scalar->afferent_index),
                                                 ranges[r], scalar->range_violations[r], samples_, input_.clock) +
                                   (count > 1 ? fmt::format(" (and on {} other channels, for at most as long)", count - 1) : ""));
            }
        }
        return warnings;
    }

    /// The error, preceded by the names of the afferent and its channel.
    Error with_afferent_name(Error error, std::size_t afferent_index) const {
        error.message =
            fmt::format("{} on {}: {}", population_.plan_of(afferent_index).name, population_.channel_name(afferent_index), error.message);
        return error;
    }

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
    std::function<bool(double)> should_continue_;
    Interruption interruption_;
};

}  // namespace

std::vector<std::unique_ptr<BlockSimulator>> make_channel_simulators(std::span<const std::unique_ptr<ForceSource>> sources,
                                                                     std::span<const AfferentPlan> plans) {
    std::vector<std::unique_ptr<BlockSimulator>> simulators;
    std::uint32_t first_afferent = 0;
    for (std::size_t k = 0; k < sources.size(); ++k) {
        simulators.push_back(std::make_unique<ChannelSimulator>(sources, k, plans, first_afferent));
        first_afferent += static_cast<std::uint32_t>(simulators.back()->input().population.size());
    }
    return simulators;
}

}  // namespace corpuscle
