#include "study/units.hpp"

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
    const std::size_t values = wants_probes ? input.units() * probes : input.source.channels().size();
    return std::clamp<std::size_t>(std::min(max_values / (values + 1), max_steps / (input.units() + 1)), 1, options.block);
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

Units::Units(Input input, std::size_t block, bool wants_probes)
    : input_(std::move(input)), probed_(wants_probes), force_(input_.source.channels().size(), block), ahead_(0, 0) {}

Result<Units> Units::make(Input input, const RespondOptions& options, bool wants_probes) {
    const auto set = instruction_set();
    if (!set) return set.error();
    const std::size_t block = block_for(input, options, wants_probes);
    Units units(std::move(input), block, wants_probes);
    if (auto ok = units.seat(options, *set); !ok) return ok.error();
    return units;
}

Result<void> Units::seat(const RespondOptions& options, InstructionSet set) {
    const SimulationOptions run{input_.source.clock().T(), options.method, options.sampled, options.noise, options.seed};
    const auto plans = input_.afferents;
    const std::size_t channels = input_.source.channels().size();
    const bool in_float = options.precision == Precision::single_precision;
    if (in_float && set == InstructionSet::scalar) return bad_usage("float needs SIMD lanes: CORPUSCLE_ISA=scalar has none");
    auto kinds = kinds_of(plans, run);
    if (in_float && (probed_ || !kinds.scalar.empty()))
        return bad_usage(probed_ ? "in float no probes are recorded: leave out --traces"
                                 : fmt::format("{}: {} cannot run in float", plans[kinds.scalar[0]].name,
                                               plans[kinds.scalar[0]].factory ? "netlists" : "sensors, converters and noise"));
    std::vector<bool> is_scalar(plans.size());
    for (const auto k : kinds.scalar) is_scalar[k] = true;
    for (const auto& kind : kinds.on_lanes) {
        if (!in_float && (probed_ || set == InstructionSet::scalar || kind.size() * channels < min_lane_group))
            for (const auto k : kind) is_scalar[k] = true;
        else if (auto ok = seat_crowds(kind, run, options, set); !ok)
            return ok;
    }
    afferents_.resize(plans.size());
    probes_of_.resize(plans.size());
    for (std::size_t k = 0; k < plans.size(); ++k)
        if (is_scalar[k]) afferents_[k] = make_afferent(plans[k], run), probes_of_[k] = afferents_[k]->probes();
    input_.probes = probes_of_;
    std::int64_t delay = 0;
    for (const auto& a : afferents_) delay = std::max(delay, a ? a->delay() : 0);
    ahead_ = Ahead(channels, static_cast<std::size_t>(delay));
    for (std::size_t u = 0; u < input_.units(); ++u) {
        const std::size_t plan = u % plans.size();
        if (!is_scalar[plan]) continue;
        singles_.push_back({static_cast<std::uint32_t>(u), afferents_[plan]->start({static_cast<std::uint32_t>(input_.channel_of(u)),
                                                                                    static_cast<std::uint32_t>(channels)})});
        singles_.back().outside.resize(afferents_[plan]->ranges().size());
    }
    if (probed_)
        for (std::size_t u = 0; u < input_.units(); ++u)
            shown_.emplace_back(probes_of_[u % plans.size()].size(), std::vector<double>(force_.capacity));
    return {};
}

/// Packs all channels into one population, or one population for each channel if most of its afferents have the same force.
Result<void> Units::seat_crowds(std::span<const std::size_t> plans, const SimulationOptions& run, const RespondOptions& options, InstructionSet set) {
    const std::size_t channels = input_.source.channels().size(), all = input_.afferents.size();
    const bool by_channel = plans.size() >= channels;
    Crowd group{{}, {}, by_channel};
    std::vector<const AfferentPlan*> lane_plans;
    for (std::size_t c = 0; c < channels; ++c) {
        for (const auto k : plans) {
            group.units.push_back(static_cast<std::uint32_t>(c * all + k));
            if (plans.size() > 1) lane_plans.push_back(&input_.afferents[k]);
        }
        if (!by_channel && c + 1 < channels) continue;
        if (plans.size() == 1) lane_plans = {&input_.afferents[plans[0]]};
        std::vector<std::uint32_t> numbers;
        for (const auto u : group.units) numbers.push_back(input_.first_unit + u);
        auto population = make_lane_population({lane_plans, group.units.size(), numbers, options.precision}, run, set);
        if (!population) return population.error();
        group.population = std::move(*population);
        crowds_.push_back(std::exchange(group, {{}, {}, by_channel}));
        lane_plans.clear();
    }
    return {};
}

Error Units::of_unit(Error error, std::size_t afferent_index) const {
    error.message = fmt::format("{} on {}: {}", input_.afferent_of(afferent_index).name,
                                 input_.channel_name(input_.channel_of(afferent_index)), error.message);
    return error;
}

Result<void> Units::answer_crowd(Crowd& group, ThreadPool& pool, Work& stats) {
    std::vector<const double*> columns;
    PopulationForce force;
    if (group.one_channel) {
        force = ForceProfile{{force_of(group.units[0]), force_.count}};
    } else {
        for (const auto u : group.units) columns.push_back(force_of(u));
        force = ForceColumns{columns};
    }
    PopulationResponse response{&spikes_};
    if (auto ok = group.population->respond(force, force_.count, response, pool); !ok)
        return of_unit(ok.error(), group.units[response.failed_afferent]);
    stats.capped_steps += response.truncated_steps;
    return {};
}

void Units::answer_single(Single& single) {
    const std::size_t u = single.unit;
    std::vector<double*> probe_values;
    if (probed_)
        for (auto& p : shown_[u]) probe_values.push_back(p.data());
    single.spikes.clear();
    ResponseBlock response{single.spikes, input_.first_unit + single.unit};
    if (single.lost)
        for (double* p : probe_values) std::fill_n(p, force_.count, std::numeric_limits<double>::quiet_NaN());
    else if (auto ok = answer_force(single, response, probe_values); !ok)
        single.error = of_unit(ok.error(), u);
    single.capped = response.truncated_steps, single.clipped = response.saturated, single.overflowed = response.overflowed;
    single.steps = response.steps, single.rejected = response.rejected_steps, single.iterations = response.newton_iterations;
    single.spent = response.energy_use;
}

/// An afferent with a delay first receives that many samples before the first block.
Result<void> Units::answer_force(Single& single, ResponseBlock& response, std::span<double* const> probe_values) {
    const auto& afferent = *afferents_[single.unit % afferents_.size()];
    const auto delay = static_cast<std::size_t>(afferent.delay()), channel = input_.channel_of(single.unit);
    if (delay > 0 && samples_ == 0)
        if (auto ok = afferent.respond(ahead_.of(channel, 0, delay), single.state, response); !ok) return ok;
    const std::span<const double> force =
        delay > 0 ? ahead_.of(channel, delay, force_.count) : std::span(force_of(single.unit), force_.count);
    response.probes = probe_values, response.range_violations = single.outside;
    return afferent.respond(force, single.state, response);
}

/// The afferent of this plan that was outside a range longest, or null; and the number of afferents that were outside it.
std::pair<const Units::Single*, std::size_t> Units::longest_outside(std::size_t plan, std::size_t range) const {
    const Single* longest = nullptr;
    std::size_t count = 0;
    for (const auto& s : singles_) {
        if (s.unit % afferents_.size() != plan || s.outside[range].samples == 0) continue;
        ++count;
        if (!longest || s.outside[range].samples > longest->outside[range].samples) longest = &s;
    }
    return {longest, count};
}

std::vector<std::string> Units::outside() const {
    std::vector<std::string> warnings;
    const double T = input_.source.clock().T();
    for (std::size_t plan = 0; plan < afferents_.size(); ++plan) {
        const auto ranges = afferents_[plan] ? afferents_[plan]->ranges() : std::span<const ValidRange>{};
        for (std::size_t r = 0; r < ranges.size(); ++r) {
            const auto [single, count] = longest_outside(plan, r);
            if (!single) continue;
            const auto& o = single->outside[r];
            const auto violation = range_violation_message(ranges[r], static_cast<double>(o.samples) * T, static_cast<double>(samples_) * T,
                                                    static_cast<double>(o.first_sample) * T);
            warnings.push_back(fmt::format("{} on {}: {}{}", input_.afferents[plan].name,
                                           input_.channel_name(input_.channel_of(single->unit)), violation,
                                           count > 1 ? fmt::format(" (also on {} more channels, for less time)", count - 1) : ""));
        }
    }
    return warnings;
}

Result<void> Units::answer_singles(ThreadPool& pool, Work& stats) {
    pool.for_each(singles_.size(), [this](std::size_t k, unsigned) { answer_single(singles_[k]); });
    for (auto& s : singles_) {
        if (s.error && !(s.error->code == ErrorCode::not_converged && input_.afferent_of(s.unit).factory)) return *s.error;
        if (s.error) s.lost = true, stats.lost.push_back(*std::exchange(s.error, {}));
        spikes_.insert(spikes_.end(), s.spikes.begin(), s.spikes.end());
        stats.capped_steps += s.capped, stats.clipped += s.clipped, stats.overflowed += s.overflowed;
        stats.steps += s.steps, stats.rejected += s.rejected, stats.iterations += s.iterations;
        stats.spent.resize(afferents_.size());
        stats.spent[s.unit % afferents_.size()] += s.spent;
    }
    return {};
}

Result<bool> Units::answer_block(ForceSource& source, std::span<Listener* const> sinks, ThreadPool& pool, Work& stats) {
    if (auto ok = ahead_.next(source, force_); !ok) return ok.error();
    if (force_.count == 0) return false;
    spikes_.clear();
    for (auto& group : crowds_)
        if (auto ok = answer_crowd(group, pool, stats); !ok) return ok.error();
    if (auto ok = answer_singles(pool, stats); !ok) return ok.error();
    if (!std::is_sorted(spikes_.begin(), spikes_.end())) std::sort(spikes_.begin(), spikes_.end());
    const Answered block{samples_, force_, spikes_, shown_};
    for (auto* sink : sinks)
        if (auto ok = sink->block(input_, block); !ok) return ok.error();
    samples_ += static_cast<std::int64_t>(force_.count);
    const auto samples = static_cast<std::int64_t>(force_.count * force_.force.size());
    stats.samples += samples;
    stats.afferent_steps += samples * static_cast<std::int64_t>(input_.afferents.size());
    stats.spikes += static_cast<std::int64_t>(spikes_.size());
    return true;
}

}  // namespace corpuscle
