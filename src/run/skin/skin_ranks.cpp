#include "run/skin/skin_ranks.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace corpuscle {
namespace {

static_assert(std::is_trivially_copyable_v<Spike> && std::is_trivially_copyable_v<SkinStats>, "they are sent as their bytes");

void send_spikes(Ranks& ranks, const std::vector<Spike>& spikes) {
    ranks.send(0, std::string(reinterpret_cast<const char*>(spikes.data()), spikes.size() * sizeof(Spike)));
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
        send_spikes(ranks, spikes);
    }
    skin.finish(spikes);
    send_spikes(ranks, spikes);
    const auto stats = skin.stats();
    ranks.send(0, std::string(reinterpret_cast<const char*>(&stats), sizeof stats));
    return {};
}

}  // namespace

Result<void> gather_spikes(Ranks& ranks, std::vector<Spike>& spikes) {
    for (int rank = 1; rank < ranks.size(); ++rank) {
        const auto message = TRY(ranks.receive(rank));
        const auto before = spikes.size();
        spikes.resize(before + message.size() / sizeof(Spike));
        std::copy_n(message.data(), (spikes.size() - before) * sizeof(Spike), reinterpret_cast<char*>(spikes.data() + before));
    }
    std::sort(spikes.begin(), spikes.end());
    return {};
}

Result<void> gather_stats(Ranks& ranks, SkinStats& stats) {
    for (int rank = 1; rank < ranks.size(); ++rank) {
        const auto message = TRY(ranks.receive(rank));
        SkinStats worker;  // its `steps` are the same for all ranks
        std::memcpy(&worker, message.data(), std::min(sizeof worker, message.size()));
        stats.afferent_steps += worker.afferent_steps, stats.skipped_steps += worker.skipped_steps;
        stats.spikes += worker.spikes, stats.truncated_steps += worker.truncated_steps;
    }
    return {};
}

void run_skin_worker(Ranks& ranks, Result<SkinForce*> force, Skin* skin, ThreadPool& pool) {
    const auto done = force ? simulate_rank_afferents(ranks, **force, *skin, pool) : Result<void>(force.error());
    if (!done) ranks.send_error(done.error());
}

}  // namespace corpuscle
