// The ring that hands frames and spikes from a stream to the page server.

#include <thread>

#include "live/serve/frame_ring.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(FrameRing, PassesTouchedSitesAndAllSpikes) {
    FrameRing ring(4, 1000);
    FrameBatch batch;
    const double force[] = {0, 0.5, 0, 2};
    const Spike spikes[] = {{7, 0.25, 3}, {7, 0.5, 1}};
    ring.add_frame(0, force), ring.add_spikes(spikes);
    EXPECT_FALSE(ring.take(batch)) << "nothing is put while no page is connected";
    ring.set_watched(true);
    ring.add_frame(7, force), ring.add_spikes(spikes), ring.add_spikes({});
    ASSERT_TRUE(ring.take(batch));
    EXPECT_EQ(batch.frames, std::vector<std::int64_t>({7}));
    EXPECT_EQ(batch.touched, std::vector<std::uint32_t>({2}));
    EXPECT_EQ(batch.sites, std::vector<std::uint32_t>({1, 3}));
    EXPECT_EQ(batch.force, std::vector<float>({0.5F, 2.0F}));
    EXPECT_EQ(batch.spikes, std::vector<Spike>(std::begin(spikes), std::end(spikes)));
    EXPECT_EQ(batch.lost_frames + batch.lost_spikes, 0);
    EXPECT_FALSE(ring.take(batch));
}

TEST(FrameRing, PassesForcesOfFewSitesInEveryFrameAndOfManySixtyTimesASecond) {
    EXPECT_EQ(FrameRing::force_interval(16, 1000), 1);
    EXPECT_EQ(FrameRing::force_interval(1000, 1000), 10);
    EXPECT_EQ(FrameRing::force_interval(20000, 1000), 16);
    EXPECT_EQ(FrameRing::force_interval(20000, 30), 1);
    EXPECT_EQ(FrameRing::force_interval(0, 1e6), 10);
    FrameRing ring(20000, 1000);
    ring.set_watched(true);
    const std::vector<double> force(20000, 1.0);
    for (int k = 0; k < 48; ++k) ring.add_frame(k, force);
    FrameBatch batch;
    ASSERT_TRUE(ring.take(batch));
    EXPECT_EQ(batch.frames, std::vector<std::int64_t>({0, 16, 32}));
}

TEST(FrameRing, CountsTheFramesAndSpikesThatItHasNoSpaceFor) {
    FrameRing ring(100, 1000, 1 << 14);
    ring.set_watched(true);
    const std::vector<double> force(100, 1.0);
    const std::vector<Spike> spikes(1300, Spike{1, 0.5, 2});
    std::int64_t frames = 0, seen_spikes = 0, lost_frames = 0, lost_spikes = 0;
    FrameBatch batch;
    for (int k = 0; k < 100; ++k) ring.add_frame(k, force), ring.add_spikes(spikes);
    for (int round = 0; round < 3; ++round) {
        while (ring.take(batch, 3000)) {
            frames += static_cast<std::int64_t>(batch.frames.size()), seen_spikes += static_cast<std::int64_t>(batch.spikes.size());
            lost_frames += batch.lost_frames, lost_spikes += batch.lost_spikes;
        }
        if (round < 2) ring.add_frame(100 + round, force);  // the next record says how many were lost before it
    }
    EXPECT_GT(lost_frames, 0);
    EXPECT_GT(lost_spikes, 0);
    EXPECT_EQ(frames + lost_frames, 102);
    EXPECT_EQ(seen_spikes + lost_spikes, 130000);
}

TEST(FrameRing, IsReadInAnotherThreadWithoutLoss) {
    FrameRing ring(50, 1000, 1 << 14);
    ring.set_watched(true);
    constexpr std::int64_t count = 20000;
    std::atomic<bool> is_done = false;
    std::int64_t put_spikes = 0;
    const auto add_frame = [&](std::int64_t k) {
        std::vector<double> force(50);
        for (std::size_t s = 0; s < force.size(); ++s) force[s] = static_cast<double>((static_cast<std::int64_t>(s) + k) % 3);
        ring.add_frame(k, force);
    };
    std::thread writer([&] {
        for (std::int64_t k = 0; k < count; ++k) {
            add_frame(k);
            const std::vector<Spike> spikes(static_cast<std::size_t>(k % 5), Spike{k, 0.5, static_cast<std::uint32_t>(k % 50)});
            ring.add_spikes(spikes), put_spikes += k % 5;
        }
        is_done = true;
    });
    FrameBatch batch;
    std::int64_t next = 0, spikes = 0, last_step = 0, last_frame = -1;
    const auto read = [&]() -> void {
        while (ring.take(batch)) {
            next += batch.lost_frames, spikes += batch.lost_spikes;
            std::size_t at = 0;
            for (std::size_t k = 0; k < batch.frames.size(); ++k) {
                for (std::uint32_t n = 0; n < batch.touched[k]; ++n, ++at)
                    ASSERT_EQ(batch.force[at], static_cast<float>((batch.sites[at] + batch.frames[k]) % 3));
                EXPECT_GT(batch.frames[k], last_frame);
                last_frame = batch.frames[k], next += 1;
            }
            for (const auto& s : batch.spikes) {
                EXPECT_GE(s.step, last_step);
                last_step = s.step;
            }
            spikes += static_cast<std::int64_t>(batch.spikes.size());
        }
    };
    while (!is_done) read(), std::this_thread::yield();
    writer.join();
    read();
    add_frame(count);  // tells the last losses
    read();
    EXPECT_EQ(next, count + 1);
    EXPECT_EQ(spikes, put_spikes);
}

}  // namespace
}  // namespace corpuscle
