#include "live/serve/frame_ring.hpp"

namespace corpuscle {
namespace {

constexpr double min_force_rate = 60;          // Hz: a display shows no more
constexpr double max_values_per_second = 1e5;  // of forces, if that allows more than min_force_rate

}  // namespace

void FrameBatch::clear() {
    frames.clear(), touched.clear(), sites.clear(), force.clear(), spikes.clear();
    lost_frames = lost_spikes = 0;
}

std::int64_t FrameRing::force_interval(std::size_t sites, double rate) {
    const double force_rate = std::max(min_force_rate, max_values_per_second / static_cast<double>(std::max<std::size_t>(sites, 1)));
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(rate / force_rate));
}

FrameRing::FrameRing(std::size_t sites, double rate, std::size_t min_bytes)
    : ring_(std::max(min_bytes, 4 * (sizeof(Head) + sites * sizeof(SiteForceValue)))), frames_per_force_(force_interval(sites, rate)),
      record_(sizeof(Head) + std::max(sites * sizeof(SiteForceValue), max_spikes * sizeof(Spike))) {}

/// Puts the record whose values, `value_bytes` of them, are already in record_. Returns false if there is no space.
bool FrameRing::put(std::int64_t frame, std::uint32_t count, bool has_force, std::size_t value_bytes) {
    const Head head = {frame, count, has_force, lost_frames_, lost_spikes_};
    std::memcpy(record_.data(), &head, sizeof head);
    if (!ring_.put({record_.data(), sizeof head + value_bytes})) return false;
    lost_frames_ = lost_spikes_ = 0;
    return true;
}

void FrameRing::add_frame(std::int64_t frame, std::span<const double> force) {
    if (frame % frames_per_force_ != 0 || !is_watched_.load(std::memory_order_acquire)) return;
    std::uint32_t touched = 0;
    char* at = record_.data() + sizeof(Head);
    for (std::uint32_t s = 0; s < force.size(); ++s) {
        if (force[s] == 0) continue;
        const SiteForceValue value = {s, static_cast<float>(force[s])};
        std::memcpy(at, &value, sizeof value);
        at += sizeof value, ++touched;
    }
    if (!put(frame, touched, true, touched * sizeof(SiteForceValue))) ++lost_frames_;
}

void FrameRing::add_spikes(std::span<const Spike> spikes) {
    if (spikes.empty() || !is_watched_.load(std::memory_order_acquire)) return;
    while (!spikes.empty()) {
        const auto some = spikes.first(std::min(spikes.size(), max_spikes));
        std::memcpy(record_.data() + sizeof(Head), some.data(), some.size_bytes());
        if (!put(0, static_cast<std::uint32_t>(some.size()), false, some.size_bytes()))
            lost_spikes_ += static_cast<std::int64_t>(some.size());
        spikes = spikes.subspan(some.size());
    }
}

/// Reads bytes of a record. Records are put as a whole, so that all of its bytes are there.
void FrameRing::read(void* to, std::size_t bytes) {
    for (auto* at = static_cast<char*>(to); bytes > 0;) {
        const auto chunk = ring_.readable().substr(0, bytes);
        std::memcpy(at, chunk.data(), chunk.size());
        ring_.consume(chunk.size());
        at += chunk.size(), bytes -= chunk.size();
    }
}

bool FrameRing::take(FrameBatch& batch, std::size_t max_bytes) {
    batch.clear();
    const auto end = ring_.total_taken() + std::min(ring_.filled(), max_bytes);
    if (ring_.total_taken() == end) return false;
    while (ring_.total_taken() < end) {
        Head head;
        read(&head, sizeof head);
        batch.lost_frames += head.lost_frames, batch.lost_spikes += head.lost_spikes;
        if (head.has_force == 0) {
            const auto before = batch.spikes.size();
            batch.spikes.resize(before + head.count);
            read(batch.spikes.data() + before, head.count * sizeof(Spike));
            continue;
        }
        batch.frames.push_back(head.frame), batch.touched.push_back(head.count);
        for (std::uint32_t k = 0; k < head.count; ++k) {
            SiteForceValue value;
            read(&value, sizeof value);
            batch.sites.push_back(value.site), batch.force.push_back(value.force);
        }
    }
    return true;
}

}  // namespace corpuscle
