#include "study/units.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <utility>

namespace corpuscle {
namespace {

/// Units that are worth a population: with fewer, lanes are mostly empty.
constexpr std::size_t least_crowd = 4;

/// Fewer samples at a time where there are many channels, or many units that show their probes: some 64 MB of either. Where there
/// are very many units, so few that somebody who waits is still told how far it is.
std::size_t block_for(const Input& input, const RespondOptions& options, bool probed) {
    constexpr std::size_t most_values = std::size_t{1} << 23, most_steps = std::size_t{1} << 28, probes = 8;
    const std::size_t values = probed ? input.units() * probes : input.source.channels().size();
    return std::clamp<std::size_t>(std::min(most_values / (values + 1), most_steps / (input.units() + 1)), 1, options.block);
}

/// What units must share to stand side by side.
std::string kind_of(const AfferentPlan& plan) {
    std::string kind = plan.made_of();
    for (std::size_t k = 0; k < plan.values.size(); ++k)
        if ((*plan.parameters)[k].row.one_for_all) kind += fmt::format(" {}", plan.values[k]);
    return kind;
}

/// The plans of each kind that goes on lanes, by their numbers; and those that do not, each alone.
struct Kinds {
    std::vector<std::vector<std::size_t>> together;
    std::vector<std::size_t> alone;
};

Kinds kinds_of(std::span<const AfferentPlan> plans, const Run& run) {
    Kinds kinds;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < plans.size(); ++k) {
        if (!goes_on_lanes(plans[k], run)) {
            kinds.alone.push_back(k);
            continue;
        }
        const auto kind = kind_of(plans[k]);
        const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), kind) - names.begin());
        if (at == names.size()) names.push_back(kind), kinds.together.emplace_back();
        kinds.together[at].push_back(k);
    }
    return kinds;
}

}  // namespace

Units::Units(Input input, std::size_t block, bool probed)
    : input_(std::move(input)), probed_(probed), force_(input_.source.channels().size(), block), ahead_(0, 0) {}

Result<Units> Units::make(Input input, const RespondOptions& options, bool probed) {
    const auto set = instruction_set();
    if (!set) return set.error();
    const std::size_t block = block_for(input, options, probed);
    Units units(std::move(input), block, probed);
    if (auto ok = units.seat(options, *set); !ok) return ok.error();
    return units;
}

Result<void> Units::seat(const RespondOptions& options, InstructionSet set) {
    const Run run{input_.source.clock().T(), options.method, options.sampled, options.noise, options.seed};
    const auto plans = input_.afferents;
    const std::size_t channels = input_.source.channels().size();
    const bool in_float = options.precision == Precision::in_float;
    if (in_float && set == InstructionSet::scalar) return bad_usage("float needs lanes: CORPUSCLE_ISA=scalar has none");
    auto kinds = kinds_of(plans, run);
    if (in_float && (probed_ || !kinds.alone.empty()))
        return bad_usage(probed_ ? "in float no currents and membranes are kept: leave out --traces"
                                 : fmt::format("{}: {} are not in float", plans[kinds.alone[0]].name,
                                               plans[kinds.alone[0]].design ? "netlists" : "sensors, converters and noise"));
    std::vector<bool> single(plans.size());
    for (const auto k : kinds.alone) single[k] = true;
    for (const auto& kind : kinds.together) {
        if (!in_float && (probed_ || set == InstructionSet::scalar || kind.size() * channels < least_crowd))
            for (const auto k : kind) single[k] = true;
        else if (auto ok = seat_crowds(kind, run, options, set); !ok)
            return ok;
    }
    afferents_.resize(plans.size());
    probes_of_.resize(plans.size());
    for (std::size_t k = 0; k < plans.size(); ++k)
        if (single[k]) afferents_[k] = make_afferent(plans[k], run), probes_of_[k] = afferents_[k]->probes();
    input_.probes = probes_of_;
    std::int64_t delay = 0;
    for (const auto& a : afferents_) delay = std::max(delay, a ? a->delay() : 0);
    ahead_ = Ahead(channels, static_cast<std::size_t>(delay));
    for (std::size_t u = 0; u < input_.units(); ++u) {
        const std::size_t plan = u % plans.size();
        if (!single[plan]) continue;
        singles_.push_back({static_cast<std::uint32_t>(u), afferents_[plan]->start({static_cast<std::uint32_t>(input_.channel_of(u)),
                                                                                    static_cast<std::uint32_t>(channels)})});
        singles_.back().outside.resize(afferents_[plan]->ranges().size());
    }
    if (probed_)
        for (std::size_t u = 0; u < input_.units(); ++u)
            shown_.emplace_back(probes_of_[u % plans.size()].size(), std::vector<double>(force_.capacity));
    return {};
}

/// One population for all channels; or, where most of a kind feel the same force, one for each channel.
Result<void> Units::seat_crowds(std::span<const std::size_t> plans, const Run& run, const RespondOptions& options, InstructionSet set) {
    const std::size_t channels = input_.source.channels().size(), all = input_.afferents.size();
    const bool by_channel = plans.size() >= channels;
    Crowd crowd{{}, {}, by_channel};
    std::vector<const AfferentPlan*> of;
    for (std::size_t c = 0; c < channels; ++c) {
        for (const auto k : plans) {
            crowd.units.push_back(static_cast<std::uint32_t>(c * all + k));
            if (plans.size() > 1) of.push_back(&input_.afferents[k]);
        }
        if (!by_channel && c + 1 < channels) continue;
        if (plans.size() == 1) of = {&input_.afferents[plans[0]]};
        std::vector<std::uint32_t> numbers;
        for (const auto u : crowd.units) numbers.push_back(input_.first_unit + u);
        auto made = make_population({of, crowd.units.size(), numbers, options.precision}, run, set);
        if (!made) return made.error();
        crowd.population = std::move(*made);
        crowds_.push_back(std::exchange(crowd, {{}, {}, by_channel}));
        of.clear();
    }
    return {};
}

Error Units::of_unit(Error error, std::size_t unit) const {
    error.sentence =
        fmt::format("{} on {}: {}", input_.afferent_of(unit).name, input_.channel_name(input_.channel_of(unit)), error.sentence);
    return error;
}

Result<void> Units::answer_crowd(Crowd& crowd, Pool& pool, Work& work) {
    std::vector<const double*> columns;
    PopulationForce force;
    if (crowd.one_channel) {
        force = ForceProfile{{force_of(crowd.units[0]), force_.count}};
    } else {
        for (const auto u : crowd.units) columns.push_back(force_of(u));
        force = ForceColumns{columns};
    }
    PopulationAnswer answer{&spikes_};
    if (auto ok = crowd.population->respond(force, force_.count, answer, pool); !ok) return of_unit(ok.error(), crowd.units[answer.failed]);
    work.capped_steps += answer.capped;
    return {};
}

void Units::answer_single(Single& single) {
    const std::size_t u = single.unit;
    std::vector<double*> shown;
    if (probed_)
        for (auto& p : shown_[u]) shown.push_back(p.data());
    single.spikes.clear();
    Answer answer{single.spikes, input_.first_unit + single.unit};
    if (single.lost)
        for (double* p : shown) std::fill_n(p, force_.count, std::numeric_limits<double>::quiet_NaN());
    else if (auto ok = answer_force(single, answer, shown); !ok)
        single.error = of_unit(ok.error(), u);
    single.capped = answer.capped, single.clipped = answer.clipped, single.overflowed = answer.overflowed;
    single.steps = answer.steps, single.rejected = answer.rejected, single.iterations = answer.iterations;
    single.spent = answer.spent;
}

/// One whose answer is behind the force has heard so much more of it before the first block.
Result<void> Units::answer_force(Single& single, Answer& answer, std::span<double* const> shown) {
    const auto& afferent = *afferents_[single.unit % afferents_.size()];
    const auto delay = static_cast<std::size_t>(afferent.delay()), channel = input_.channel_of(single.unit);
    if (delay > 0 && samples_ == 0)
        if (auto ok = afferent.respond(ahead_.of(channel, 0, delay), single.state, answer); !ok) return ok;
    const std::span<const double> force =
        delay > 0 ? ahead_.of(channel, delay, force_.count) : std::span(force_of(single.unit), force_.count);
    answer.probes = shown, answer.outside = single.outside;
    return afferent.respond(force, single.state, answer);
}

/// The one of this plan's units that was outside a range longest, or null; and how many were.
std::pair<const Units::Single*, std::size_t> Units::longest_outside(std::size_t plan, std::size_t range) const {
    const Single* longest = nullptr;
    std::size_t left = 0;
    for (const auto& s : singles_) {
        if (s.unit % afferents_.size() != plan || s.outside[range].samples == 0) continue;
        ++left;
        if (!longest || s.outside[range].samples > longest->outside[range].samples) longest = &s;
    }
    return {longest, left};
}

std::vector<std::string> Units::outside() const {
    std::vector<std::string> sentences;
    const double T = input_.source.clock().T();
    for (std::size_t plan = 0; plan < afferents_.size(); ++plan) {
        const auto ranges = afferents_[plan] ? afferents_[plan]->ranges() : std::span<const Range>{};
        for (std::size_t r = 0; r < ranges.size(); ++r) {
            const auto [single, left] = longest_outside(plan, r);
            if (!single) continue;
            const auto& o = single->outside[r];
            const auto what = outside_sentence(ranges[r], static_cast<double>(o.samples) * T, static_cast<double>(samples_) * T,
                                               static_cast<double>(o.first) * T);
            sentences.push_back(fmt::format("{} on {}: {}{}", input_.afferents[plan].name,
                                            input_.channel_name(input_.channel_of(single->unit)), what,
                                            left > 1 ? fmt::format(" (on {} more channels, too, not as long)", left - 1) : ""));
        }
    }
    return sentences;
}

Result<void> Units::answer_singles(Pool& pool, Work& work) {
    pool.each(singles_.size(), [this](std::size_t k, unsigned) { answer_single(singles_[k]); });
    for (auto& s : singles_) {
        if (s.error && !(s.error->code == Code::not_converged && input_.afferent_of(s.unit).design)) return *s.error;
        if (s.error) s.lost = true, work.lost.push_back(*std::exchange(s.error, {}));
        spikes_.insert(spikes_.end(), s.spikes.begin(), s.spikes.end());
        work.capped_steps += s.capped, work.clipped += s.clipped, work.overflowed += s.overflowed;
        work.steps += s.steps, work.rejected += s.rejected, work.iterations += s.iterations;
        work.spent.resize(afferents_.size());
        work.spent[s.unit % afferents_.size()] += s.spent;
    }
    return {};
}

Result<bool> Units::answer_block(Source& source, std::span<Listener* const> listeners, Pool& pool, Work& work) {
    if (auto ok = ahead_.next(source, force_); !ok) return ok.error();
    if (force_.count == 0) return false;
    spikes_.clear();
    for (auto& crowd : crowds_)
        if (auto ok = answer_crowd(crowd, pool, work); !ok) return ok.error();
    if (auto ok = answer_singles(pool, work); !ok) return ok.error();
    if (!std::is_sorted(spikes_.begin(), spikes_.end())) std::sort(spikes_.begin(), spikes_.end());
    const Answered answered{samples_, force_, spikes_, shown_};
    for (auto* listener : listeners)
        if (auto ok = listener->block(input_, answered); !ok) return ok.error();
    samples_ += static_cast<std::int64_t>(force_.count);
    const auto samples = static_cast<std::int64_t>(force_.count * force_.force.size());
    work.samples += samples;
    work.afferent_steps += samples * static_cast<std::int64_t>(input_.afferents.size());
    work.spikes += static_cast<std::int64_t>(spikes_.size());
    return true;
}

}  // namespace corpuscle
