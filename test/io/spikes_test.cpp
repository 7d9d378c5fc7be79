#include "io/spikes.hpp"

#include <map>

#include "io/npz.hpp"
#include "io/output.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::Folder;
using test::sure;

std::vector<NamedTrain> read_trains(const Folder& folder, const std::string& text) {
    return sure(read_spikes(folder.write("x.csv", text)));
}

std::string refused(const std::string& path) {
    const auto trains = read_spikes(path);
    if (trains) return "read";
    const auto text = trains.error().text();
    return text.substr(std::min(text.size(), path.size() - std::filesystem::path(path).filename().string().size()));
}

TEST(SpikeFiles, OursAreReadByAfferentAndChannel) {
    const Folder folder;
    const auto trains =
        read_trains(folder, "afferent,channel,time_s\nsa1,fz,0.5\nfa1,fz,0.25\nsa1,fz,0.125\nsa1,\"a \"\"b\"\", c\",1e-3\n");
    ASSERT_EQ(trains.size(), 3U);
    EXPECT_EQ(trains[0].name(), "sa1,a \"b\", c");
    EXPECT_EQ(trains[1].name(), "fa1,fz");
    EXPECT_EQ(trains[2].times, (std::vector<double>{0.125, 0.5})) << "in order of time, whatever the file's";
}

TEST(SpikeFiles, OthersAreReadByUnitAndSecondsByTheirHeading) {
    const Folder folder;
    const auto trains = read_trains(folder, "# made elsewhere\ntime_s,unit\n1.5,10\n1.25,9\n");
    ASSERT_EQ(trains.size(), 2U);
    EXPECT_EQ(trains[0].name(), "9") << "numbers by value: 9 before 10";
    EXPECT_EQ(read_trains(folder, "unit; t [ms]\nn1; 250\n")[0].times, std::vector<double>{0.25});
    EXPECT_EQ(read_trains(folder, "time\n0.5\n0.25\n")[0].times.size(), 2U) << "one train without a name";
    EXPECT_TRUE(read_trains(folder, "afferent,channel,time_s\n").empty()) << "all were silent";
}

TEST(SpikeFiles, WhatIsWrongIsNamedWithItsPlace) {
    const Folder folder;
    const std::pair<const char*, const char*> cases[] = {
        {"afferent,channel,time_s\nsa1,fz,0.5\nsa1,fz,oops\n", "x.csv:3:8: 'oops' where a time should be"},
        {"afferent,channel,time_s\nsa1,fz,inf\n", "x.csv:2:8: 'inf' where a time should be"},
        {"afferent,channel,time_s\nsa1,0.5\n", "x.csv:2: 2 columns where 3 should be"},
        {"afferent,channel,time_s\nsa1,\"fz,0.5\n", "x.csv:2:5: a quote that is opened here does not end"},
        {"a,b\n1,2\n", "x.csv:1: no column of spike times; one is to be called time_s (or time, t [ms] ...); there are 'a', 'b'"},
        {"time_s,fz_N\n0,1\n",
         "x.csv:1: no column that says whose each spike is; one is to be called unit, afferent or channel; there are 'time_s', 'fz_N'"},
        {"unit,time_N\n1,1\n", "x.csv:1:6: 'N' is no unit of time; write s, ms, us or min"},
        {"", "x.csv: no header and no spikes in this file"},
    };
    for (const auto& [text, said] : cases) EXPECT_EQ(refused(folder.write("x.csv", text)), said);
    EXPECT_EQ(refused(folder / "none.csv"), "none.csv: cannot be opened: No such file or directory");
}

std::string npz_of(const std::map<std::string, std::vector<std::int64_t>>& integers, const std::vector<double>& rate = {1e3}) {
    NpzWriter npz;
    for (const auto& [name, list] : integers) npz.add(name, list);
    npz.add("sampling_frequency", rate);
    return sure(npz.bytes());
}

TEST(SpikeFiles, AnotherProgramsNpzIsReadAsSpikeInterfaceReadsIt) {
    const Folder folder;
    std::map<std::string, std::vector<std::int64_t>> lists = {{"unit_ids", {7, 3}},           {"num_segment", {2}},
                                                              {"spike_indexes_seg0", {1, 5}}, {"spike_labels_seg0", {7, 3}},
                                                              {"spike_indexes_seg1", {250}},  {"spike_labels_seg1", {7}}};
    const auto trains = sure(read_spikes(folder.write("x.npz", npz_of(lists))));
    ASSERT_EQ(trains.size(), 4U);
    EXPECT_EQ(trains[0].name(), "3");
    EXPECT_EQ(trains[1].times, std::vector<double>{1e-3});
    EXPECT_EQ(trains[3].name(), "7,segment 2");
    EXPECT_EQ(trains[3].times, std::vector<double>{0.25});

    EXPECT_EQ(refused(folder.write("x.npz", npz_of(lists, {0}))),
              "x.npz: num_segment and sampling_frequency are to be one number each, and a rate positive");
    auto bad = lists;
    bad["spike_labels_seg1"] = {8};
    EXPECT_EQ(refused(folder.write("x.npz", npz_of(bad))), "x.npz: spike 0 of segment 1 is of a unit 8 that unit_ids does not name");
    bad["spike_labels_seg1"] = {7, 7};
    EXPECT_EQ(refused(folder.write("x.npz", npz_of(bad))), "x.npz: segment 1 has 1 spikes and 2 labels");
    bad.erase("spike_labels_seg1");
    EXPECT_NE(refused(folder.write("x.npz", npz_of(bad))).find("spike_labels_seg1"), std::string::npos);
}

TEST(SpikeFiles, AnyNameWithoutALineBreakComesBackFromItsField) {
    const Folder folder;
    EXPECT_TRUE(rc::check("written and read", [&] {
        const auto letters = rc::gen::container<std::string>(rc::gen::element('a', ',', '"', ' ', ';', '#', '\t', '=', '\xf6'));
        const auto afferent = *letters, channel = *letters;
        const auto back = read_trains(folder, "afferent,channel,time_s\n" + csv_field(afferent) + "," + csv_field(channel) + ",0.5\n");
        RC_ASSERT(back.size() == 1U);
        RC_ASSERT(back[0].afferent == afferent);
        RC_ASSERT(back[0].channel == channel);
    }));
}

}  // namespace
}  // namespace corpuscle
