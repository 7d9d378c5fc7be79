#pragma once
// A population of one precision. Models and states are in tiles of 64 afferents; blocks are split into chunks that fit the cache.

#include <fmt/format.h>
#include <cmath>
#include <optional>
#include <tuple>

#include "model/lanes/cast.hpp"
#include "model/lanes/collect.hpp"
#include "model/lanes/feeding.hpp"
#include "model/lanes/kernel.hpp"
#include "model/lanes/profile.hpp"
#include "model/lanes/states.hpp"
#include "model/population.hpp"

namespace corpuscle::lanes {

template <class V>
class Crowd final : public Population {
    static constexpr int chunk = chunk_steps<V>, long_chunk = 2 * chunk;  // long: used where no separate currents share the cache
    static constexpr std::size_t tiles_a_job = 16;                        // 1,024 afferents: the work of one thread

    /// Scratch memory of one thread.
    struct Scratch {
        Buffer<V> from{most_outputs * current_rows<V> * tile_units}, to{most_outputs * current_rows<V> * tile_units},
            rows{long_chunk * tile_units}, gain{tile_units};
        Buffer<Firing> firings{record_room};
        Buffer<V> offsets{record_room * 16};
        std::vector<V> before = {};  // the state of a tile
    };

    /// The block that is being simulated.
    struct Block {
        const PopulationForce& force;
        std::size_t steps;
        bool once;  // the currents of the profile are computed once for all
        std::uint64_t* marks;
    };

    Cast<V> cast_;
    Method method_;
    bool sampled_;
    std::size_t tiles_;
    TileStates<V> states_;
    std::int64_t step_ = 0;
    std::optional<std::pair<std::size_t, bool>> kind_;  // layout of the force so far, and whether its currents are shared
    ProfileRows<V> profile_;
    std::vector<Scratch> scratch_;
    std::vector<Job> jobs_;
    Buffer<V> nothing_{chunk_steps<V> * 2 * tile_units};  // rows of zero force
    std::vector<std::size_t> begin_, at_;

    /// The models of a tile, and the stride between them in bytes.
    template <class L>
    std::pair<const std::byte*, std::size_t> models(const Buffer<std::byte>& all, const L& of, std::size_t tile) const {
        if (all.size() == of.model_bytes) return {all.data(), 0};
        return {all.data() + tile * (tile_units / static_cast<std::size_t>(cast_.lanes)) * of.model_bytes, of.model_bytes};
    }

    int units_of(std::size_t tile) const { return static_cast<int>(std::min<std::size_t>(tile_units, cast_.units - tile * tile_units)); }
    std::uint64_t valid(std::size_t tile) const { return ~std::uint64_t{0} >> (tile_units - units_of(tile)); }

    /// Transposes columns of force into rows, one chunk at a time.
    void rows_of(const ForceColumns& columns, std::size_t first, std::size_t step, int steps, V* rows) const {
        for (std::size_t u = 0; u < tile_units; ++u) {
            const double* column = columns.of[std::min(first + u, cast_.units - 1)] + step;
            for (int t = 0; t < steps; ++t) rows[static_cast<std::size_t>(t) * tile_units + u] = static_cast<V>(column[t]);
        }
    }

    /// The memory that the next chunk reads.
    template <class E>
    static Ahead after(const E* rows, int steps) {
        const auto chunk_size = static_cast<std::size_t>(steps) * tile_units;
        return {reinterpret_cast<const char*>(rows + chunk_size), chunk_size * sizeof(E)};
    }
    /// Prefetches half of it during the receptors; the other half, which is returned, during the neurons.
    static Ahead second_half(Ahead& all) {
        all.bytes /= 2;
        return {all.at + all.bytes, all.bytes};
    }

    /// The destination of the currents at the ends of steps. For a continuous receptor they are also the beginnings of the next step, one
    /// row on.
    V* to_of(Scratch& s) const { return cast_.receptor->continuous ? s.from.data() + tile_units : s.to.data(); }

    TransductionCall<V> transduction(const Block& b, std::size_t tile, std::size_t step, int steps, Scratch& s) const {
        const auto [models, stride] = this->models(cast_.receptors, *cast_.receptor, tile);
        TransductionCall<V> c{};
        c.models = models, c.stride = stride, c.state = states_.receptor(tile);
        c.units = units_of(tile), c.steps = steps, c.method = method_;
        c.from = s.from.data(), c.to = to_of(s), c.gain = s.gain.data();
        const std::size_t row = (tile * b.steps + step) * tile_units;
        if (const auto* columns = std::get_if<ForceColumns>(&b.force)) {
            rows_of(*columns, tile * tile_units, step, steps, s.rows.data());
            c.feed = Feed::rows, c.rows = s.rows.data();
        } else if (const auto* tiles = std::get_if<ForceTiles<V>>(&b.force)) {
            c.feed = Feed::rows;
            if (without_force(b, tile))
                c.rows = nothing_.data();
            else
                c.rows = tiles->rows + row, c.ahead = after(c.rows, steps);
        } else if (const auto* words = std::get_if<ForceWords>(&b.force)) {
            c.feed = Feed::words, c.words = words->rows + row, c.scale = static_cast<V>(words->scale), c.ahead = after(c.words, steps);
        } else {
            c.feed = Feed::profile, c.profile = profile_.force() + step;
        }
        return c;
    }

    NeuronCall<V> firing(const Block& b, std::size_t tile, int output, std::size_t step, int steps, Scratch& s, Collector<V>& fired,
                         Ahead ahead) const {
        const auto [models, stride] = this->models(cast_.neurons, *cast_.neuron, tile);
        NeuronCall<V> c{};
        c.models = models, c.stride = stride, c.units = units_of(tile), c.steps = steps, c.fired = &fired, c.ahead = ahead;
        c.state = states_.neuron(tile) + static_cast<std::size_t>(output) * cast_.neuron->state_values * tile_units;
        if (b.once) {
            const auto& [from, to, both] = profile_.currents(output);
            c.from = from.data() + step, c.to = to.data() + step, c.both = both.data() + step, c.gain = s.gain.data();
        } else {
            c.to = to_of(s) + output * current_rows<V> * tile_units;
            c.from = cast_.receptor->continuous && method_ != Method::exact ? c.to : s.from.data() + output * current_rows<V> * tile_units;
        }
        return c;
    }

    /// Simulates some steps of a tile. For the first step of all, the force before it is taken to be the same. Backward Euler takes a step
    /// there, with its spikes on the sample. The exact method has no interval to integrate yet.
    void run_chunk(const Block& b, std::size_t tile, std::size_t step, int steps, Scratch& s, Job& job) const {
        const bool first = step_ == 0 && step == 0, silent = first && method_ == Method::exact;
        Collector<V> fired{{s.firings.data(), sampled_ || first ? nullptr : s.offsets.data(), 0, 0, valid(tile), 0,
                            [](FiringList<V>& list) { static_cast<Collector<V>&>(list).empty(); }},
                           job,
                           b.marks ? b.marks + tile * b.steps + step : nullptr,
                           static_cast<std::uint32_t>(tile * tile_units),
                           static_cast<std::uint32_t>(step),
                           cast_.lanes};
        if (cast_.joined && !b.once && !first) {
            cast_.joined->run(transduction(b, tile, step, steps, s), firing(b, tile, 0, step, steps, s, fired, {}));
        } else {
            Ahead ahead{};
            if (!b.once) {
                auto c = transduction(b, tile, step, steps, s);
                if (first) cast_.receptor->start(c);
                ahead = second_half(c.ahead);
                cast_.receptor->run(c);
                job.lost |= c.strange;
            }
            for (int k = 0; k < cast_.receptor->outputs; ++k) {
                const auto c = firing(b, tile, k, step, steps, s, fired, k == 0 ? ahead : Ahead{});
                if (first) cast_.neuron->start(c);
                if (!silent) cast_.neuron->run(c);
                fired.empty();
            }
        }
        fired.empty();
        job.capped += fired.capped;
    }

    static bool without_force(const Block& b, std::size_t tile) {
        const auto* tiles = std::get_if<ForceTiles<V>>(&b.force);
        return tiles && tiles->without && tiles->without[tile];
    }

    /// Sets the decayed state of a tile to zero.
    void settle(std::size_t tile) const {
        TransductionCall<V> c{};
        std::tie(c.models, c.stride) = models(cast_.receptors, *cast_.receptor, tile);
        c.state = states_.receptor(tile);
        (cast_.joined ? cast_.joined->settle : cast_.receptor->settle)(c);
        NeuronCall<V> n{};
        std::tie(n.models, n.stride) = models(cast_.neurons, *cast_.neuron, tile);
        for (int k = 0; k < cast_.receptor->outputs; ++k) {
            n.state = states_.neuron(tile) + static_cast<std::size_t>(k) * cast_.neuron->state_values * tile_units;
            cast_.neuron->settle(n);
        }
    }

    /// Takes one step without force. If this changes no bit of the tile's state and no afferent fires, the tile is at rest. It is then
    /// skipped until force comes. The state is flushed first, so that a later flush cannot change it.
    void look_for_rest(const Block& b, std::size_t tile, std::size_t step, Scratch& s, Job& job) {
        states_.copy(tile, s.before);
        const auto fired = job.fired;
        run_chunk(b, tile, step, 1, s, job);
        if (job.fired != fired || !states_.is(tile, s.before)) return;
        settle(tile);
        states_.set_rest(tile, states_.is(tile, s.before));
        states_.put_back(tile, s.before);
    }

    /// Runs as many steps as possible at once. A run ends where states are flushed; the step after which a tile may be found at rest is run
    /// alone. Returns the number of steps taken before the tile was found at rest.
    std::size_t run_tile(const Block& b, std::size_t tile, Scratch& s, Job& job) {
        constexpr std::int64_t rest_interval = 256;
        const bool without = without_force(b, tile);
        if (!without) states_.set_rest(tile, false);
        const std::int64_t max_steps = b.once ? 256 : cast_.joined ? long_chunk : chunk;
        std::size_t step = 0;
        while (step < b.steps && !states_.rests(tile)) {
            const std::int64_t now = step_ + static_cast<std::int64_t>(step);
            if (now % settling == 0 && now > 0) settle(tile);
            const std::int64_t to_check = (rest_interval + 1 - now % rest_interval) % rest_interval;
            if (without && to_check == 0) {
                look_for_rest(b, tile, step++, s, job);
                continue;
            }
            std::int64_t steps = std::min({max_steps, static_cast<std::int64_t>(b.steps - step), settling - now % settling});
            if (without) steps = std::min(steps, to_check);
            run_chunk(b, tile, step, now == 0 ? 1 : static_cast<int>(steps), s, job);
            step += now == 0 ? 1 : static_cast<std::size_t>(steps);
        }
        return step;
    }

    /// A state that becomes NaN stays NaN. For blocks of one or two steps it is therefore checked only every few steps.
    static constexpr std::int64_t between_looks = 64;
    bool looks(const Block& b) const { return step_ / between_looks != (step_ + static_cast<std::int64_t>(b.steps)) / between_looks; }

    void run_job(const Block& b, std::size_t number, Scratch& s) {
        auto& job = jobs_[number];
        job.events.clear(), job.capped = job.unmarked = job.passed = job.fired = 0, job.lost = false;
        for (std::size_t tile = number * tiles_a_job; tile < std::min(tiles_, (number + 1) * tiles_a_job); ++tile) {
            if (const auto* profile = std::get_if<ForceProfile>(&b.force)) profile_gains(*profile, tile * tile_units, s.gain.data());
            const std::size_t steps = run_tile(b, tile, s, job);
            job.passed += static_cast<std::int64_t>(b.steps - steps) * units_of(tile);
            if (steps == 0 || !(looks(b) || states_.rests(tile))) continue;
            job.lost |= !states_.all_numbers(tile);
        }
    }

    /// The force of an afferent at a step of the block, as passed by the caller.
    double force_of(const Block& b, std::size_t afferent, std::size_t step) const {
        const std::size_t at = (afferent / tile_units * b.steps + step) * tile_units + afferent % tile_units;
        if (const auto* columns = std::get_if<ForceColumns>(&b.force)) return columns->of[afferent][step];
        if (without_force(b, afferent / tile_units)) return 0;
        if (const auto* tiles = std::get_if<ForceTiles<V>>(&b.force)) return static_cast<double>(tiles->rows[at]);
        if (const auto* profile = std::get_if<ForceProfile>(&b.force)) return profile->force[step];
        return 0;  // integers are always finite
    }

    std::optional<Error> no_force(const Block& b, PopulationAnswer& response) const {
        for (std::size_t afferent = 0; afferent < cast_.units; ++afferent)
            for (std::size_t step = 0; step < b.steps; ++step)
                if (const double f = force_of(b, afferent, step); !std::isfinite(f)) {
                    response.failed = afferent;
                    return bad_input(
                        fmt::format("{}: the force of sample {} is {}", cast_.name, step_ + static_cast<std::int64_t>(step), f));
                }
        return {};
    }

    /// The first afferent whose state is not finite; none if only the padding is affected.
    std::optional<std::size_t> first_lost() const {
        for (std::size_t afferent = 0; afferent < cast_.units; ++afferent)
            if (states_.is_lost(afferent)) return afferent;
        return {};
    }

    Error lost(std::size_t afferent, const Block& b, PopulationAnswer& response) const {
        response.failed = afferent;
        return {ErrorCode::not_converged,
                fmt::format("{}: its state became NaN or infinite between samples {} and {}; the force or a gain is "
                            "far too large, or the substep too long",
                            cast_.name, step_ / between_looks * between_looks, step_ + static_cast<std::int64_t>(b.steps))};
    }

    /// The error of the jobs, if there is one.
    std::optional<Error> wrong(const Block& b, PopulationAnswer& response) const {
        if (std::none_of(jobs_.begin(), jobs_.end(), [](const Job& job) { return job.lost; })) return {};
        if (auto error = no_force(b, response)) return error;
        const auto afferent = first_lost();
        return afferent ? std::optional(lost(*afferent, b, response)) : std::nullopt;
    }

    /// True if the currents of a profile are computed once for all afferents.
    bool once(const PopulationForce& force) const {
        const auto* profile = std::get_if<ForceProfile>(&force);
        return profile && cast_.once && (profile->gain.empty() || cast_.scales);
    }

    Result<void> check(const PopulationForce& force, std::size_t steps) {
        const std::pair kind(force.index(), once(force));
        if (kind_ && *kind_ != kind)
            return bad_input(fmt::format("{}: the layout of its force must not change between blocks", cast_.name));
        kind_ = kind;
        if (auto error = unfit_force<V>(force, steps, cast_.units, cast_.name)) return *error;
        return {};
    }

public:
    Crowd(Cast<V> layout, const Run& run)
        : cast_(std::move(layout)), method_(run.method), sampled_(run.sampled), tiles_((cast_.units + tile_units - 1) / tile_units),
          states_(tiles_, cast_.receptor->state_values, cast_.neuron->state_values * static_cast<std::size_t>(cast_.receptor->outputs)),
          jobs_((tiles_ + tiles_a_job - 1) / tiles_a_job) {}

    std::size_t units() const override { return cast_.units; }
    std::int64_t step() const override { return step_; }

    std::vector<double> save() const override {
        std::vector<double> all = {static_cast<double>(step_), kind_ ? static_cast<double>(1 + 2 * kind_->first + kind_->second) : 0.0};
        states_.save(all);
        if (cast_.once) {
            const auto profile = cast_.once->save();
            all.insert(all.end(), profile.begin(), profile.end());
        }
        return all;
    }

    Result<void> resume(std::span<const double> all) override {
        constexpr double last_step = 1LL << 53, kinds = 2 * std::variant_size_v<PopulationForce>;
        const std::size_t own = 2 + states_.size();
        const auto is_integer = [](double x, double max) { return x >= 0 && x <= max && x == std::floor(x); };
        const bool fits = all.size() >= own && is_integer(all[0], last_step) && is_integer(all[1], kinds) &&
                          (cast_.once ? cast_.once->resume(all.subspan(own)) : all.size() == own) &&
                          states_.resume(all.subspan(2, states_.size()));
        if (!fits) return bad_input(fmt::format("{}: a saved state with {} values is not one of this population", cast_.name, all.size()));
        step_ = static_cast<std::int64_t>(all[0]);
        const auto kind = static_cast<std::size_t>(all[1]);
        kind_ = kind == 0 ? std::nullopt : std::optional(std::pair((kind - 1) / 2, (kind - 1) % 2 == 1));
        return {};
    }

    Result<void> respond(const PopulationForce& force, std::size_t steps, PopulationAnswer& response, ThreadPool& pool) override {
        if (auto ok = check(force, steps); !ok) return ok;
        if (steps == 0) return {};
        Block block{force, steps, once(force), nullptr};
        if (const auto* profile = std::get_if<ForceProfile>(&force)) {
            if (const auto at = first_non_finite(profile->force.first(steps)); at < steps) return *no_force(block, response);
            const auto now = profile->force.first(steps);
            block.once ? profile_.transduce(*cast_.once, now, step_ == 0, cast_.receptor->outputs) : profile_.keep(now);
        }
        if (response.marks) response.marks->assign(tiles_ * steps, 0), block.marks = response.marks->data();
        while (scratch_.size() < pool.threads()) scratch_.emplace_back();
        pool.for_each(jobs_.size(), [&](std::size_t job, unsigned thread) { run_job(block, job, scratch_[thread]); });
        for (const auto& job : jobs_) response.capped += job.capped, response.unmarked += job.unmarked, response.passed += job.passed;
        if (auto error = wrong(block, response)) return *error;
        if (response.spikes) gather(jobs_, steps, step_, cast_.numbers, *response.spikes, begin_, at_);
        step_ += static_cast<std::int64_t>(steps);
        return {};
    }
};

}  // namespace corpuscle::lanes
