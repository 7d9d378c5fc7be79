#include "run/skin/skin_ranks.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

namespace corpuscle {
namespace {

/// The first byte of a message between the ranks of a skin run.
enum SkinMessage : char {
    spikes_of_block = 's',  ///< from a worker: any number of PackedRankSpike
    worker_stats = 'w',     ///< from a worker, its last message: SkinStats
    worker_error = 'e',     ///< from a worker: an error code, one byte, and the text of the error
    acknowledged = 't',     ///< from the coordinator: the spikes of a block were received
    shutdown = 'd',         ///< from the coordinator: the run is over
};

/// A worker waits when it has sent this many messages that are not acknowledged.
constexpr int max_unacknowledged = 8;

struct PackedRankSpike {
    std::int64_t step;
    double offset;
    std::uint64_t afferent_index;
};

/// A message with the spikes of one block, in the byte order of this machine.
std::string pack_spikes(const std::vector<Spike>& spikes) {
    std::string text(1 + spikes.size() * sizeof(PackedRankSpike), spikes_of_block);  // the first byte is the type
    for (std::size_t k = 0; k < spikes.size(); ++k) {
        const PackedRankSpike s{spikes[k].step, spikes[k].offset, spikes[k].afferent_index};
        std::memcpy(text.data() + 1 + k * sizeof s, &s, sizeof s);
    }
    return text;
}

/// Appends the spikes of a message.
void unpack_into(const std::string& text, std::vector<Spike>& spikes) {
    for (std::size_t at = 1; at + sizeof(PackedRankSpike) <= text.size(); at += sizeof(PackedRankSpike)) {
        PackedRankSpike s;
        std::memcpy(&s, text.data() + at, sizeof s);
        spikes.push_back({s.step, s.offset, static_cast<std::uint32_t>(s.afferent_index)});
    }
}

std::string pack_error(const Error& error) { return std::string(1, worker_error) + static_cast<char>(error.code) + error.text(); }

void pause_briefly() { std::this_thread::sleep_for(std::chrono::microseconds(20)); }

/// A worker's connection to the coordinator. Counts the messages that are not acknowledged yet.
class WorkerChannel {
    Ranks& ranks_;
    int unacknowledged_ = 0;
    bool is_shut_down_ = false;

    void receive() {
        while (auto m = ranks_.receive()) {
            if (m->message[0] == acknowledged) --unacknowledged_;
            if (m->message[0] == shutdown) is_shut_down_ = true;
        }
    }

public:
    explicit WorkerChannel(Ranks& ranks) : ranks_(ranks) {}
    /// Sends a message, and waits while too many are not acknowledged. Returns false if the coordinator has shut the run down.
    bool send(std::string text) {
        ++unacknowledged_;
        ranks_.send(0, std::move(text));
        for (receive(); !is_shut_down_ && unacknowledged_ >= max_unacknowledged; receive()) pause_briefly();
        return !is_shut_down_;
    }
    /// Waits until the coordinator has shut the run down and all messages have been sent.
    void wait_for_shutdown() {
        for (receive(); !is_shut_down_ || ranks_.unsent() > 0; receive()) pause_briefly();
    }
};

/// Simulates the afferents of this rank. Returns false if the coordinator shut the run down before the end of the force.
Result<bool> simulate_rank_afferents(WorkerChannel& channel, SkinForce& force, Skin& skin, ThreadPool& pool) {
    std::vector<Spike> spikes;
    for (;;) {
        auto block = TRY(force.next());
        if (block.total_force.empty()) break;
        spikes.clear();
        TRY(skin.respond(block.force, block.total_force.size(), spikes, pool));
        if (!channel.send(pack_spikes(spikes))) return false;
    }
    spikes.clear();
    skin.finish(spikes);
    if (!channel.send(pack_spikes(spikes))) return false;
    const auto stats = skin.stats();
    return channel.send(std::string(1, worker_stats) + std::string(reinterpret_cast<const char*>(&stats), sizeof stats));
}

}  // namespace

/// Waits for the next message of a rank. If it is an error, returns this error.
Result<std::string> SkinWorkers::next_from(int rank) {
    auto& queue = received_[static_cast<std::size_t>(rank)];
    while (queue.empty()) {
        if (auto m = ranks_.receive())
            received_[static_cast<std::size_t>(m->from)].push_back(std::move(m->message));
        else
            pause_briefly();
    }
    auto text = std::move(queue.front());
    queue.pop_front();
    if (text[0] == worker_error) return Error{static_cast<ErrorCode>(static_cast<unsigned char>(text[1])), text.substr(2)};
    return text;
}

Result<void> SkinWorkers::gather(std::vector<Spike>& spikes) {
    for (int rank = 1; rank < ranks_.size(); ++rank) {
        auto text = TRY(next_from(rank));
        unpack_into(text, spikes);
        ranks_.send(rank, std::string(1, acknowledged));
    }
    (void)ranks_.unsent();  // frees the acknowledgements that have been sent
    std::sort(spikes.begin(), spikes.end());
    return {};
}

Result<void> SkinWorkers::finish(std::vector<Spike>& spikes, SkinStats& stats) {
    TRY(gather(spikes));
    for (int rank = 1; rank < ranks_.size(); ++rank) {
        auto text = TRY(next_from(rank));
        SkinStats worker;  // its `steps` are the same for all ranks
        std::memcpy(&worker, text.data() + 1, std::min(sizeof worker, text.size() - 1));
        stats.afferent_steps += worker.afferent_steps, stats.skipped_steps += worker.skipped_steps;
        stats.spikes += worker.spikes, stats.truncated_steps += worker.truncated_steps;
    }
    return {};
}

void shut_down_skin_workers(Ranks& ranks) {
    for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, std::string(1, shutdown));
    while (ranks.unsent() > 0) {
        (void)ranks.receive();
        pause_briefly();
    }
    ranks.leave(true);
}

void run_skin_worker(Ranks& ranks, Result<SkinForce*> force, Skin* skin, ThreadPool& pool) {
    WorkerChannel channel(ranks);
    auto done = force ? simulate_rank_afferents(channel, **force, *skin, pool) : Result<bool>(force.error());
    if (!done) (void)channel.send(pack_error(done.error()));
    channel.wait_for_shutdown();
    ranks.leave(true);
}

}  // namespace corpuscle
