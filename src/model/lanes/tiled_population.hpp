#pragma once
// The implementation of LanePopulation for one number type V, double or float. Models and states are in tiles of 64 afferents; blocks are
// split into chunks of steps that fit the cache.

#include "model/lanes/force_input.hpp"
#include "model/lanes/spike_collector.hpp"
#include "model/lanes/tile_states.hpp"
#include "model/random_stream.hpp"

namespace corpuscle::lanes {

/// The parts from which TiledPopulation is built. They have been checked.
template <class V>
struct PopulationLayout {
    const ReceptorKernel<V>* receptor;
    const NeuronKernel<V>* neuron;
    const FusedKernel<V>* fused = nullptr;                  ///< receptor and neuron in one loop; null: not available
    int lanes;                                              ///< afferents in a vector
    std::size_t size;                                       ///< number of afferents
    std::size_t forces = 1;                                 ///< number of forces, and so of receptors, of each afferent
    AlignedBuffer<std::byte> receptors = {}, neurons = {};  ///< the models: one for all afferents, or those of tile 0, tile 1 ...
    std::unique_ptr<SharedReceptor> shared_receptor = {};   ///< not null if all afferents have the same receptor parameters
    std::vector<std::uint32_t> afferent_numbers;            ///< Spike::afferent_index of each afferent; empty: 0, 1, 2 ...
    std::string name;                                       ///< for messages: "sa1b+lif-b"
};

template <class V>
class TiledPopulation final : public LanePopulation {
    static constexpr int chunk = chunk_steps<V>, long_chunk = 2 * chunk;  // steps; long_chunk: for fused kernels, which store no currents
    static constexpr std::size_t tiles_per_job = 16;                      // 1,024 afferents; a job is simulated by one thread

    /// Scratch memory of one thread.
    struct Scratch {
        AlignedBuffer<V> from{max_outputs * current_rows<V> * tile_size}, to{max_outputs * current_rows<V> * tile_size},
            rows{long_chunk * tile_size}, gain{tile_size};
        AlignedBuffer<Firing> firings{firing_list_capacity};
        AlignedBuffer<V> offsets{firing_list_capacity * 16};  // no vector has more than 16 lanes
        std::vector<V> saved_state = {};                      // copy of a tile's state, for check_rest()
        AlignedBuffer<V> from_sum = {}, to_sum = {};          // sums of `from` and `to` over the receptors of an afferent with several
    };

    /// The block that is being simulated.
    struct Block {
        const PopulationForce& force;
        std::size_t steps;
        bool shared_currents;       // true: all afferents have the same currents, apart from a gain
        std::uint64_t* spike_bits;  // PopulationResponse::spike_bits; null: spikes are listed
    };

    PopulationLayout<V> layout_;
    Method method_;
    bool spikes_on_samples_;
    std::uint64_t seed_;  // of random thresholds
    std::size_t tiles_;
    TileStates<V> states_;
    std::int64_t step_ = 0;  // number of samples simulated so far
    /// Set in the first block: which alternative of PopulationForce all blocks have, and whether the currents are shared.
    std::optional<std::pair<std::size_t, bool>> force_layout_;
    ProfileBuffers<V> profile_;
    std::vector<Scratch> scratch_;
    std::vector<JobResult> jobs_;
    AlignedBuffer<V> zero_rows_{long_chunk * tile_size};  // the force on a tile without force
    std::vector<std::size_t> begin_, at_;                 // scratch arrays of merge_spikes()

    /// Number of afferents of a tile, without padding.
    int tile_size_of(std::size_t tile) const { return static_cast<int>(std::min<std::size_t>(tile_size, layout_.size - tile * tile_size)); }
    /// One bit for each afferent of a tile: 1 unless it is padding.
    std::uint64_t valid_bits(std::size_t tile) const { return ~std::uint64_t{0} >> (tile_size - tile_size_of(tile)); }

    /// A call for a tile with its models and its state. `models` are the models of all tiles for `kernel`, or one model for all afferents.
    template <class Call, class Kernel>
    Call tile_call(const AlignedBuffer<std::byte>& models, const Kernel& kernel, std::size_t tile, V* state, int steps) const {
        const std::size_t stride = models.size() == kernel.model_bytes ? 0 : kernel.model_bytes;
        Call c{};
        c.models = models.data() + tile * (tile_size / static_cast<std::size_t>(layout_.lanes)) * stride, c.stride = stride;
        c.state = state, c.afferents = tile_size_of(tile), c.steps = steps;
        return c;
    }
    /// For the receptors of one of the forces on each afferent.
    template <class Call>
    Call receptor_tile(std::size_t tile, std::size_t force, int steps) const {
        const auto before = force * layout_.receptor->state_values * tile_size;
        return tile_call<Call>(layout_.receptors, *layout_.receptor, tile, states_.receptor(tile) + before, steps);
    }
    template <class Call>
    Call neuron_tile(std::size_t tile, int output, int steps) const {
        const auto before = static_cast<std::size_t>(output) * layout_.neuron->state_values * tile_size;
        return tile_call<Call>(layout_.neurons, *layout_.neuron, tile, states_.neuron(tile) + before, steps);
    }

    /// Transposes the columns of one of the forces on each afferent of a tile into rows, for `steps` steps from `step` of the block on.
    /// `first` is the tile's first afferent.
    void transpose_columns(const ForceColumns& columns, std::size_t first, std::size_t force, std::size_t step, int steps, V* rows) const {
        for (std::size_t u = 0; u < tile_size; ++u) {
            const double* column = columns.columns[std::min(first + u, layout_.size - 1) * layout_.forces + force] + step;
            for (int t = 0; t < steps; ++t) rows[static_cast<std::size_t>(t) * tile_size + u] = static_cast<V>(column[t]);
        }
    }

    /// The rows of force that the next chunk reads.
    template <class E>
    static PrefetchRange next_chunk(const E* rows, int steps) {
        const auto chunk_size = static_cast<std::size_t>(steps) * tile_size;
        return {reinterpret_cast<const char*>(rows + chunk_size), chunk_size * sizeof(E)};
    }
    /// Reduces `all` to its first half, which the receptors' loop prefetches. Returns the second half, for the neurons' loop.
    static PrefetchRange take_second_half(PrefetchRange& all) {
        all.bytes /= 2;
        return {all.at + all.bytes, all.bytes};
    }

    /// The array for the currents at the ends of steps. For a continuous receptor the current at the end of a step is also that at the
    /// beginning of the next one, so it is stored in `from`, one row further on.
    V* step_ends(Scratch& s) const { return layout_.receptor->continuous ? s.from.data() + tile_size : s.to.data(); }

    ReceptorCall<V> receptor_call(const Block& b, std::size_t tile, std::size_t force, std::size_t step, int steps, Scratch& s) const {
        auto c = receptor_tile<ReceptorCall<V>>(tile, force, steps);
        c.method = method_, c.from = s.from.data(), c.to = step_ends(s), c.gain = s.gain.data();
        const std::size_t row = ((tile * layout_.forces + force) * b.steps + step) * tile_size;
        if (const auto* columns = std::get_if<ForceColumns>(&b.force)) {
            transpose_columns(*columns, tile * tile_size, force, step, steps, s.rows.data());
            c.input = ForceInput::rows, c.rows = s.rows.data();
        } else if (const auto* tiles = std::get_if<ForceTiles<V>>(&b.force)) {
            c.input = ForceInput::rows;
            if (is_zero(b, tile, force))
                c.rows = zero_rows_.data();
            else
                c.rows = tiles->rows + row, c.prefetch = next_chunk(c.rows, steps);
        } else if (const auto* words = std::get_if<ForceInt16>(&b.force)) {
            c.input = ForceInput::int16, c.int16_rows = words->rows + row, c.scale = static_cast<V>(words->scale),
            c.prefetch = next_chunk(c.int16_rows, steps);
        } else {
            c.input = ForceInput::profile, c.profile = profile_.force() + step;
        }
        return c;
    }

    NeuronCall<V> neuron_call(const Block& b, std::size_t tile, int output, std::size_t step, int steps, Scratch& s,
                              SpikeCollector<V>& fired, PrefetchRange ahead) const {
        auto c = neuron_tile<NeuronCall<V>>(tile, output, steps);
        c.fired = &fired, c.prefetch = ahead;
        if (b.shared_currents) {
            const auto& [from, to, end_sum] = profile_.currents(output);
            c.from = from.data() + step, c.to = to.data() + step, c.end_sum = end_sum.data() + step, c.gain = s.gain.data();
        } else {
            c.to = step_ends(s) + output * current_rows<V> * tile_size;
            c.from = layout_.receptor->continuous && method_ != Method::exact ? c.to : s.from.data() + output * current_rows<V> * tile_size;
        }
        return c;
    }

    /// Simulates the receptors of a tile over a chunk, and returns memory for the neurons' loop to prefetch. `first`: the chunk is the
    /// first sample of the simulation.
    PrefetchRange run_receptors(const Block& b, std::size_t tile, std::size_t force, std::size_t step, int steps, bool first, Scratch& s,
                                JobResult& job) const {
        auto c = receptor_call(b, tile, force, step, steps, s);
        if (first) layout_.receptor->start(c);
        const auto ahead = take_second_half(c.prefetch);
        layout_.receptor->run(c);
        job.non_finite |= c.has_non_finite;
        return ahead;
    }

    /// Calls f(sum, current) with each value in the first `rows` rows of each output's currents and of their sums.
    template <class F>
    void for_each_current(AlignedBuffer<V>& sums, AlignedBuffer<V>& currents, std::size_t rows, const F& f) const {
        if (sums.size() == 0) sums = AlignedBuffer<V>(currents.size());
        for (std::size_t k = 0; k < static_cast<std::size_t>(layout_.receptor->outputs); ++k) {
            V* const sum = sums.data() + k * current_rows<V> * tile_size;
            V* const current = currents.data() + k * current_rows<V> * tile_size;
            for (std::size_t i = 0; i < rows * tile_size; ++i) f(sum[i], current[i]);
        }
    }
    /// Adds the currents of the receptors of one force to the sums. After the last force it replaces them by the mean over the forces.
    void add_currents(AlignedBuffer<V>& sums, AlignedBuffer<V>& currents, std::size_t rows, std::size_t force) const {
        const V factor = V(1) / static_cast<V>(layout_.forces);
        if (force == 0)
            for_each_current(sums, currents, rows, [](V& sum, V& current) { sum = current; });
        else
            for_each_current(sums, currents, rows, [](V& sum, V& current) { sum += current; });
        if (force + 1 == layout_.forces) for_each_current(sums, currents, rows, [factor](V& sum, V& current) { current = sum * factor; });
    }

    /// True if the receptors of each afferent of a tile have the same state and the same force over a chunk, to the bit. This is usual if
    /// only a contact wave reaches the tile.
    bool have_equal_receptors(const Block& b, std::size_t tile, std::size_t step, int steps) const {
        const auto* tiles = std::get_if<ForceTiles<V>>(&b.force);
        const std::size_t state = layout_.receptor->state_values * tile_size,
                          bytes = static_cast<std::size_t>(steps) * tile_size * sizeof(V);
        const auto rows = [&](std::size_t force) { return tiles->rows + ((tile * layout_.forces + force) * b.steps + step) * tile_size; };
        for (std::size_t force = 1; force < layout_.forces; ++force) {
            if (!tiles || is_zero(b, tile, force) != is_zero(b, tile, 0)) return false;
            if (!is_zero(b, tile, 0) && std::memcmp(rows(force), rows(0), bytes) != 0) return false;
            if (std::memcmp(states_.receptor(tile) + force * state, states_.receptor(tile), state * sizeof(V)) != 0) return false;
        }
        return true;
    }

    /// Simulates all receptors of a tile whose afferents have several forces. The neurons then read the mean of their currents.
    void run_all_receptors(const Block& b, std::size_t tile, std::size_t step, int steps, bool first, Scratch& s, JobResult& job) const {
        const auto rows = static_cast<std::size_t>(steps);
        const std::size_t state = layout_.receptor->state_values * tile_size;
        const bool are_equal = have_equal_receptors(b, tile, step, steps);
        for (std::size_t force = 0; force < layout_.forces; ++force) {
            if (force == 0 || !are_equal)
                (void)run_receptors(b, tile, force, step, steps, first, s, job);
            else  // the currents of the first receptor are also those of this one
                std::copy_n(states_.receptor(tile), state, states_.receptor(tile) + force * state);
            add_currents(s.from_sum, s.from, layout_.receptor->continuous ? rows + 1 : rows, force);
            if (!layout_.receptor->continuous) add_currents(s.to_sum, s.to, rows, force);
        }
    }

    /// Simulates `steps` steps of a tile, from `step` of the block on. The first sample of the simulation is a chunk by itself. The force
    /// before it is assumed to be the same. Backward Euler takes a step that ends at this sample, with its spikes on the sample. The exact
    /// method has no interval to integrate yet, so the neurons take no step.
    void run_chunk(const Block& b, std::size_t tile, std::size_t step, int steps, Scratch& s, JobResult& job) const {
        const bool first = step_ == 0 && step == 0, skips_neurons = first && method_ == Method::exact;
        SpikeCollector<V> fired{{s.firings.data(), spikes_on_samples_ || first ? nullptr : s.offsets.data(), 0, 0, valid_bits(tile), 0,
                                 [](FiringList<V>& list) { static_cast<SpikeCollector<V>&>(list).flush(); }},
                                job,
                                b.spike_bits ? b.spike_bits + tile * b.steps + step : nullptr,
                                static_cast<std::uint32_t>(tile * tile_size),
                                static_cast<std::uint32_t>(step),
                                layout_.lanes};
        if (layout_.fused && !b.shared_currents && !first) {
            layout_.fused->run(receptor_call(b, tile, 0, step, steps, s), neuron_call(b, tile, 0, step, steps, s, fired, {}));
        } else {
            PrefetchRange ahead{};
            if (layout_.forces > 1)
                run_all_receptors(b, tile, step, steps, first, s, job);
            else if (!b.shared_currents)
                ahead = run_receptors(b, tile, 0, step, steps, first, s, job);
            for (int k = 0; k < layout_.receptor->outputs; ++k) {
                const auto c = neuron_call(b, tile, k, step, steps, s, fired, k == 0 ? ahead : PrefetchRange{});
                if (first) start_neurons(c, tile, s);
                if (!skips_neurons) layout_.neuron->run(c);
                fired.flush();
            }
        }
        fired.flush();
        job.truncated_steps += fired.truncated_steps;
    }

    void start_neurons(NeuronCall<V> c, std::size_t tile, Scratch& s) const {
        for (std::size_t u = 0; u < tile_size; ++u) {
            const std::size_t afferent = std::min(tile * tile_size + u, layout_.size - 1);
            const auto number =
                layout_.afferent_numbers.empty() ? static_cast<std::uint32_t>(afferent) : layout_.afferent_numbers[afferent];
            s.rows.data()[u] = static_cast<V>(random_stream(seed_, number));
        }
        c.streams = s.rows.data();
        layout_.neuron->start(c);
    }

    /// True if one of the forces on each afferent is known to be zero on a tile during the block.
    bool is_zero(const Block& b, std::size_t tile, std::size_t force) const {
        const auto* tiles = std::get_if<ForceTiles<V>>(&b.force);
        return tiles && tiles->zero_force && tiles->zero_force[tile * layout_.forces + force];
    }
    /// True if all forces on a tile are known to be zero during the block.
    bool has_zero_force(const Block& b, std::size_t tile) const {
        for (std::size_t force = 0; force < layout_.forces; ++force)
            if (!is_zero(b, tile, force)) return false;
        return true;
    }

    /// Calls the models' flush_decayed() for the state of a tile.
    void flush_decayed(std::size_t tile) const {
        for (std::size_t force = 0; force < layout_.forces; ++force)
            (layout_.fused ? layout_.fused->flush_decayed : layout_.receptor->flush_decayed)(receptor_tile<TileCall<V>>(tile, force, 0));
        for (int k = 0; k < layout_.receptor->outputs; ++k) layout_.neuron->flush_decayed(neuron_tile<TileCall<V>>(tile, k, 0));
    }

    /// Takes one step of a tile without force. If no afferent fires, and neither this step nor flush_decayed() changes a bit of the tile's
    /// state, the tile is at rest. It is then skipped until there is force again.
    void check_rest(const Block& b, std::size_t tile, std::size_t step, Scratch& s, JobResult& job) {
        states_.copy(tile, s.saved_state);
        const auto fired = job.firings;
        run_chunk(b, tile, step, 1, s, job);
        if (job.firings != fired || !states_.equals(tile, s.saved_state)) return;
        flush_decayed(tile);
        states_.set_at_rest(tile, states_.equals(tile, s.saved_state));
        states_.restore(tile, s.saved_state);  // undoes flush_decayed()
    }

    /// Simulates a tile over a block, in chunks of as many steps as possible. A chunk ends before each flush_decayed(); the step of
    /// check_rest() is a chunk by itself. Returns the number of steps taken before the tile was found to be at rest.
    std::size_t run_tile(const Block& b, std::size_t tile, Scratch& s, JobResult& job) {
        constexpr std::int64_t rest_interval = 256;  // steps between calls of check_rest()
        const bool zero_force = has_zero_force(b, tile);
        if (!zero_force) states_.set_at_rest(tile, false);
        const std::int64_t max_steps = b.shared_currents ? 256 : layout_.fused ? long_chunk : chunk;
        std::size_t step = 0;
        while (step < b.steps && !states_.is_at_rest(tile)) {
            const std::int64_t now = step_ + static_cast<std::int64_t>(step);
            if (now % flush_interval == 0 && now > 0) flush_decayed(tile);
            // Steps until the next call of check_rest(), which is at the samples k with k mod 256 = 1.
            const std::int64_t to_check = (rest_interval + 1 - now % rest_interval) % rest_interval;
            if (zero_force && to_check == 0) {
                check_rest(b, tile, step++, s, job);
                continue;
            }
            std::int64_t steps = std::min({max_steps, static_cast<std::int64_t>(b.steps - step), flush_interval - now % flush_interval});
            if (zero_force) steps = std::min(steps, to_check);
            if (now == 0) steps = 1;
            run_chunk(b, tile, step, static_cast<int>(steps), s, job);
            step += static_cast<std::size_t>(steps);
        }
        return step;
    }

    /// Steps between checks for states that are NaN or infinite. Such a state does not become finite again, so short blocks need not check
    /// each time.
    static constexpr std::int64_t check_interval = 64;
    /// Simulates the tiles of job `number` over a block.
    void run_job(const Block& b, std::size_t number, Scratch& s) {
        auto& job = jobs_[number];
        const bool is_check_due = step_ / check_interval != (step_ + static_cast<std::int64_t>(b.steps)) / check_interval;
        job.events.clear(), job.truncated_steps = job.extra_spikes = job.skipped_steps = job.firings = 0, job.non_finite = false;
        for (std::size_t tile = number * tiles_per_job; tile < std::min(tiles_, (number + 1) * tiles_per_job); ++tile) {
            if (const auto* profile = std::get_if<ForceProfile>(&b.force)) profile_gains(*profile, tile * tile_size, s.gain.data());
            const std::size_t steps = run_tile(b, tile, s, job);
            job.skipped_steps += static_cast<std::int64_t>(b.steps - steps) * tile_size_of(tile);
            if (steps == 0 || !(is_check_due || states_.is_at_rest(tile))) continue;
            job.non_finite |= !states_.all_finite(tile);
        }
    }

    /// Force number `force` of an afferent at a step of the block, N, as the caller has passed it; integers are returned as 0.
    double force_of(const Block& b, std::size_t afferent, std::size_t force, std::size_t step) const {
        const std::size_t tile = afferent / tile_size;
        const std::size_t at = ((tile * layout_.forces + force) * b.steps + step) * tile_size + afferent % tile_size;
        if (const auto* columns = std::get_if<ForceColumns>(&b.force)) return columns->columns[afferent * layout_.forces + force][step];
        if (is_zero(b, tile, force)) return 0;
        if (const auto* tiles = std::get_if<ForceTiles<V>>(&b.force)) return static_cast<double>(tiles->rows[at]);
        if (const auto* profile = std::get_if<ForceProfile>(&b.force)) return profile->force[step];
        return 0;  // integers are always finite
    }

    /// Returns an error if a force in the block is NaN or infinite, and sets the afferent that failed.
    Result<void> check_finite_force(const Block& b, PopulationResponse& response) const {
        for (std::size_t k = 0; k < layout_.size * layout_.forces; ++k)
            for (std::size_t step = 0; step < b.steps; ++step)
                if (const double f = force_of(b, k / layout_.forces, k % layout_.forces, step); !std::isfinite(f)) {
                    response.failed_afferent = k / layout_.forces;
                    return bad_input(
                        fmt::format("{}: the force of sample {} is {}", layout_.name, step_ + static_cast<std::int64_t>(step), f));
                }
        return {};
    }

    /// Returns an error if a job has met a force or a state that is NaN or infinite.
    Result<void> check_jobs(const Block& b, PopulationResponse& response) const {
        if (std::none_of(jobs_.begin(), jobs_.end(), [](const JobResult& job) { return job.non_finite; })) return {};
        TRY(check_finite_force(b, response));
        for (std::size_t afferent = 0; afferent < layout_.size; ++afferent) {
            if (!states_.has_non_finite(afferent)) continue;
            response.failed_afferent = afferent;
            return Error{ErrorCode::not_converged,
                         fmt::format("{}: its state became NaN or infinite between samples {} and {}; the force or a gain is far too "
                                     "large, or the substep too long",
                                     layout_.name, step_ / check_interval * check_interval, step_ + static_cast<std::int64_t>(b.steps))};
        }
        return {};  // only padding of the last tile has such states
    }

    /// True if the currents of a profile are computed once for all afferents.
    bool shares_currents(const PopulationForce& force) const {
        const auto* profile = std::get_if<ForceProfile>(&force);
        return profile && layout_.shared_receptor && (profile->gain.empty() || layout_.receptor->scales_with_force);
    }

    /// Checks the force of a block, and that it has the same layout as in the blocks before.
    Result<void> check(const PopulationForce& force, std::size_t steps) {
        const std::pair kind(force.index(), shares_currents(force));
        if (force_layout_ && *force_layout_ != kind)
            return bad_input(fmt::format("{}: the layout of its force must not change between blocks", layout_.name));
        TRY(check_force<V>(force, steps, layout_.size, layout_.forces, layout_.name));
        force_layout_ = kind;
        return {};
    }

public:
    TiledPopulation(PopulationLayout<V> layout, const SimulationOptions& run)
        : layout_(std::move(layout)), method_(run.method), spikes_on_samples_(run.spikes_on_samples), seed_(run.seed),
          tiles_((layout_.size + tile_size - 1) / tile_size),
          states_(tiles_, layout_.receptor->state_values * layout_.forces,
                  layout_.neuron->state_values * static_cast<std::size_t>(layout_.receptor->outputs)),
          jobs_((tiles_ + tiles_per_job - 1) / tiles_per_job) {}

    std::size_t size() const override { return layout_.size; }
    std::int64_t step() const override { return step_; }

    std::vector<double> save() const override {
        // In order: the step, the layout of the force as one number (0 if there was no block yet), the states, and that of the shared
        // receptor.
        std::vector<double> all = {static_cast<double>(step_),
                                   force_layout_ ? static_cast<double>(1 + 2 * force_layout_->first + force_layout_->second) : 0.0};
        states_.save(all);
        if (layout_.shared_receptor) {
            const auto profile = layout_.shared_receptor->save();
            all.insert(all.end(), profile.begin(), profile.end());
        }
        return all;
    }

    Result<void> resume(std::span<const double> all) override {
        constexpr double last_step = 1LL << 53, kinds = 2 * std::variant_size_v<PopulationForce>;
        const std::size_t own_values = 2 + states_.size();  // values without those of the shared receptor
        const auto is_integer = [](double x, double max) { return x >= 0 && x <= max && x == std::floor(x); };
        const bool fits = all.size() >= own_values && is_integer(all[0], last_step) && is_integer(all[1], kinds) &&
                          (layout_.shared_receptor ? layout_.shared_receptor->resume(all.subspan(own_values)) : all.size() == own_values) &&
                          states_.resume(all.subspan(2, states_.size()));
        if (!fits)
            return bad_input(fmt::format("{}: a saved state with {} values is not one of this population", layout_.name, all.size()));
        step_ = static_cast<std::int64_t>(all[0]);
        const auto kind = static_cast<std::size_t>(all[1]);
        force_layout_ = kind == 0 ? std::nullopt : std::optional(std::pair((kind - 1) / 2, (kind - 1) % 2 == 1));
        return {};
    }

    Result<void> respond(const PopulationForce& force, std::size_t steps, PopulationResponse& response, ThreadPool& pool) override {
        TRY(check(force, steps));
        if (steps == 0) return {};
        Block block{force, steps, shares_currents(force), nullptr};
        if (const auto* profile = std::get_if<ForceProfile>(&force)) {
            if (const auto at = first_non_finite(profile->force.first(steps)); at < steps) return check_finite_force(block, response);
            const auto now = profile->force.first(steps);
            block.shared_currents ? profile_.compute_currents(*layout_.shared_receptor, now, step_ == 0, layout_.receptor->outputs)
                                  : profile_.set_force(now);
        }
        if (response.spike_bits) response.spike_bits->assign(tiles_ * steps, 0), block.spike_bits = response.spike_bits->data();
        while (scratch_.size() < pool.threads()) scratch_.emplace_back();
        pool.for_each(jobs_.size(), [&](std::size_t job, unsigned thread) { run_job(block, job, scratch_[thread]); });
        for (const auto& job : jobs_)
            response.truncated_steps += job.truncated_steps, response.extra_spikes += job.extra_spikes,
                response.skipped_steps += job.skipped_steps;
        TRY(check_jobs(block, response));
        if (response.spikes) merge_spikes(jobs_, steps, step_, layout_.afferent_numbers, *response.spikes, begin_, at_);
        step_ += static_cast<std::int64_t>(steps);
        return {};
    }
};

}  // namespace corpuscle::lanes
