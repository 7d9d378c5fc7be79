// Files that respond writes, read back.

#include "run/sinks.hpp"

#include <sndfile.h>

#include <cmath>
#include <numeric>

#include "io/spikes/spike_files.hpp"
#include "io/table/npz.hpp"
#include "model/copies.hpp"
#include "run/earlier_outputs.hpp"
#include "run/run_inputs.hpp"
#include "run/summary/run_summary.hpp"
#include "support/property.hpp"
#include "support/sinks.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::make_sink, test::pass_to_sinks;
using test::value_or_throw;

/// A source of which only the clock and the channels are used; it returns no samples.
class SilentSource final : public ForceSource {
    std::string name_ = "still";
    Clock clock_;
    std::vector<Channel> channels_;

public:
    SilentSource(Clock clock, const std::vector<std::string>& channels) : clock_(clock) {
        for (const auto& c : channels) channels_.push_back({static_cast<std::uint32_t>(channels_.size()), c});
    }
    const std::string& name() const override { return name_; }
    const Clock& clock() const override { return clock_; }
    const std::vector<Channel>& channels() const override { return channels_; }
    double progress() const override { return 1; }
    std::string description() const override { return "still"; }
    Result<void> read(Frames&) override { return {}; }
};

std::vector<AfferentPlan> plans(const std::vector<std::string>& names) {
    std::vector<AfferentPlan> all;
    for (const auto& n : names) all.push_back(value_or_throw(plan_afferent(n)));
    return all;
}

std::vector<Spike> any_spikes(std::int64_t samples, std::uint32_t afferent_count) {
    std::vector<Spike> all;
    for (const auto& [step, part, afferent_index] :
         *rc::gen::container<std::vector<std::tuple<std::int64_t, int, std::uint32_t>>>(rc::gen::tuple(
             rc::gen::inRange<std::int64_t>(1, samples), rc::gen::inRange(1, 1001), rc::gen::inRange<std::uint32_t>(0, afferent_count))))
        all.push_back({step, part / 1000.0, afferent_index});
    return all;
}

TEST(SpikeSinks, AreReadBackFromCsvToTheNanosecondAndFromNpzExactly) {
    const TemporaryFolder folder;
    const auto afferents = plans({"sa1", "fa1"});
    EXPECT_TRUE(rc::check("written and read", [&] {
        const SilentSource source(Clock{3000, 1, *rc::gen::element(0.0, 12.3456, 1.7e6)}, {"a", "b c"});
        const auto spikes = any_spikes(500, 4);
        const auto csv = make_sink(spikes_format, folder.path()), npz = make_sink(npz_format, folder.path());
        pass_to_sinks(source, afferents, spikes, 500, *rc::gen::element(1, 7, 500), {csv.get(), npz.get()});
        RC_ASSERT(bool(csv->commit()) && bool(npz->commit()));
        std::vector<std::vector<double>> expected(4);
        for (const auto& s : spikes) expected[s.afferent_index].push_back(source.clock().time(s.step, s.offset));
        for (auto& r : expected) std::sort(r.begin(), r.end());
        const auto exact = value_or_throw(read_spikes(folder / "spikes.npz")), rounded = value_or_throw(read_spikes(folder / "spikes.csv"));
        RC_ASSERT(exact.size() == 4U);  // including silent ones
        std::size_t trains_in_csv = 0;
        for (const auto& train : exact) {
            const std::size_t afferent_index = (train.channel == "a" ? 0U : 2U) + (train.afferent == "sa1" ? 0U : 1U);
            RC_ASSERT(train.times == expected[afferent_index]);
            const auto same = std::find_if(rounded.begin(), rounded.end(), [&](const auto& t) { return t.name() == train.name(); });
            RC_ASSERT((same == rounded.end()) == train.times.empty());
            if (same == rounded.end()) continue;
            RC_ASSERT(same->times.size() == train.times.size());
            for (std::size_t k = 0; k < train.times.size(); ++k) RC_ASSERT(std::abs(same->times[k] - train.times[k]) < 0.8e-9);
            ++trains_in_csv;
        }
        RC_ASSERT(trains_in_csv == rounded.size());
    }));
}

TEST(SpikeSinks, NpzHasTheListsThatSpikeInterfaceReads) {
    const TemporaryFolder folder;
    const SilentSource source(Clock{1000, 1, 5.0}, {"a"});
    const auto npz = make_sink(npz_format, folder.path());
    pass_to_sinks(source, plans({"sa1", "fa1"}), {{2, 0.5, 1}, {1, 0.25, 0}}, 10, 4, {npz.get()});
    ASSERT_TRUE(npz->commit());
    const auto checked = std::system(("/usr/bin/python3 -c \"\nimport numpy as np\nz = np.load('" + folder / "spikes.npz" + R"(')
assert z['unit_ids'].dtype == np.int64 and list(z['unit_ids']) == [0, 1]
assert int(z['num_segment'][0]) == 1 and z['num_segment'].dtype == np.int64
assert float(z['sampling_frequency'][0]) == 1e6 and z['sampling_frequency'].dtype == np.float64
assert z['spike_indexes_seg0'].dtype == np.int64 and list(z['spike_indexes_seg0']) == [250, 1500]
assert list(z['spike_labels_seg0']) == [0, 1]
assert list(z['spike_times_seg0']) == [5.00025, 5.0015]
assert list(z['unit_afferent']) == ['sa1', 'fa1'] and list(z['unit_channel']) == ['a', 'a']
")")
                                         .c_str());
    EXPECT_EQ(checked, 0);
}

/// Compares the file with a text made by counting the spikes of each bin.
TEST(PsthFile, CountsEverySpikeOnceInEqualBinsForAnyBlock) {
    const TemporaryFolder folder;
    const auto afferents = plans({"sa1"});
    EXPECT_TRUE(rc::check("compared with counting", [&] {
        const SilentSource source(Clock{1000, 1, *rc::gen::element(0.0, 100.0)}, {"a", "b"});
        const auto spikes = any_spikes(250, 2);
        const int per_bin = *rc::gen::element(1, 7, 10, 250, 1000);  // samples
        const auto bins = make_sink(psth_format, folder.path(), {.options = {{"--bin", fmt::format("{}ms", per_bin)}}});
        pass_to_sinks(source, afferents, spikes, 250, *rc::gen::element(1, 9, 250), {bins.get()});
        RC_ASSERT(bool(bins->commit()));
        std::vector<std::string> expected = {"afferent,channel,from_s,to_s,spikes,rate_Hz"};
        for (int from = 0; from < 250; from += per_bin)
            for (std::uint32_t u = 0; u < 2; ++u) {
                const int to = std::min(from + per_bin, 250);
                const auto n = std::count_if(spikes.begin(), spikes.end(), [&](const Spike& s) {
                    const double at = static_cast<double>(s.step - 1) + s.offset;
                    return s.afferent_index == u && at >= from && at < to;
                });
                expected.push_back(fmt::format("sa1,{},{:.9f},{:.9f},{},{:.6g}", u ? "b" : "a", source.clock().t0 + from * 1e-3,
                                               source.clock().t0 + to * 1e-3, n, static_cast<double>(n) / ((to - from) * 1e-3)));
            }
        RC_ASSERT(test::read_file(folder / "psth.csv") == fmt::format("{}\n", fmt::join(expected, "\n")));
    }));
}

struct DecodedClicks {
    int channels = 0;
    std::vector<short> samples;
};

DecodedClicks read_clicks(const std::string& path) {
    SF_INFO info = {};
    SNDFILE* file = sf_open(path.c_str(), SFM_READ, &info);
    if (!file) throw std::runtime_error(sf_strerror(nullptr));
    EXPECT_EQ(info.samplerate, 44100);
    EXPECT_EQ(info.format & SF_FORMAT_SUBMASK, SF_FORMAT_PCM_16);
    DecodedClicks clicks_read{info.channels, std::vector<short>(static_cast<std::size_t>(info.frames * info.channels))};
    EXPECT_EQ(sf_readf_short(file, clicks_read.samples.data(), info.frames), info.frames);
    sf_close(file);
    return clicks_read;
}

TEST(SpikeSoundFile, HasAClickForEachSpikeAtItsSampleForAnyBlock) {
    const TemporaryFolder folder;
    const SilentSource source(Clock{10000, 1, 77.0}, {"a"});
    std::vector<Spike> spikes;
    for (std::int64_t k = 0; k < 40; ++k) spikes.push_back({50 + 37 * k, static_cast<double>(1 + k % 7) / 7, 0});
    for (const std::int64_t block : {1, 13, 2000}) {
        const auto clicks = make_sink(sound_format, folder.path());
        pass_to_sinks(source, plans({"sa1"}), spikes, 2000, block, {clicks.get()});
        ASSERT_TRUE(clicks->commit());
        const auto clicks_read = read_clicks(folder / "spikes.wav");
        EXPECT_EQ(clicks_read.channels, 1);
        EXPECT_EQ(clicks_read.samples.size(), 8820U) << "as long as the input";
        std::vector<std::size_t> found;
        for (std::size_t k = 0; k < clicks_read.samples.size(); ++k)
            if (clicks_read.samples[k] > (k ? clicks_read.samples[k - 1] : 0)) found.push_back(k);
        ASSERT_EQ(found.size(), spikes.size());
        for (std::size_t k = 0; k < found.size(); ++k) {
            const double t = (static_cast<double>(spikes[k].step - 1) + spikes[k].offset) / 10e3;
            EXPECT_EQ(found[k], static_cast<std::size_t>(std::lround(t * 44100)));
        }
    }
}

TEST(SpikeSoundFile, PansAfferentsFromLeftToRightAndNeverSaturates) {
    const TemporaryFolder folder;
    const SilentSource source(Clock{10000, 1, 0.0}, {"a", "b"});
    std::vector<Spike> all;  // all afferents at once, several times, some within each other's clicks
    for (const std::int64_t step : {10, 11, 12, 100, 101, 300})
        for (std::uint32_t u = 0; u < 6; ++u) all.push_back({step, 1, u});
    const auto clicks = make_sink(sound_format, folder.path());
    pass_to_sinks(source, plans({"sa1", "fa1", "sa2"}), all, 400, 50, {clicks.get()});
    ASSERT_TRUE(clicks->commit());
    const auto clicks_read = read_clicks(folder / "spikes.wav");
    EXPECT_EQ(clicks_read.channels, 2);
    EXPECT_LE(*std::max_element(clicks_read.samples.begin(), clicks_read.samples.end()), 29490) << "nine tenths of the full range";
    EXPECT_GE(*std::max_element(clicks_read.samples.begin(), clicks_read.samples.end()), 29480);
    EXPECT_GE(*std::min_element(clicks_read.samples.begin(), clicks_read.samples.end()), 0)
        << "clicks do not wrap around to negative samples";
    const auto left = make_sink(sound_format, folder.path());
    pass_to_sinks(source, plans({"sa1", "fa1"}), {{100, 1, 0}}, 400, 50, {left.get()});
    ASSERT_TRUE(left->commit());
    const auto one = read_clicks(folder / "spikes.wav");
    int on_left = 0, right_channel = 0;
    for (std::size_t k = 0; k < one.samples.size(); k += 2) on_left += one.samples[k] != 0, right_channel += one.samples[k + 1] != 0;
    EXPECT_GT(on_left, 40);
    EXPECT_EQ(right_channel, 0);
}

TEST(SpikeSoundFile, PansCopiesLikeTheirAfferent) {
    const TemporaryFolder folder;
    const SilentSource source(Clock{10000, 1, 0.0}, {"a"});
    std::vector<AfferentPlan> copies;
    for (const auto& plan : plans({"sa1", "fa1"}))
        for (auto& copy : value_or_throw(make_copies(plan, 3, {}, 0))) copies.push_back(std::move(copy));
    for (std::uint32_t afferent_index = 0; afferent_index < 6; ++afferent_index) {
        const auto clicks = make_sink(sound_format, folder.path());
        pass_to_sinks(source, copies, {{100, 1, afferent_index}}, 400, 50, {clicks.get()});
        ASSERT_TRUE(clicks->commit());
        const auto clicks_read = read_clicks(folder / "spikes.wav");
        ASSERT_EQ(clicks_read.channels, 2);
        int loudest[2] = {0, 0};
        for (std::size_t k = 0; k < clicks_read.samples.size(); ++k) loudest[k % 2] = std::max<int>(loudest[k % 2], clicks_read.samples[k]);
        EXPECT_EQ(loudest[afferent_index < 3 ? 0 : 1], 9830) << "a third of nine tenths of the full range";
        EXPECT_EQ(loudest[afferent_index < 3 ? 1 : 0], 0);
    }
}

TEST(SpikeSoundFile, RefusesMoreThanAWavFileHoldsAndLeavesNothing) {
    const TemporaryFolder folder;
    const SilentSource source(Clock{1, 1000, 0.0}, {"a"});  // a sample every 1000 s
    {
        const auto clicks = make_sink(sound_format, folder.path());
        try {
            pass_to_sinks(source, plans({"sa1"}), {}, 30, 1, {clicks.get()});
            ADD_FAILURE() << "was written";
        } catch (const std::runtime_error& e) {
            EXPECT_NE(std::string(e.what()).find("'still' is longer than 6 hours, which is the limit of a WAV file; run it without --wav"),
                      std::string::npos)
                << e.what();
        }
    }
    EXPECT_TRUE(folder.file_names().empty());
}

TEST(RemoveStaleOutputs, RemovesOnlyFilesThatAnEarlierSummaryNamesInThatDirectory) {
    const TemporaryFolder folder;
    folder.write("summary.json", R"({"program": "corpuscle", "files": ["psth.csv", "spikes.csv", "../outside", "sub", "gone.csv", 3]})");
    for (const char* name : {"psth.csv", "spikes.csv", "mine.csv"}) folder.write(name, "");
    std::filesystem::create_directory(folder / "sub");
    EXPECT_EQ(remove_stale_outputs(folder.path(), {"spikes.csv", "summary.json"}), std::vector<std::string>{"psth.csv"});
    EXPECT_EQ(folder.file_names(), (std::vector<std::string>{"mine.csv", "spikes.csv", "sub", "summary.json"}));
    for (const char* other : {"", "{", "[]", R"({"program": "another", "files": ["mine.csv"]})", R"({"program": "corpuscle", "files": 7})",
                              R"({"files": ["mine.csv"]})"}) {
        folder.write("summary.json", other);
        EXPECT_TRUE(remove_stale_outputs(folder.path(), {}).empty()) << other;
    }
    EXPECT_TRUE(remove_stale_outputs(folder / "nowhere", {}).empty());
}

/// Only a periodic stimulus has the measures that need a cycle.
TEST(Summary, UsesTheCycleOfAStimulusAndLeavesOutColumnsWithoutValues) {
    const auto columns = [](const std::string& stimulus) {
        std::vector<std::unique_ptr<ForceSource>> sources;
        sources.push_back(value_or_throw(make_stimulus(stimulus, 10e3, 0)));
        const auto afferents = plans({"sa1"});
        RunSummary summary;
        Sink* sinks[] = {&summary};
        (void)value_or_throw(corpuscle::run(sources, afferents, sinks, {}));
        std::vector<std::string_view> names;
        for (const auto c : summary.columns()) names.push_back(measures[c].name);
        return names;
    };
    const auto has = [](const auto& names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); };
    for (const char* cyclic : {"sine", "grating", "press+sine", "sine+noise"}) EXPECT_TRUE(has(columns(cyclic), "entrainment")) << cyclic;
    for (const char* other : {"press", "noise", "chirp", "sine+grating"}) EXPECT_FALSE(has(columns(other), "entrainment")) << other;
}

}  // namespace
}  // namespace corpuscle
