// The steps of a live stream: bytes to frames, the order of frames, a skin simulated frame by frame, spikes to bytes.

#include <bit>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include "corpuscle.h"
#include "io/spikes/events.hpp"
#include "io/spikes/spike_files.hpp"
#include "live/input/byte_source.hpp"
#include "live/input/frame_decoder.hpp"
#include "live/input/frame_layout.hpp"
#include "live/input/frame_source.hpp"
#include "live/latency_histogram.hpp"
#include "live/live_population.hpp"
#include "live/output/event_sink.hpp"
#include "live/stream_state.hpp"
#include "model/catalog.hpp"
#include "skin/plan/sites.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::applied_or_throw;
using test::TemporaryFolder;
using test::value_or_throw;

std::string bytes_of(const EventFormat& format, std::span<const Spike> spikes) {
    std::string out;
    std::vector<char> event(format.max_bytes());
    for (const auto& s : spikes) out.append(event.data(), format.write(s, event.data()));
    return out;
}

// --- spikes to bytes

TEST(Events, AreReadBackUnchangedInEveryFormat) {
    const TemporaryFolder folder;
    EXPECT_TRUE(rc::check([&] {
        const auto clock = *rc::gen::element(Clock{1000, 1}, Clock{5200, 1}, Clock{1213, 5}, Clock{3, 7});
        const auto afferents = *rc::gen::inRange<std::uint32_t>(1, 40);
        const auto classes = *rc::gen::inRange<std::uint32_t>(1, 4);
        EventAddressing named{clock, {}, {}};
        for (std::uint32_t u = 0; u < afferents; ++u)
            named.names.push_back("k" + std::to_string(u % classes) + "#" + std::to_string(u / classes + 1)),
                named.addresses.push_back(3 * u);
        std::vector<Spike> spikes;
        const auto steps = *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 100000));
        for (const int step : steps)
            spikes.push_back({step, (*rc::gen::inRange(1, 4097)) / 4096.0, static_cast<std::uint32_t>(step) % afferents});
        std::sort(spikes.begin(), spikes.end());
        for (const auto& [name, error] : {std::pair{"lines", 0.51e-9}, {"aer", 1e-12}, {"jsonl", 0.51e-9}, {"aedat2", 0.51e-6}}) {
            // At such a low rate two spikes can be more than 71 minutes apart, so a wrap of the time stamp cannot be detected.
            if (name == std::string_view("aedat2") && clock.rate_numerator < 10) continue;
            const auto format = value_or_throw(make_event_format(name, named));
            const auto path = folder.write("events", format->header() + bytes_of(*format, spikes));
            std::map<std::string, std::vector<double>> expected;
            for (const auto& s : spikes)
                expected[format->name() == "aedat2" ? std::to_string(3 * s.afferent_index) : named.names[s.afferent_index]].push_back(
                    clock.time(s.step, s.offset));
            if (format->name() == "jsonl") {  // each line is a JSON object; its address is checked, too
                std::ifstream in(path);
                std::size_t k = 0;
                for (std::string line; std::getline(in, line); ++k) {
                    const auto event = nlohmann::json::parse(line);
                    RC_ASSERT(event["afferent"] == named.names[spikes[k].afferent_index]);
                    RC_ASSERT(event["address"] == 3 * spikes[k].afferent_index);
                    RC_ASSERT(std::abs(event["time_s"].get<double>() - clock.time(spikes[k].step, spikes[k].offset)) < error);
                }
                RC_ASSERT(k == spikes.size());
                continue;
            }
            const auto trains = value_or_throw(read_spikes(path));
            RC_ASSERT(trains.size() == expected.size());
            for (const auto& t : trains) {
                auto& times = expected[t.afferent];
                std::sort(times.begin(), times.end());
                RC_ASSERT(t.times.size() == times.size());
                for (std::size_t k = 0; k < times.size(); ++k) RC_ASSERT(std::abs(t.times[k] - times[k]) < error * (1 + times[k]));
            }
        }
    }));
}

TEST(Events, MicrosecondsOfAedatWrapAfterSeventyOneMinutesAndAreUnwrapped) {
    const TemporaryFolder folder;
    const auto format = value_or_throw(make_event_format("aedat2", {Clock{1000, 1}, {"a"}, {}}));
    std::vector<Spike> spikes;
    for (std::int64_t s = 0; s < 10; ++s) spikes.push_back({1 + s * 1000 * 1000, 1, 0});  // 1000 s apart
    const auto trains = value_or_throw(read_spikes(folder.write("x.aedat", format->header() + bytes_of(*format, spikes))));
    ASSERT_EQ(trains.at(0).times.size(), spikes.size());
    EXPECT_NEAR(trains[0].times.back(), 9000.001, 1e-6);
}

TEST(Events, TheAddressOnAChannelIsChannelTimesNumberOfClassesPlusClass) {
    const auto skin = value_or_throw(innervate(applied_or_throw(make_channel_plan("sa1,fa1", 3))));
    const auto afferents = make_event_addressing(*skin, {1000, 1});
    EXPECT_EQ(afferents.names, (std::vector<std::string>{"sa1#1", "sa1#2", "sa1#3", "fa1#1", "fa1#2", "fa1#3"}));
    EXPECT_EQ(afferents.addresses, (std::vector<std::uint32_t>{0, 2, 4, 1, 3, 5}));
}

TEST(Events, LinesNameAfferentAndChannelLikeTheOutputOfRespond) {
    const std::vector<Channel> channels = {{0, "fz"}, {1, "thumb, tip"}};
    const auto on_channels = value_or_throw(innervate(applied_or_throw(make_channel_plan("sa1,fa1", channels))));
    const auto lines = [](const std::shared_ptr<const Innervation>& skin, std::uint32_t afferent, const char* format) {
        const Spike spike{5, 1, afferent};
        return bytes_of(*value_or_throw(make_event_format(format, make_event_addressing(*skin, {1000, 1}))), {&spike, 1});
    };
    EXPECT_EQ(value_or_throw(make_event_format("lines", make_event_addressing(*on_channels, {1000, 1})))->header(),
              "afferent,channel,time_s\n");
    EXPECT_EQ(lines(on_channels, 0, "lines"), "sa1,fz,0.005000000\n");
    EXPECT_EQ(lines(on_channels, 3, "lines"), "fa1,\"thumb, tip\",0.005000000\n");
    EXPECT_EQ(lines(on_channels, 3, "jsonl"), R"({"time_s":0.005000000,"afferent":"fa1","channel":"thumb, tip","address":3})"
                                              "\n");
    const auto hand = value_or_throw(innervate(value_or_throw(load_skin_plan("fingertip"))));
    EXPECT_TRUE(lines(hand, 16, "lines").starts_with("sa1#17," + hand->plan.sites.regions[hand->afferents[16].region] + ","));
}

TEST(Events, HeadersOfBinaryFormatsNameTheChannelOfEachAddress) {
    const TemporaryFolder folder;
    const std::vector<Channel> channels = {{0, "fz"}, {1, "thumb\n#x"}, {2, "ch3"}};
    const auto afferents =
        make_event_addressing(*value_or_throw(innervate(applied_or_throw(make_channel_plan("sa1,fa1", channels)))), {1000, 1});
    const auto aer = value_or_throw(make_event_format("aer", afferents)), aedat = value_or_throw(make_event_format("aedat2", afferents));
    const std::vector<Spike> spikes = {{5, 1, 0}, {6, 1, 4}, {7, 1, 5}};  // afferents are numbered class after class
    const auto trains = value_or_throw(read_spikes(folder.write("x.aer", aer->header() + bytes_of(*aer, spikes))));
    ASSERT_EQ(trains.size(), 3U);
    std::vector<std::string> names;
    for (const auto& t : trains) names.push_back(t.afferent + " on " + t.channel);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"fa1 on ch3", "fa1 on thumb\n#x", "sa1 on fz"}));
    EXPECT_EQ(aedat->header(),
              "#!AER-DAT2.0\r\n# spikes of afferents: address, microseconds modulo 2^32\r\n"
              "# addresses 0, 2 ... 4: sa1#1 ... sa1#3\r\n# addresses 1, 3 ... 5: fa1#1 ... fa1#3\r\n"
              "# addresses 0, 1: channel fz\r\n# addresses 2, 3: channel thumb #x\r\n# addresses 4, 5: channel ch3\r\n");
    EXPECT_EQ(value_or_throw(read_spikes(folder.write("x.aedat", aedat->header() + bytes_of(*aedat, spikes)))).size(), 3U);
    const auto numbered =
        make_event_addressing(*value_or_throw(innervate(applied_or_throw(make_channel_plan("sa1,fa1", 3, {})))), {1000, 1});
    EXPECT_LT(value_or_throw(make_event_format("aer", numbered))->header().size(), aer->header().size()) << "ch1, ch2 ... need no table";
    std::vector<Channel> many(4000);
    for (std::uint32_t c = 0; c < many.size(); ++c) many[c] = {c, fmt::format("a long name {}", c)};
    const auto long_one = value_or_throw(make_event_format(
        "aedat2", make_event_addressing(*value_or_throw(innervate(applied_or_throw(make_channel_plan("sa1", many)))), {1000, 1})));
    EXPECT_EQ(value_or_throw(read_spikes(folder.write("y.aedat", long_one->header() + bytes_of(*long_one, {spikes.data(), 1})))).size(),
              1U);
}

TEST(Events, TruncatedFilesAreRefused) {
    const TemporaryFolder folder;
    const auto format = value_or_throw(make_event_format("aer", {Clock{1000, 1}, {"sa1#1", "sa1#2"}, {}}));
    const Spike spike{5, 0.5, 1};
    const auto complete = format->header() + bytes_of(*format, {&spike, 1});
    EXPECT_EQ(value_or_throw(read_spikes(folder.write("x.aer", complete))).at(0).name(), "sa1#2");
    for (std::size_t cut = 8; cut < complete.size(); ++cut)
        if (cut != format->header().size()) {
            EXPECT_FALSE(read_spikes(folder.write("x.aer", complete.substr(0, cut)))) << cut;
        }
    EXPECT_FALSE(make_event_format("aedat", {}));
}

// --- bytes to frames

struct Decoded {
    std::vector<std::vector<double>> frames;
    std::int64_t unreadable_frames = 0;
    std::size_t invalid_forces = 0;
    bool operator==(const Decoded&) const = default;
};

/// Decodes bytes that arrive in chunks of these sizes, which are repeated until all have arrived. Without sizes, the bytes arrive at once.
Decoded decoded(const FrameLayout& layout, std::string_view bytes, const std::vector<int>& chunk_sizes) {
    FrameDecoder decoder(layout);
    Decoded out;
    std::vector<double> force(layout.sites);
    for (std::size_t k = 0; !bytes.empty(); ++k) {
        const auto buffer = decoder.buffer();
        const auto size = chunk_sizes.empty() ? bytes.size() : static_cast<std::size_t>(chunk_sizes[k % chunk_sizes.size()]);
        const auto count = std::min({buffer.size(), size, bytes.size()});
        std::memcpy(buffer.data(), bytes.data(), count);
        decoder.add_bytes(count), bytes.remove_prefix(count);
        for (auto found = decoder.next(); found != FrameDecoder::Status::nothing; found = decoder.next()) {
            if (found == FrameDecoder::Status::unreadable) {
                ++out.unreadable_frames;
                continue;
            }
            out.invalid_forces += decoder.read_forces(force);
            out.frames.push_back(force);
        }
    }
    return out;
}

TEST(Frames, DoNotDependOnTheChunksInWhichTheirBytesArrive) {
    EXPECT_TRUE(rc::check([] {
        FrameLayout layout;
        layout.kind = *rc::gen::element(FrameKind::csv, FrameKind::f32, FrameKind::f64, FrameKind::i16);
        layout.stamp = *rc::gen::element(FrameStamp::none, FrameStamp::sequence, FrameStamp::time);
        layout.sites = *rc::gen::inRange<std::size_t>(1, 5);
        const auto bytes = layout.kind == FrameKind::csv
                               ? *rc::gen::container<std::string>(rc::gen::element('1', '2', '.', ',', '\n', '-', 'x', ' '))
                               : *rc::gen::container<std::string>(rc::gen::arbitrary<char>());
        const auto sizes = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 9)));
        RC_ASSERT(decoded(layout, bytes, sizes) == decoded(layout, bytes, {}));
    }));
}

TEST(Frames, ALineOfTheWrongWidthIsSkippedAndAnInvalidForceRepeatsTheLastOne) {
    FrameLayout layout;
    layout.sites = 2;
    const auto d = decoded(layout, "a,b\n1,2\r\n3\n1,2,3\nx,4\n# note\n\n5 ; 1e9\n nan, -.5 \n", {});
    EXPECT_EQ(d.frames, (std::vector<std::vector<double>>{{1, 2}, {1, 4}, {5, 4}, {5, -0.5}}));
    EXPECT_EQ(d.unreadable_frames, 2);
    EXPECT_EQ(d.invalid_forces, 3U) << "x, 1e9 (beyond the limit), nan";
    const std::string endless(10'000'000, '7');
    EXPECT_EQ(decoded(layout, "1,2\n" + endless + "\n3,4\n", {}).frames.size(), 2U) << "an endless line takes no memory";
}

TEST(Frames, AFirstLineOfNansIsAFrame) {
    FrameLayout layout;
    layout.sites = 2;
    EXPECT_EQ(decoded(layout, "nan,nan\n1,2\n", {}).frames, (std::vector<std::vector<double>>{{0, 0}, {1, 2}}));
}

TEST(Frames, NumbersRevealMissingDuplicateAndLateFrames) {
    constexpr std::int64_t hold = 2, max_gap = 10;  // frames
    FrameSequence sequence(hold, max_gap);
    const auto decide = [&](std::uint32_t n) { return sequence.decide(n); };
    EXPECT_TRUE(decide(4294967295U).take) << "the first number starts the sequence";
    EXPECT_EQ(decide(0).hold, 0) << "it wraps at 2^32";
    EXPECT_FALSE(decide(0).take);
    const auto gap = decide(5);  // 1 to 4 are missing
    EXPECT_EQ(gap.hold, 2);
    EXPECT_EQ(gap.release, 2);
    EXPECT_FALSE(decide(3).take);
    EXPECT_TRUE(decide(1000).take) << "too large a jump for a gap: a restart";
    EXPECT_TRUE(decide(7).take) << "a jump back is a restart, too";
    const auto& c = sequence.counts();
    EXPECT_EQ((std::vector{c.gaps, c.held, c.released, c.duplicates, c.late, c.restarts}), (std::vector<std::int64_t>{1, 2, 2, 1, 1, 2}));
}

// --- a skin, frame by frame

SkinPlan conducting_grid(std::size_t rows, std::size_t columns) {
    auto plan = value_or_throw(load_skin_plan("grid " + std::to_string(rows) + "x" + std::to_string(columns)));
    for (auto& c : plan.classes) c.velocity = 2, c.velocity_spread = 0.2;
    plan.nerve = Position{0, -0.02, 0};
    return plan;
}

/// Frames [frame][site] of force, N: presses of 37 frames on some sites, with pauses between them.
std::vector<std::vector<double>> some_frames(std::size_t count, std::size_t sites, std::uint64_t seed) {
    std::vector<std::vector<double>> frames(count, std::vector<double>(sites));
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t s = 0; s < sites; ++s) {
            const auto w = philox({static_cast<std::uint32_t>(k / 37), static_cast<std::uint32_t>(s), 0, 0}, seed);
            if (w[0] % 4 == 0) frames[k][s] = static_cast<double>(w[1] % 1000) * 2e-3 + static_cast<double>(k % 37) * 0.02;
        }
    return frames;
}

/// The spikes of all frames, simulated in one block.
std::vector<Spike> offline(const std::shared_ptr<const Innervation>& skin, const std::vector<std::vector<double>>& frames) {
    auto made = value_or_throw(Skin::make(skin, {.dt = 1e-3}, *instruction_set()));
    std::vector<double> force(skin->plan.sites.size() * frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k)
        for (std::size_t s = 0; s < frames[k].size(); ++s) force[s * frames.size() + k] = frames[k][s];
    ThreadPool pool(2);
    std::vector<Spike> spikes;
    EXPECT_TRUE(made->respond({force.data(), frames.size(), {}, true}, frames.size(), spikes, pool));
    made->finish(spikes);
    return spikes;
}

TEST(SkinStream, SpikesInBatchesAndAfterResumeEqualTheOfflineSpikesByteForByte) {
    EXPECT_TRUE(rc::check([] {
        const auto skin =
            value_or_throw(innervate(conducting_grid(*rc::gen::inRange<std::size_t>(1, 12), *rc::gen::inRange<std::size_t>(1, 12))));
        const Clock clock{1000, 1};
        const auto frames =
            some_frames(*rc::gen::inRange<std::size_t>(1, 700), skin->plan.sites.size(), *rc::gen::arbitrary<std::uint64_t>());
        const auto cut = *rc::gen::inRange<std::size_t>(0, frames.size());
        const auto format = value_or_throw(
            make_event_format(*rc::gen::element<std::string>("lines", "jsonl", "aer", "aedat2"), make_event_addressing(*skin, clock)));
        const auto batch_frames = *rc::gen::inRange<std::size_t>(1, 40);
        auto stream = value_or_throw(SkinStream::make(skin, clock)),
             batched = value_or_throw(SkinStream::make(skin, clock, false, batch_frames));
        std::string live, in_batches;
        for (std::size_t k = 0; k < frames.size(); ++k) {
            if (k == cut) {
                const auto restored = value_or_throw(unpack_stream(pack_stream({frames[k], 7, stream->save()}), "x"));
                RC_ASSERT(restored.force == frames[k]);
                stream = value_or_throw(SkinStream::make(skin, clock));
                RC_ASSERT(bool(stream->resume(restored.skin)));
            }
            live += bytes_of(*format, value_or_throw(stream->push(frames[k])));
            if (batched->add_to_batch(frames[k])) in_batches += bytes_of(*format, value_or_throw(batched->run_batch()));
        }
        live += bytes_of(*format, stream->finish());
        in_batches += bytes_of(*format, value_or_throw(batched->run_batch()));
        RC_ASSERT(in_batches + bytes_of(*format, batched->finish()) == live);
        RC_ASSERT(live == bytes_of(*format, offline(skin, frames)));
    }));
}

TEST(SkinStream, AStateThatIsDamagedIsRefused) {
    auto stream = value_or_throw(SkinStream::make(value_or_throw(innervate(applied_or_throw(make_channel_plan("sa1", 2)))), {1000, 1}));
    const auto bytes = pack_stream({{0.5, 0.25}, {}, stream->save()});
    EXPECT_TRUE(unpack_stream(bytes, "x"));
    for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(unpack_stream(std::span(bytes).first(size), "x")) << size;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        auto damaged = bytes;
        damaged[bit / 8] ^= std::byte{1} << (bit % 8);
        EXPECT_FALSE(unpack_stream(damaged, "x")) << bit;
    }
}

TEST(SkinStream, AStateOfThePreviousVersionIsReadAndALaterOneRefused) {
    auto stream = value_or_throw(SkinStream::make(value_or_throw(innervate(applied_or_throw(make_channel_plan("sa1", 2)))), {1000, 1}));
    auto bytes = pack_stream({{0.5, 0.25}, 7, stream->save()});
    bytes[8] = std::byte{3};
    const auto later = unpack_stream(bytes, "now.state");
    ASSERT_FALSE(later);
    EXPECT_NE(later.error().message.find("a saved state of version 3"), std::string::npos) << later.error().message;
    bytes[8] = std::byte{1};
    bytes.resize(bytes.size() - 8);  // version 1 has no checksum
    const auto before = value_or_throw(unpack_stream(bytes, "now.state"));
    EXPECT_EQ(before.force, (std::vector<double>{0.5, 0.25}));
    EXPECT_EQ(before.number, 7U);
    EXPECT_EQ(before.skin, stream->save());
}

// --- buffers and clients

TEST(ByteRing, PassesCompleteEventsInOrderBetweenThreads) {
    ByteRing ring(64);
    std::uint32_t last_read = 0;
    std::thread reader([&] {
        std::string received;
        std::uint32_t last = 0;
        while (last != 1'000'000) {
            const auto chunk = ring.readable();
            received.append(chunk), ring.consume(chunk.size());
            for (; received.size() >= sizeof last; received.erase(0, sizeof last)) {
                std::uint32_t number = 0;
                std::memcpy(&number, received.data(), sizeof number);
                if (number <= last) return;  // out of order: `last_read` stays 0, and the test fails
                last = number;
            }
        }
        last_read = last;
    });
    for (std::uint32_t k = 1; k <= 1'000'000; ++k)
        while (!ring.put({reinterpret_cast<const char*>(&k), sizeof k}))
            if (k < 1'000'000) break;  // a number that does not fit is dropped; the last one is tried until it fits
    reader.join();
    EXPECT_EQ(last_read, 1'000'000U);
}

TEST(EventSink, AReaderIsReconnectedWithoutTheNameService) {
    Endpoint endpoint;
    auto listener = value_or_throw(open_listening_socket(endpoint));
    const auto accepted = [&] {
        pollfd waiting = {listener.get(), POLLIN, 0};
        EXPECT_EQ(::poll(&waiting, 1, 10000), 1);
        return Descriptor(::accept(listener.get(), nullptr, nullptr));
    };
    auto resolved = value_or_throw(resolve(endpoint));
    resolved.at.address = "robot.invalid";  // a name that cannot be resolved
    const auto format = value_or_throw(make_event_format("lines", {Clock{1000, 1}, {"a"}, {}}));
    const auto client = value_or_throw(connect_event_client(resolved, *format, 1024));
    accepted().close();
    const auto start = steady_now();
    std::int64_t longest_call = 0;
    while (client->connections() < 2 && steady_now() - start < 10'000'000'000) {
        const auto before = steady_now();
        EXPECT_TRUE(client->put("a,,0.1\n"));
        EXPECT_TRUE(client->flush());
        longest_call = std::max(longest_call, steady_now() - before);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(client->connections(), 2);
    EXPECT_LT(longest_call, 1'000'000'000) << "ns; no call may block";
    EXPECT_GT(client->dropped(), 0);
    accepted().close();
}

TEST(LatencyHistogram, QuantilesAreWithinThreePercent) {
    LatencyHistogram d;
    for (std::int64_t ns = 1; ns <= 1'000'000; ++ns) d.add(ns);
    for (const double fraction : {0.01, 0.5, 0.99, 0.999})
        EXPECT_NEAR(static_cast<double>(d.quantile(fraction)), fraction * 1e6, 0.032 * fraction * 1e6);
    EXPECT_EQ(d.max(), 1'000'000);
}

TEST(CHeader, GivesThePositionOfEachSite) {
    auto* const skin = corpuscle_create("grid 2x3", 1000, 1);
    ASSERT_TRUE(skin);
    double x = 0, y = 0;
    EXPECT_STREQ(corpuscle_site_name(skin, 4), "r2c2");
    EXPECT_EQ(corpuscle_site_position(skin, 4, &x, &y), 0);
    EXPECT_NEAR(x, 2e-3, 1e-12);
    EXPECT_NEAR(y, 2e-3, 1e-12);
    EXPECT_EQ(corpuscle_site_name(skin, 6), nullptr);
    EXPECT_EQ(corpuscle_site_position(skin, 6, &x, &y), CORPUSCLE_BAD_CALL);
    EXPECT_STREQ(corpuscle_error(), "there is no site 6; the skin has 6, which count from 0");
    EXPECT_EQ(corpuscle_site_position(nullptr, 0, &x, &y), CORPUSCLE_BAD_CALL);
    corpuscle_destroy(skin);
}

// --- frames with fewer forces than sites

/// Frame k has the two forces {k, 10 k}. Frame 3 is a filled one.
class CountedFrames final : public FrameSource {
    int frame_count_ = 0;

public:
    Result<bool> receive() override { return true; }
    FrameCounts counts() const override { return {.frames = frame_count_}; }
    std::string description() const override { return "counted"; }
    Next read_frame(std::span<double> force) override {
        if (++frame_count_ == 3) return Next::filled;  // repeats the last frame
        force[0] = frame_count_, force[1] = 10.0 * frame_count_;
        return Next::frame;
    }
};

TEST(SiteFrames, AssignEachForceToItsSiteAndNoForceToOthers) {
    CountedFrames frames;
    frames.assign_sites({4, 1}, 6);
    std::vector<double> force(6);
    EXPECT_EQ(frames.next(force), FrameSource::Next::frame);
    EXPECT_EQ(force, (std::vector<double>{0, 10, 0, 0, 1, 0}));
    EXPECT_EQ(frames.next(force), FrameSource::Next::frame);
    EXPECT_EQ(frames.next(force), FrameSource::Next::filled);
    EXPECT_EQ(force, (std::vector<double>{0, 20, 0, 0, 2, 0}));
}

TEST(SiteFrames, AreFilteredAlsoIfAllSitesAreInOrder) {
    const auto clock = value_or_throw(make_clock(1000.0));
    CountedFrames frames;
    const Biquad filter = value_or_throw(Biquad::lowpass(100, clock));
    frames.assign_sites({0, 1}, 2, {.biquads = {filter}});
    auto first = filter, second = filter;
    std::vector<double> force(2), expected(2);
    for (int k = 1; k <= 5; ++k) {
        EXPECT_NE(frames.next(force), FrameSource::Next::nothing);
        if (k == 3)
            expected = {2, 20};  // the last frame is repeated, and filtered, too
        else
            expected = {1.0 * k, 10.0 * k};
        EXPECT_EQ(force, (std::vector<double>{first.next(expected[0]), second.next(expected[1])})) << k;
    }
}

TEST(SiteMap, AssignsASiteToEachValueOfAFrame) {
    const TemporaryFolder folder;
    const auto sites = value_or_throw(grid_sites(2, 3, 2e-3));
    const auto map = [&](const std::string& text) { return read_site_map(folder.write("palm.csv", text), sites); };
    EXPECT_EQ(value_or_throw(map("# of a palm\nchannel,name,gain\n2,r1c2,1\n1,r2c2,1\n")), (std::vector<std::uint32_t>{4, 1}));
    EXPECT_EQ(value_or_throw(map("sensor;name\n1;r1c1\n")), (std::vector<std::uint32_t>{0}));
    for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
             {"channel,name\n1,r3c1\n", "palm.csv:2:3: there is no site 'r3c1'; did you mean"},
             {"channel,name\n1,r1c1\n3,r1c2\n", "channel 2 has no row, although channel 3 has one"},
             {"channel,name\n1,r1c1\n1,r1c2\n", "palm.csv:3:1: channel 1 has two rows"},
             {"channel,name\n1,r1c1\n2,r1c1\n", "palm.csv:3:3: site 'r1c1' has two channels"},
             {"channel,name\n0,r1c1\n", "palm.csv:2:1: channel '0': must be a number from 1 to 6"},
             {"channel,x_mm\n1,2\n", "needs the columns channel and name"},
             {"channel,name\n", "no channels in this layout"},
             {"", "needs the columns channel and name"}}) {
        const auto refused = map(text);
        ASSERT_FALSE(refused) << text;
        EXPECT_NE(refused.error().text().find(message), std::string::npos) << refused.error().text();
    }
}

TEST(SiteMap, RequiresThatAllNamesOrNoneAreSites) {
    const auto sites = value_or_throw(grid_sites(2, 2, 2e-3));
    using Names = std::vector<std::string>;
    const auto found = [&](const Names& names) { return find_sites_if_named(sites, names); };
    EXPECT_EQ(*value_or_throw(found({"r2c2", "r1c1", "r1c2_N", "r2c1 [mN]"})), (std::vector<std::uint32_t>{3, 0, 1, 2}));
    EXPECT_EQ(*value_or_throw(found({"r2c1"})), std::vector<std::uint32_t>{2});
    EXPECT_FALSE(value_or_throw(found({"fx", "fy", "fz", "r3c3"})));
    for (const auto& [names, message] :
         std::vector<std::pair<Names, std::string>>{{{"r1c1", "r2cl"}, "there is no site 'r2cl'; did you mean"},
                                                    {{"R1C1", "R1C2"}, "there is no site 'R1C1'; did you mean 'r1c1'"},
                                                    {{"r1c1", "r1c1"}, "two channels have the name 'r1c1', which is one site"},
                                                    {{"r1c1", "r1c1 (2)"}, "two channels have the name 'r1c1', which is one site"}}) {
        const auto refused = found(names);
        ASSERT_FALSE(refused) << names[1];
        EXPECT_NE(refused.error().message.find(message), std::string::npos) << refused.error().message;
    }
}

TEST(CHeader, ReportsErrorsAndResumesASavedState) {
    EXPECT_EQ(corpuscle_create("no-such-skin", 1000, 1), nullptr);
    EXPECT_NE(std::string(corpuscle_error()).find("no-such-skin"), std::string::npos) << corpuscle_error();
    EXPECT_EQ(corpuscle_create(nullptr, 1000, 1), nullptr);
    auto* one = corpuscle_create("sa1", 1000, 1);
    auto* other = corpuscle_create("sa1", 1000, 1);
    ASSERT_TRUE(one && other) << corpuscle_error();
    const auto list = [](void* to, const corpuscle_spike* s) { static_cast<std::vector<double>*>(to)->push_back(s->time); };
    std::vector<double> all, second;
    const double force = 2;
    EXPECT_EQ(corpuscle_push(one, &force, 2, list, &all), CORPUSCLE_BAD_INPUT);
    EXPECT_STREQ(corpuscle_error(), "a frame has 2 forces, but there are 1 sites");
    for (int k = 0; k < 1000; ++k) {
        if (k == 150) {
            std::vector<char> state(corpuscle_save(one, nullptr, 0));
            EXPECT_EQ(corpuscle_save(one, state.data(), state.size()), state.size());
            EXPECT_EQ(corpuscle_save(one, state.data(), 3), 0U);
            EXPECT_EQ(corpuscle_resume(other, state.data(), state.size()), 0);
            EXPECT_EQ(corpuscle_resume(other, state.data(), 3), CORPUSCLE_BAD_INPUT);
            for (std::size_t at = 0; at < state.size(); ++at) {
                auto damaged = state;
                damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
                EXPECT_EQ(corpuscle_resume(other, damaged.data(), damaged.size()), CORPUSCLE_BAD_INPUT) << at;
            }
            second = all;
        }
        EXPECT_EQ(corpuscle_push(one, &force, 1, list, &all), 0);
        if (k >= 150) {
            EXPECT_EQ(corpuscle_push(other, &force, 1, list, &second), 0);
        }
    }
    EXPECT_GT(all.size(), 1U);
    EXPECT_EQ(all, second);
    corpuscle_destroy(one), corpuscle_destroy(other), corpuscle_destroy(nullptr);
}

TEST(CHeader, AppliesSettingsToTheClassesOfAPopulation) {
    const auto spikes = [&](std::vector<const char*> settings) {
        auto* skin = corpuscle_create_with("grid 2x2", 1000, 1, settings.data(), settings.size());
        EXPECT_TRUE(skin) << corpuscle_error();
        long count = 0;
        const std::vector<double> frame(corpuscle_sites(skin), 2.0);
        for (int k = 0; k < 500; ++k)
            EXPECT_EQ(corpuscle_push(
                          skin, frame.data(), frame.size(), [](void* to, const corpuscle_spike*) { ++*static_cast<long*>(to); }, &count),
                      0);
        corpuscle_destroy(skin);
        return count;
    };
    EXPECT_GT(spikes({"sa1.V_th=300mV"}), spikes({}));
    for (const auto& [setting, message] : {std::pair{"sa9.V_th=1V", "nothing here is named 'sa9'; did you mean 'sa1'?"},
                                           {"sa1.V=1V", "unknown parameter 'V'"},
                                           {"sa1", "write NAME.PARAMETER=VALUE"}}) {
        EXPECT_EQ(corpuscle_create_with("grid 2x2", 1000, 1, &setting, 1), nullptr);
        EXPECT_NE(std::string(corpuscle_error()).find(message), std::string::npos) << corpuscle_error();
    }
    const char* none = nullptr;
    EXPECT_EQ(corpuscle_create_with("grid 2x2", 1000, 1, &none, 1), nullptr);
    EXPECT_EQ(corpuscle_create_with("grid 2x2", 1000, 1, nullptr, 1), nullptr);
}

}  // namespace
}  // namespace corpuscle
