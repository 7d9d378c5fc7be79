#include "study/input_simulator.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <utility>

namespace corpuscle {
namespace {

/// Smallest number of afferents for which SIMD lanes are used; with fewer, most lanes are empty.
constexpr std::size_t min_lane_group = 4;

/// Uses shorter blocks if there are many channels, or many afferents with probes: about 64 MB of either. With very many afferents blocks
/// are short enough that progress is still reported.
std::size_t block_for(const Input& input, const RespondOptions& options, bool wants_probes) {
    constexpr std::size_t max_values = std::size_t{1} << 23, max_steps = std::size_t{1} << 28, probes = 8;
    const std::size_t values = wants_probes ? input.afferent_count() * probes : input.source.channels().size();
    return std::clamp<std::size_t>(std::min(max_values / (values + 1), max_steps / (input.afferent_count() + 1)), 1, options.block);
}

/// Two afferents can share SIMD lanes if this text is equal.
std::string kind_of(const AfferentPlan& plan) {
    std::string kind = plan.composition();
    for (std::size_t k = 0; k < plan.values.size(); ++k)
        if ((*plan.parameters)[k].info.is_shared_by_copies) kind += fmt::format(" {}", plan.values[k]);
    return kind;
}

/// The plans that can share lanes, by index; and those that are simulated alone.
struct Kinds {
    std::vector<std::vector<std::size_t>> on_lanes;
    std::vector<std::size_t> scalar;
};

Kinds kinds_of(std::span<const AfferentPlan> plans, const SimulationOptions& run) {
    Kinds kinds;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < plans.size(); ++k) {
        if (!can_use_lanes(plans[k], run)) {
            kinds.scalar.push_back(k);
            continue;
        }
        const auto kind = kind_of(plans[k]);
        const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), kind) - names.begin());
        if (at == names.size()) names.push_back(kind), kinds.on_lanes.emplace_back();
        kinds.on_lanes[at].push_back(k);
    }
    return kinds;
}

}  // namespace

InputSimulator::InputSimulator(Input input, std::size_t block, bool wants_probes)
    : input_(std::move(input)), wants_probes_(wants_probes), force_(input_.source.channels().size(), block), lookahead_(0, 0) {}

Result<InputSimulator> InputSimulator::make(Input input, const RespondOptions& options, bool wants_probes) {
    const auto set = instruction_set();
    if (!set) return set.error();
    const std::size_t block = block_for(input, options, wants_probes);
    InputSimulator units(std::move(input), block, wants_probes);
    if (auto ok = units.place_afferents(options, *set); !ok) return ok.error();
    return units;
}

Result<void> InputSimulator::place_afferents(const RespondOptions& options, InstructionSet set) {
    const SimulationOptions run{input_.source.clock().T(), options.method, options.sampled, options.noise, options.seed};
    const auto plans = input_.plans;
    const std::size_t channels = input_.source.channels().size();
    const bool in_float = options.precision == Precision::single_precision;
    if (in_float && set == InstructionSet::scalar) return bad_usage("float needs SIMD lanes: CORPUSCLE_ISA=scalar has none");
    auto kinds = kinds_of(plans, run);
    if (in_float && (wants_probes_ || !kinds.scalar.empty()))
        return bad_usage(wants_probes_ ? "in float no probes are recorded: leave out --probe-files"
                                       : fmt::format("{}: {} cannot run in float", plans[kinds.scalar[0]].name,
                                                     plans[kinds.scalar[0]].factory ? "netlists" : "sensors, converters and noise"));
    std::vector<bool> is_scalar(plans.size());
    for (const auto k : kinds.scalar) is_scalar[k] = true;
    for (const auto& kind : kinds.on_lanes) {
        if (!in_float && (wants_probes_ || set == InstructionSet::scalar || kind.size() * channels < min_lane_group))
            for (const auto k : kind) is_scalar[k] = true;
        else if (auto ok = place_on_lanes(kind, run, options, set); !ok)
            return ok;
    }
    afferents_.resize(plans.size());
    probes_of_.resize(plans.size());
    for (std::size_t k = 0; k < plans.size(); ++k)
        if (is_scalar[k]) afferents_[k] = make_afferent(plans[k], run), probes_of_[k] = afferents_[k]->probes();
    input_.probes = probes_of_;
    std::int64_t delay = 0;
    for (const auto& a : afferents_) delay = std::max(delay, a ? a->delay() : 0);
    lookahead_ = LookaheadBuffer(channels, static_cast<std::size_t>(delay));
    for (std::size_t u = 0; u < input_.afferent_count(); ++u) {
        const std::size_t plan = u % plans.size();
        if (!is_scalar[plan]) continue;
        scalars_.push_back({static_cast<std::uint32_t>(u), afferents_[plan]->start({static_cast<std::uint32_t>(input_.channel_of(u)),
                                                                                    static_cast<std::uint32_t>(channels)})});
        scalars_.back().range_violations.resize(afferents_[plan]->ranges().size());
    }
    if (wants_probes_)
        for (std::size_t u = 0; u < input_.afferent_count(); ++u)
            probe_values_.emplace_back(probes_of_[u % plans.size()].size(), std::vector<double>(force_.capacity));
    return {};
}

/// Packs all channels into one population, or one population for each channel if most of its afferents have the same force.
Result<void> InputSimulator::place_on_lanes(std::span<const std::size_t> plans, const SimulationOptions& run, const RespondOptions& options,
                                            InstructionSet set) {
    const std::size_t channels = input_.source.channels().size(), all = input_.plans.size();
    const bool by_channel = plans.size() >= channels;
    LaneGroup group{{}, {}, by_channel};
    std::vector<const AfferentPlan*> lane_plans;
    for (std::size_t c = 0; c < channels; ++c) {
        for (const auto k : plans) {
            group.afferents.push_back(static_cast<std::uint32_t>(c * all + k));
            if (plans.size() > 1) lane_plans.push_back(&input_.plans[k]);
        }
        if (!by_channel && c + 1 < channels) continue;
        if (plans.size() == 1) lane_plans = {&input_.plans[plans[0]]};
        std::vector<std::uint32_t> numbers;
        for (const auto u : group.afferents) numbers.push_back(input_.first_afferent + u);
        auto population = make_lane_population({lane_plans, group.afferents.size(), numbers, options.precision}, run, set);
        if (!population) return population.error();
        group.population = std::move(*population);
        lane_groups_.push_back(std::exchange(group, {{}, {}, by_channel}));
        lane_plans.clear();
    }
    return {};
}

Error InputSimulator::with_afferent_name(Error error, std::size_t afferent_index) const {
    error.message = fmt::format("{} on {}: {}", input_.plan_of(afferent_index).name, input_.channel_name(input_.channel_of(afferent_index)),
                                error.message);
    return error;
}

Result<void> InputSimulator::simulate_lane_group(LaneGroup& group, ThreadPool& pool, RunStats& stats) {
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

void InputSimulator::simulate_scalar(ScalarAfferent& single) {
    const std::size_t u = single.afferent_index;
    std::vector<double*> probe_values;
    if (wants_probes_)
        for (auto& p : probe_values_[u]) probe_values.push_back(p.data());
    single.spikes.clear();
    ResponseBlock response{single.spikes, input_.first_afferent + single.afferent_index};
    if (single.diverged)
        for (double* p : probe_values) std::fill_n(p, force_.count, std::numeric_limits<double>::quiet_NaN());
    else if (auto ok = respond_to_force(single, response, probe_values); !ok)
        single.error = with_afferent_name(ok.error(), u);
    single.truncated_steps = response.truncated_steps, single.saturated = response.saturated, single.overflowed = response.overflowed;
    single.steps = response.steps, single.rejected = response.rejected_steps, single.iterations = response.newton_iterations;
    single.energy_use = response.energy_use;
}

/// An afferent with a delay first receives that many samples before the first block.
Result<void> InputSimulator::respond_to_force(ScalarAfferent& single, ResponseBlock& response, std::span<double* const> probe_values) {
    const auto& afferent = *afferents_[single.afferent_index % afferents_.size()];
    const auto delay = static_cast<std::size_t>(afferent.delay()), channel = input_.channel_of(single.afferent_index);
    if (delay > 0 && samples_ == 0)
        if (auto ok = afferent.respond(lookahead_.samples(channel, 0, delay), single.state, response); !ok) return ok;
    const std::span<const double> force =
        delay > 0 ? lookahead_.samples(channel, delay, force_.count) : std::span(force_of(single.afferent_index), force_.count);
    response.probes = probe_values, response.range_violations = single.range_violations;
    return afferent.respond(force, single.state, response);
}

/// The afferent of this plan that was outside a range longest, or null; and the number of afferents that were outside it.
std::pair<const InputSimulator::ScalarAfferent*, std::size_t> InputSimulator::longest_violation(std::size_t plan, std::size_t range) const {
    const ScalarAfferent* longest = nullptr;
    std::size_t count = 0;
    for (const auto& s : scalars_) {
        if (s.afferent_index % afferents_.size() != plan || s.range_violations[range].samples == 0) continue;
        ++count;
        if (!longest || s.range_violations[range].samples > longest->range_violations[range].samples) longest = &s;
    }
    return {longest, count};
}

std::vector<std::string> InputSimulator::range_warnings() const {
    std::vector<std::string> warnings;
    const double T = input_.source.clock().T();
    for (std::size_t plan = 0; plan < afferents_.size(); ++plan) {
        const auto ranges = afferents_[plan] ? afferents_[plan]->ranges() : std::span<const ValidRange>{};
        for (std::size_t r = 0; r < ranges.size(); ++r) {
            const auto [single, count] = longest_violation(plan, r);
            if (!single) continue;
            const auto& o = single->range_violations[r];
            const auto violation = range_violation_message(ranges[r], static_cast<double>(o.samples) * T, static_cast<double>(samples_) * T,
                                                           static_cast<double>(o.first_sample) * T);
            warnings.push_back(fmt::format("{} on {}: {}{}", input_.plans[plan].name,
                                           input_.channel_name(input_.channel_of(single->afferent_index)), violation,
                                           count > 1 ? fmt::format(" (also on {} more channels, for less time)", count - 1) : ""));
        }
    }
    return warnings;
}

Result<void> InputSimulator::simulate_scalars(ThreadPool& pool, RunStats& stats) {
    pool.for_each(scalars_.size(), [this](std::size_t k, unsigned) { simulate_scalar(scalars_[k]); });
    for (auto& s : scalars_) {
        if (s.error && !(s.error->code == ErrorCode::not_converged && input_.plan_of(s.afferent_index).factory)) return *s.error;
        if (s.error) s.diverged = true, stats.diverged.push_back(*std::exchange(s.error, {}));
        spikes_.insert(spikes_.end(), s.spikes.begin(), s.spikes.end());
        stats.truncated_steps += s.truncated_steps, stats.saturated += s.saturated, stats.overflowed += s.overflowed;
        stats.steps += s.steps, stats.rejected += s.rejected, stats.iterations += s.iterations;
        stats.energy_use.resize(afferents_.size());
        stats.energy_use[s.afferent_index % afferents_.size()] += s.energy_use;
    }
    return {};
}

Result<bool> InputSimulator::simulate_block(ForceSource& source, std::span<ResponseSink* const> sinks, ThreadPool& pool, RunStats& stats) {
    if (auto ok = lookahead_.next(source, force_); !ok) return ok.error();
    if (force_.count == 0) return false;
    spikes_.clear();
    for (auto& group : lane_groups_)
        if (auto ok = simulate_lane_group(group, pool, stats); !ok) return ok.error();
    if (auto ok = simulate_scalars(pool, stats); !ok) return ok.error();
    if (!std::is_sorted(spikes_.begin(), spikes_.end())) std::sort(spikes_.begin(), spikes_.end());
    const RunBlock block{samples_, force_, spikes_, probe_values_};
    for (auto* sink : sinks)
        if (auto ok = sink->block(input_, block); !ok) return ok.error();
    samples_ += static_cast<std::int64_t>(force_.count);
    const auto samples = static_cast<std::int64_t>(force_.count * force_.force.size());
    stats.samples += samples;
    stats.afferent_steps += samples * static_cast<std::int64_t>(input_.plans.size());
    stats.spikes += static_cast<std::int64_t>(spikes_.size());
    return true;
}

}  // namespace corpuscle
