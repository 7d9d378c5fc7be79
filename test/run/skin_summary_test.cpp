// Output for a skin of five afferents. The spikes are chosen so that every number can be checked by counting.

#include "run/summary/skin_summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/skin/binned_frames.hpp"
#include "report/skin/skin_report.hpp"
#include "run/skin/skin_population.hpp"
#include "support/property.hpp"
#include "support/sinks.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::value_or_throw;
using SkinJson = nlohmann::ordered_json;

/// Three sites, the third on the palm. sa1 has three afferents, fa1 two. The receptive field of afferent 1 has two sites.
Innervation small_skin() {
    Innervation skin;
    skin.plan.name = "small";
    skin.plan.sites = {.positions = {{0, 0}, {2e-3, 0}, {4e-3, 1e-3}},
                       .names = {"a", "b", "c"},
                       .region = {0, 0, 1},
                       .regions = {"tip", "palm"},
                       .area = 4e-6};
    for (const auto* name : {"sa1", "fa1"})
        skin.plan.classes.push_back(
            {.name = name, .afferent = value_or_throw(plan_afferent(name)), .density = {1e6, 5e5}, .sources = {{"density", "made up"}}});
    skin.afferents = {
        {0, 1, 0, {0, 0}}, {0, 2, 0, {2e-3, 0}}, {0, 3, 1, {4e-3, 1e-3}, 2e-3}, {1, 1, 0, {2e-3, 1e-3}}, {1, 2, 1, {4e-3, 0}}};
    skin.class_begin = {0, 3, 5};
    skin.fields = {{.begin = {0, 2, 3, 4}, .afferent = {0, 1, 1, 2}, .weight = {1, 0.4, 0.6, 1}},
                   {.begin = {0, 0, 1, 2}, .afferent = {0, 1}, .weight = {1, 1}}};
    return skin;
}

constexpr std::int64_t samples = 20;  // of 1 ms
const std::vector<Spike> spikes_in_time = {{3, 0.5, 0}, {6, 1, 1}, {6, 1, 3}, {11, 0.25, 0}, {15, 1, 1}, {15, 1, 3}};
const std::vector<Spike> late_spikes = {{21, 0.5, 3}};

/// 1 N at the first site from sample 2 to 11, 2 N at the second from 5 to 9.
double force_at(std::size_t site, std::int64_t k) { return site == 0 && k >= 2 && k <= 11 ? 1 : site == 1 && k >= 5 && k <= 9 ? 2 : 0; }

/// Passes a complete run to the sinks in blocks. `listed`: the blocks have a list of touched sites, and the force at other sites must not
/// be read.
void run_sinks(const Innervation& skin, const std::vector<Sink*>& sinks, std::int64_t block = samples, bool listed = false) {
    const SkinPopulation population(skin);
    const Input input{{"poke", "by hand", {1000, 1, 0}, {{"on", 0, 0.01}, {"off", 0.01, 0.02}}}, population};
    for (auto* l : sinks) ASSERT_TRUE(l->begin(input));
    for (std::int64_t first = 0; first < samples; first += block) {
        const auto steps = std::min(block, samples - first);
        std::vector<double> force, total(static_cast<std::size_t>(steps));
        for (std::size_t s = 0; s < 3; ++s)
            for (std::int64_t k = 0; k < steps; ++k) {
                const double f = force_at(s, first + k);
                force.push_back(listed && s == 2 ? 99 : f), total[static_cast<std::size_t>(k)] += f;
            }
        std::vector<Spike> spikes;
        for (const auto& s : spikes_in_time)
            if (s.step >= first && s.step < first + steps) spikes.push_back(s);
        const std::vector<std::uint32_t> touched = {0, 1};
        const SiteForce at{force.data(), static_cast<std::size_t>(steps), touched, !listed};
        const std::span<const double> total_force = total;
        for (auto* l : sinks) ASSERT_TRUE(l->block(input, {first, static_cast<std::size_t>(steps), {&total_force, 1}, at, spikes}));
    }
    for (auto* l : sinks) ASSERT_TRUE(l->end(input, samples, late_spikes));
}

const SkinSummaryRow& row_of(const SkinSummary& s, std::size_t class_index, std::size_t region, std::size_t phase) {
    return *std::find_if(s.rows.begin(), s.rows.end(),
                         [&](const SkinSummaryRow& r) { return r.class_index == class_index && r.region == region && r.phase == phase; });
}

SkinJson page_data(const std::string& page) {
    const std::string open = "<script type=\"application/json\" id=\"data\">";
    const auto from = page.find(open) + open.size();
    return SkinJson::parse(page.substr(from, page.find("</script>", from) - from));
}

std::vector<unsigned> decode_base64(const std::string& text) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned> out;
    unsigned word = 0, bits = 0;
    for (const char c : text) {
        if (c == '=') break;
        word = word << 6 | static_cast<unsigned>(letters.find(c)), bits += 6;
        if (bits >= 8) out.push_back(word >> (bits -= 8) & 255);
    }
    return out;
}

/// Dense rows of a page's frames: [frame][position].
std::vector<std::vector<unsigned>> frames_of(const SkinJson& frames) {
    const auto bytes = decode_base64(frames["data"]["u8"]);
    const auto value_count = frames["places"].get<std::size_t>();
    std::vector<std::vector<unsigned>> out;
    std::size_t at = 0;
    const auto number = [&] {
        unsigned n = 0, shift = 0;
        for (;; shift += 7) {
            n |= (bytes.at(at) & 127) << shift;
            if (bytes[at++] < 128) return n;
        }
    };
    for (std::size_t f = 0; f < frames["count"]; ++f) {
        std::vector<unsigned> dense;
        while (dense.size() < value_count) {
            const unsigned byte = bytes.at(at++);
            if (byte == 0)
                dense.resize(dense.size() + number());
            else
                dense.push_back(byte < 255 ? byte : number());
        }
        out.push_back(dense);
    }
    EXPECT_EQ(at, bytes.size());
    return out;
}

TEST(SkinSummary, CountsClassesByRegionAndPhase) {
    const auto skin = small_skin();
    SkinSummary s;
    run_sinks(skin, {&s});
    const auto& sa1 = row_of(s, 0, SkinSummaryRow::all, SkinSummaryRow::all);
    EXPECT_EQ(sa1.afferents, 3);
    EXPECT_EQ(sa1.active, 2);
    EXPECT_EQ(sa1.touched, 2);
    EXPECT_EQ(sa1.spikes, 4);
    EXPECT_DOUBLE_EQ(sa1.max_rate, 100);
    EXPECT_DOUBLE_EQ(sa1.rate(), 100);
    EXPECT_DOUBLE_EQ(sa1.first_spike, 2.5e-3);
    EXPECT_DOUBLE_EQ(sa1.median_first_spike, 4.25e-3);
    EXPECT_EQ(row_of(s, 0, SkinSummaryRow::all, 0).spikes, 2);
    EXPECT_EQ(row_of(s, 0, SkinSummaryRow::all, 1).spikes, 2);
    EXPECT_EQ(row_of(s, 0, 1, SkinSummaryRow::all).afferents, 1);
    EXPECT_EQ(row_of(s, 0, 1, SkinSummaryRow::all).active, 0);
    const auto& fa1 = row_of(s, 1, SkinSummaryRow::all, SkinSummaryRow::all);
    EXPECT_EQ(fa1.spikes, 3) << "including a spike that was delayed beyond the end of the force";
    EXPECT_EQ(row_of(s, 1, SkinSummaryRow::all, 1).spikes, 1) << "the delayed spike is in no phase";
    EXPECT_EQ(s.rows.size(), 2 * 3 * 3);
    EXPECT_DOUBLE_EQ(s.max_force, 3);
    EXPECT_DOUBLE_EQ(s.min_force, 0);
    EXPECT_DOUBLE_EQ(s.touch_start, 2e-3);
}

TEST(SkinSummary, ARateWhileTouchedUsesTheSiteOfLargestWeight) {
    const auto skin = small_skin();
    SkinSummary s;
    run_sinks(skin, {&s}, samples, true);
    EXPECT_DOUBLE_EQ(s.touched_times[0], 10e-3);
    EXPECT_DOUBLE_EQ(s.touched_times[1], 5e-3) << "the time at the second of its two sites, which has the larger weight";
    EXPECT_DOUBLE_EQ(s.touched_times[2], 0) << "a site that is not listed is ignored";
    EXPECT_DOUBLE_EQ(row_of(s, 0, SkinSummaryRow::all, SkinSummaryRow::all).touched_rate, 3 / 15e-3);
    EXPECT_DOUBLE_EQ(row_of(s, 0, SkinSummaryRow::all, 0).touched_rate, 2 / 13e-3);
    EXPECT_DOUBLE_EQ(row_of(s, 0, SkinSummaryRow::all, 1).touched_rate, 1 / 2e-3);
    EXPECT_DOUBLE_EQ(row_of(s, 1, SkinSummaryRow::all, SkinSummaryRow::all).touched_rate, 1 / 5e-3);
    EXPECT_TRUE(std::isnan(row_of(s, 0, 1, SkinSummaryRow::all).touched_rate));
}

TEST(SkinSummary, FirstSpikesAreOrderedByTimeThenAfferent) {
    const auto skin = small_skin();
    SkinSummary s;
    run_sinks(skin, {&s});
    const auto all = s.first_spikes(10);
    ASSERT_EQ(all.size(), 3U);
    EXPECT_EQ(all[0].afferent_index, 0U);
    EXPECT_EQ(all[1].afferent_index, 1U);
    EXPECT_EQ(all[2].afferent_index, 3U);
    EXPECT_DOUBLE_EQ(all[1].time, 6e-3);
    EXPECT_EQ(s.first_spikes(2).size(), 2U);
    EXPECT_TRUE(std::isnan(s.first_times[2]));
}

TEST(SkinSummary, FilesContainTheGivenSpikes) {
    const auto skin = small_skin();
    const TemporaryFolder folder;
    SkinSummary s;
    const auto spikes = test::make_sink(spikes_format, folder.path()),
               afferents = test::make_sink(afferents_format, folder.path(), {.skin = &s}),
               bins = test::make_sink(psth_format, folder.path(), {.options = {{"--bin", "10ms"}}});
    run_sinks(skin, {&s, spikes.get(), afferents.get(), bins.get()}, 7);
    for (auto* file : {spikes.get(), afferents.get(), bins.get()}) ASSERT_TRUE(file->commit());
    EXPECT_EQ(test::read_file(folder / "spikes.csv"),
              "afferent,channel,time_s\nsa1#1,tip,0.002500000\nsa1#2,tip,0.006000000\nfa1#1,tip,0.006000000\nsa1#1,tip,0.010250000\n"
              "sa1#2,tip,0.015000000\nfa1#1,tip,0.015000000\nfa1#1,tip,0.020500000\n");
    EXPECT_EQ(
        test::read_file(folder / "afferents.csv"),
        "afferent_index,afferent,region,x_mm,y_mm,delay_ms,spikes,first_spike_s,touched_s,rate_Hz\n0,sa1#1,tip,0.000,0.000,0.000000,2,0."
        "002500000,0.01,100\n"
        "1,sa1#2,tip,2.000,0.000,0.000000,2,0.006000000,0.005,100\n2,sa1#3,palm,4.000,1.000,2.000000,0,,0,0\n"
        "3,fa1#1,tip,2.000,1.000,0.000000,3,0.006000000,0.005,150\n4,fa1#2,palm,4.000,0.000,0.000000,0,,0,0\n");
    const auto psth = test::read_file(folder / "psth.csv");
    EXPECT_TRUE(
        psth.starts_with("afferent,channel,afferents,from_s,to_s,spikes,rate_Hz\nsa1,tip,2,0.000000000,0.010000000,2,100\nsa1,palm,1,"))
        << psth;
    EXPECT_NE(psth.find("fa1,tip,1,0.020000000,0.022000000,1,500\n"), psth.npos) << "the last bin ends after the last spike\n" << psth;
}

TEST(SkinSummary, PreferredDirectionsAreInTheFileOfAfferents) {
    auto skin = small_skin();
    skin.plan.classes[0].direction.gain = 0.5;
    skin.afferents[1].direction = -1.5707963267948966;
    const TemporaryFolder folder;
    SkinSummary s;
    const auto afferents = test::make_sink(afferents_format, folder.path(), {.skin = &s});
    run_sinks(skin, {&s, afferents.get()});
    ASSERT_TRUE(afferents->commit());
    const auto file = test::read_file(folder / "afferents.csv");
    EXPECT_NE(file.find("rate_Hz,direction_deg\n"), file.npos) << file;
    EXPECT_NE(file.find("1,sa1#2,tip,2.000,0.000,0.000000,2,0.006000000,0.005,100,270.000\n"), file.npos) << file;
    EXPECT_NE(file.find("4,fa1#2,palm,4.000,0.000,0.000000,0,,0,0,\n"), file.npos) << file;
}

TEST(SkinPage, ContainsForceMapsAndEverySpike) {
    const auto skin = small_skin();
    SkinSummary s;
    SkinReport report;
    run_sinks(skin, {&s, &report});
    const auto data = page_data(skin_page(s, report, {}, {.notes = {"</script> left out"}}, "corpuscle respond poke"));
    EXPECT_EQ(data["notes"], (SkinJson{"</script> left out"}));
    const auto& over = data["over"];
    EXPECT_EQ(over["samples"], 20);
    EXPECT_EQ(over["shown_samples"], 21);
    const std::vector<std::vector<unsigned>> by_afferent = {{1, 1, 0, 1, 0}, {1, 1, 0, 1, 0}, {0, 0, 0, 1, 0}};
    EXPECT_DOUBLE_EQ(over["marks"]["width"], 10e-3);
    EXPECT_EQ(frames_of(over["marks"]), by_afferent);
    EXPECT_DOUBLE_EQ(over["sites"]["max"], 1.0);  // of ten samples, five with 2 N
    EXPECT_EQ(frames_of(over["sites"])[0], (std::vector<unsigned>{203, 254, 0})) << "eight samples of 1 N";
    EXPECT_EQ(frames_of(over["sites"])[1], (std::vector<unsigned>{51, 0, 0}));
    EXPECT_EQ(frames_of(over["classes"])[5], (std::vector<unsigned>{0, 0}));
    EXPECT_EQ(frames_of(over["classes"])[6], (std::vector<unsigned>{1, 1})) << "a bin includes its start";
    // For each of the afferents 0, 1 and 3: afferents skipped before it, its spikes, and the intervals in tenths of a sample.
    EXPECT_EQ(decode_base64(over["spikes"]["data"]["u8"]), (std::vector<unsigned>{0, 2, 25, 78, 0, 2, 60, 90, 1, 3, 60, 90, 55}));
}

TEST(SkinPage, OmitsSpikesIfThereAreTooMany) {
    const auto skin = small_skin();
    SkinSummary s;
    SkinReport all({.timed_spikes = 7}), few({.frames = 2, .marks = 2, .timed_spikes = 6});
    run_sinks(skin, {&s, &all, &few});
    EXPECT_EQ(all.document()["spikes"]["count"], 7);
    EXPECT_TRUE(few.document()["spikes"].is_null());
    EXPECT_EQ(few.document()["afferents_per_mark"], 3);
    EXPECT_EQ(frames_of(few.document()["marks"]), (std::vector<std::vector<unsigned>>{{4, 2}, {0, 1}})) << "two frames of 20 ms";
}

TEST(SkinPage, DoesNotDependOnTheBlock) {
    const auto skin = small_skin();
    const auto page_for = [&](std::int64_t block, bool listed) {
        SkinSummary s;
        SkinReport report({.frames = 4, .bins = 4});
        run_sinks(skin, {&s, &report}, block, listed);
        return skin_page(s, report, {}, {}, "") + s.document({}, {}).dump();
    };
    const auto in_one_block = page_for(samples, false);
    for (const std::int64_t block : {1, 3, 16}) EXPECT_EQ(page_for(block, block == 3), in_one_block) << block;
}

TEST(BinnedFrames, ContainTheAddedValuesForAnyNumberOfFrames) {
    EXPECT_TRUE(rc::check([] {
        const auto max_frames = static_cast<std::size_t>(*rc::gen::inRange(2, 9));
        const std::int64_t first_width = *rc::gen::inRange(1, 4);
        BinnedFrames<int> binned(3, max_frames, first_width);
        std::vector<std::pair<std::int64_t, std::uint32_t>> added;
        for (std::int64_t at = 0; const auto gap : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 9))) {
            at += gap;
            RC_ASSERT(binned.select_frame(at) > at);
            const auto position = static_cast<std::uint32_t>(gap % 3);
            binned.add(position, 1), added.push_back({at, position});
        }
        const auto frames = binned.frames();
        RC_ASSERT(frames.size() <= max_frames);
        RC_ASSERT(binned.width() % first_width == 0);
        for (std::size_t f = 0; f < frames.size(); ++f) {
            int found[3] = {};
            for (const auto& e : frames[f]) found[e.place] = e.value;
            for (std::uint32_t p = 0; p < 3; ++p)
                RC_ASSERT(found[p] == std::count_if(added.begin(), added.end(), [&](const auto& a) {
                              return a.second == p && a.first / binned.width() == static_cast<std::int64_t>(f);
                          }));
        }
    }));
}

}  // namespace
}  // namespace corpuscle
