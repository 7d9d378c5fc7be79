#include "run/skin/skin_simulator.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "core/bytes.hpp"
#include "skin/shear_force.hpp"

namespace corpuscle {
namespace {

/// Checkpoints are so far apart that the cost of saving is negligible.
constexpr std::chrono::seconds save_interval{10};

/// For a worker: sends a value to the coordinator.
template <class T>
void send_value(Ranks& ranks, const T& value) {
    ByteWriter message;
    message.put(value);
    ranks.send(0, message.bytes());
}

/// For the coordinator: the value that a worker has sent, or its error.
template <class T>
Result<T> receive_value(Ranks& ranks, int rank) {
    const auto message = TRY(ranks.receive(rank));
    ByteReader in(message);
    T value{};
    if (in.get(value) && in.ended()) return value;
    return bad_input("the ranks run different versions of corpuscle; install the same one on all machines");
}

/// Simulates the afferents of this rank. Each block is a message of spikes; one more has the spikes that are still being conducted at the
/// end of the force, and the last one the statistics.
Result<void> simulate_rank_afferents(Ranks& ranks, SkinForce& force, Skin& skin, ThreadPool& pool) {
    std::vector<Spike> spikes;
    for (;; spikes.clear()) {
        const auto block = TRY(force.next());
        const auto steps = block.total_force.size();
        if (steps == 0) break;
        TRY(skin.respond(block.force, steps, spikes, pool));
        send_value(ranks, spikes);
    }
    skin.finish(spikes);
    send_value(ranks, spikes);
    send_value(ranks, skin.stats());
    return {};
}

/// For rank 0: adds the spikes of all workers for one block to its own, and sorts them. Returns the error of a worker, if it had one.
Result<void> gather_spikes(Ranks& ranks, std::vector<Spike>& spikes) {
    for (int rank = 1; rank < ranks.size(); ++rank) {
        const auto theirs = TRY(receive_value<std::vector<Spike>>(ranks, rank));
        spikes.insert(spikes.end(), theirs.begin(), theirs.end());
    }
    std::sort(spikes.begin(), spikes.end());
    return {};
}

/// For rank 0, after the last block: adds the workers' statistics to its own.
Result<void> gather_stats(Ranks& ranks, SkinStats& stats) {
    for (int rank = 1; rank < ranks.size(); ++rank) {
        const auto worker = TRY(receive_value<SkinStats>(ranks, rank));  // its `steps` are the same for all ranks
        stats.afferent_steps += worker.afferent_steps, stats.skipped_steps += worker.skipped_steps;
        stats.spikes += worker.spikes, stats.truncated_steps += worker.truncated_steps;
    }
    return {};
}

}  // namespace

Result<SkinProbes> SkinProbes::make(const Innervation& skin, const SimulationOptions& run) {
    SkinProbes out;
    out.skin_ = &skin;
    for (std::size_t c = 0; c < skin.plan.classes.size(); ++c) {
        const auto& plan = skin.plan.classes[c];
        const auto count = skin.class_begin[c + 1] - skin.class_begin[c];
        if (count > max_afferents)
            return bad_usage(
                fmt::format("--probe-files works with at most {} afferents of a class, but {} has {} of {}; use fewer, such as "
                            "--population 'grid 4x4'",
                            max_afferents, skin.plan.name, count, plan.name));
        if (plan.receptors() > 1)
            return bad_usage(
                fmt::format("--probe-files cannot record {}: each of its hot spots has a receptor of its own; use a population "
                            "file whose class has receptors = \"one\"",
                            plan.name));
        const auto plans = TRY(make_copies(plan.afferent, static_cast<std::uint32_t>(count), plan.distributions, skin.plan.seed));
        for (const auto& afferent : plans) {
            out.afferents_.push_back(make_afferent(afferent, run));
            out.states_.push_back(out.afferents_.back()->start());
            out.values_.emplace_back(out.afferents_.back()->probes().size());
        }
    }
    out.sums_.resize(out.afferents_.size());
    for (std::size_t c = 0; c < skin.plan.classes.size(); ++c) {
        out.waves_.emplace_back();
        const auto count = skin.class_begin[c + 1] - skin.class_begin[c];
        if (skin.plan.classes[c].wave.speed > 0 && count > 0)
            out.waves_[c] = TRY(ContactWave::make(skin, c, 0, count, run.dt, *instruction_set()));
    }
    return out;
}

std::vector<std::span<const Probe>> SkinProbes::class_probes() const {
    std::vector<std::span<const Probe>> out;
    for (std::size_t c = 0; c < skin_->plan.classes.size(); ++c) {
        const auto first = skin_->class_begin[c];
        out.push_back(first < skin_->class_begin[c + 1] ? afferents_[first]->probes() : std::span<const Probe>{});
    }
    return out;
}

/// Sums one component of the force over the receptive fields. Adds the contributions of the sites in ascending order, as FieldForce does.
void SkinProbes::sum_component(const SiteForce& force, const double* component, std::size_t steps) {
    for (auto& f : sums_) f.assign(steps, 0);
    force.for_each_site(skin_->plan.sites.size(), [&](std::size_t s) {
        const double* const at_site = component + s * force.stride;
        for (std::size_t c = 0; c < skin_->fields.size(); ++c) {
            const auto& fields = skin_->fields[c];
            for (auto k = fields.begin[s]; k < fields.begin[s + 1]; ++k) {
                auto& on_afferent = sums_[skin_->class_begin[c] + fields.afferent[k]];
                for (std::size_t t = 0; t < steps; ++t) on_afferent[t] += fields.weight[k] * at_site[t];
            }
        }
    });
}

void SkinProbes::compute_force(const SiteForce& force, std::size_t steps) {
    sum_component(force, force.data, steps);
    force_ = sums_;
    const std::array<const double*, 2> components{force.shear_x, force.shear_y};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        if (!components[axis]) continue;
        sum_component(force, components[axis], steps);
        for (std::size_t u = 0; u < force_.size(); ++u) {
            const auto& afferent = skin_->afferents[u];
            const double gain = shear_gains(skin_->plan.classes[afferent.class_index].direction, afferent)[axis];
            for (std::size_t t = 0; t < steps && gain != 0; ++t) force_[u][t] += gain * sums_[u][t];
        }
    }
}

/// Adds the contact waves to the force on the afferents.
void SkinProbes::add_waves(const SiteForce& force, std::size_t steps, ThreadPool& pool) {
    touched_.clear();
    force.for_each_site(skin_->plan.sites.size(), [this](std::size_t s) { touched_.push_back(static_cast<std::uint32_t>(s)); });
    for (std::size_t c = 0; c < waves_.size(); ++c)
        for (std::size_t at = 0; waves_[c] && at < steps; at += WaveSources::max_steps) {
            const auto count = std::min(WaveSources::max_steps, steps - at);
            waves_[c]->compute(force, touched_, at, count, pool);
            for (auto u = skin_->class_begin[c]; u < skin_->class_begin[c + 1]; ++u)
                if (const double* wave = waves_[c]->force_on(u - skin_->class_begin[c]))
                    for (std::size_t t = 0; t < count; ++t) force_[u][at + t] += wave[t];
        }
}

Result<void> SkinProbes::respond(const SiteForce& force, std::size_t steps, ThreadPool& pool) {
    compute_force(force, steps);
    add_waves(force, steps, pool);
    std::vector<Result<void>> results(afferents_.size());
    pool.for_each(afferents_.size(), [&](std::size_t u, unsigned) {
        std::vector<double*> arrays;
        for (auto& values : values_[u]) values.resize(steps), arrays.push_back(values.data());
        std::vector<Spike> spikes;
        ResponseBlock response{spikes, 0, arrays};
        results[u] = afferents_[u]->respond(force_[u], states_[u], response);
    });
    for (auto& result : results)
        if (!result) return result;
    return {};
}

Result<void> SkinSimulator::start(const RespondOptions& options, bool wants_probes) {
    if (!wants_probes) return {};
    probes_ = TRY(SkinProbes::make(skin_.innervation(), options.for_clock(input_.clock)));
    population_.set_probes(probes_->class_probes());
    return {};
}

/// Computes the spikes of a block or, if an earlier run has simulated it, reads them from the checkpoint.
Result<void> SkinSimulator::simulate(const SkinForce::Block& block, ThreadPool& pool) {
    spikes_.clear();
    const auto steps = block.total_force.size();
    if (checkpoint_) TRY(checkpoint_->add_force(block, samples_));
    if (checkpoint_ && samples_ < checkpoint_->resumed_samples())
        return checkpoint_->replay(samples_ + static_cast<std::int64_t>(steps), spikes_);
    TRY(skin_.respond(block.force, steps, spikes_, pool));
    if (ranks_) TRY(gather_spikes(*ranks_, spikes_));
    return checkpoint_ ? checkpoint_->append(spikes_) : Result<void>{};
}

Result<RunBlock> SkinSimulator::next(ThreadPool& pool, RunStats&) {
    const auto block = TRY(force_.next());
    const auto steps = block.total_force.size();
    if (steps == 0) return RunBlock{};
    TRY(simulate(block, pool));
    if (probes_) TRY(probes_->respond(block.force, steps, pool));
    total_force_ = block.total_force;
    const auto first = std::exchange(samples_, samples_ + static_cast<std::int64_t>(steps));
    RunBlock response{first, steps, {&total_force_, 1}, block.force, spikes_};
    if (probes_) response.probes = probes_->values();
    return response;
}

Result<void> SkinSimulator::save(bool stops) {
    if (!checkpoint_ || samples_ <= checkpoint_->resumed_samples()) return {};
    const auto now = std::chrono::steady_clock::now();
    if (!stops && now - last_save_ < save_interval) return {};
    last_save_ = now;
    return checkpoint_->flush();
}

Result<void> SkinSimulator::finish(std::vector<Spike>& last, RunStats& stats) {
    if (checkpoint_) TRY(checkpoint_->finish(samples_));
    skin_.finish(last);
    auto work = skin_.stats();
    if (ranks_) {
        TRY(gather_spikes(*ranks_, last));
        TRY(gather_stats(*ranks_, work));
    }
    stats.samples += work.steps, stats.afferent_steps += work.afferent_steps, stats.skipped_steps += work.skipped_steps;
    stats.spikes += work.spikes, stats.truncated_steps += work.truncated_steps;
    input_.quality = force_.quality();
    return {};
}

void run_skin_worker(Ranks& ranks, Result<SkinForce*> force, Skin* skin, ThreadPool& pool) {
    const auto done = force ? simulate_rank_afferents(ranks, **force, *skin, pool) : Result<void>(force.error());
    if (!done) ranks.send_error(done.error());
}

}  // namespace corpuscle
