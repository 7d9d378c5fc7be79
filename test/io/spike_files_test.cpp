#include "io/spikes/spike_files.hpp"

#include <fmt/format.h>
#include <map>

#include "core/text/csv_field.hpp"
#include "io/output/output_file.hpp"
#include "io/table/npz.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;
using test::value_or_throw;

std::vector<NamedTrain> read_trains(const TemporaryFolder& folder, const std::string& text) {
    return value_or_throw(read_spikes(folder.write("x.csv", text)));
}

std::string refused(const std::string& path) {
    const auto trains = read_spikes(path);
    if (trains) return "read";
    const auto text = trains.error().text();
    return text.substr(std::min(text.size(), path.size() - std::filesystem::path(path).filename().string().size()));
}

TEST(SpikeFiles, FilesOfThisProgramAreReadByAfferentAndChannel) {
    const TemporaryFolder folder;
    const auto trains =
        read_trains(folder, "afferent,channel,time_s\nsa1,fz,0.5\nfa1,fz,0.25\nsa1,fz,0.125\nsa1,\"a \"\"b\"\", c\",1e-3\n");
    ASSERT_EQ(trains.size(), 3U);
    EXPECT_EQ(trains[0].name(), "sa1,a \"b\", c");
    EXPECT_EQ(trains[1].name(), "fa1,fz");
    EXPECT_EQ(trains[2].times, (std::vector<double>{0.125, 0.5})) << "in order of time, for any order in the file";
}

TEST(SpikeFiles, OtherFilesAreReadByTheUnitAndTimeOfTheirHeading) {
    const TemporaryFolder folder;
    const auto trains = read_trains(folder, "# made elsewhere\ntime_s,unit\n1.5,10\n1.25,9\n");
    ASSERT_EQ(trains.size(), 2U);
    EXPECT_EQ(trains[0].name(), "9") << "names that are numbers are ordered by value: 9 before 10";
    EXPECT_EQ(read_trains(folder, "unit; t [ms]\nn1; 250\n")[0].times, std::vector<double>{0.25});
    EXPECT_EQ(read_trains(folder, "time\n0.5\n0.25\n")[0].times.size(), 2U) << "one train without a name";
    EXPECT_TRUE(read_trains(folder, "afferent,channel,time_s\n").empty()) << "all trains were silent";
}

TEST(SpikeFiles, ErrorsNameTheFaultAndItsLocation) {
    const TemporaryFolder folder;
    const std::pair<const char*, const char*> cases[] = {
        {"afferent,channel,time_s\nsa1,fz,0.5\nsa1,fz,oops\n", "x.csv:3:8: 'oops' where a time is expected"},
        {"afferent,channel,time_s\nsa1,fz,inf\n", "x.csv:2:8: 'inf' where a time is expected"},
        {"afferent,channel,time_s\nsa1,0.5\n", "x.csv:2: 2 columns where 3 are expected"},
        {"afferent,channel,time_s\nsa1,\"fz,0.5\n", "x.csv:2:5: a quote is opened here but not closed"},
        {"a,b\n1,2\n",
         "x.csv:1: no column of spike times; rename one to time_s (or time, t [ms] ...), or select it with --time. Columns: 'a', 'b'"},
        {"time_s,fz_N\n0,1\n",
         "x.csv:1: no column identifies the trains; rename one to unit, afferent or channel, or select it with --train. "
         "Columns: 'time_s', 'fz_N'"},
        {"0.5 3\n0.6 4\n", "x.csv:1: 2 columns without a header; select the columns of times and trains, such as --time 1 --train 2"},
        {"unit,time_N\n1,1\n", "x.csv:1:6: 'N' is not a unit of time; use s, ms, us or min"},
        {"", "x.csv: the file has no header and no spikes"},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(refused(folder.write("x.csv", text)), message);
    EXPECT_EQ(refused(folder / "none.csv"), "none.csv: cannot be opened: No such file or directory");
}

TEST(SpikeFiles, ASingleColumnOfTimesNeedsNoHeader) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_trains(folder, "1.5e-01\n2.5e-01\n")[0].times, (std::vector<double>{0.15, 0.25})) << "as numpy.savetxt writes it";
    EXPECT_EQ(read_trains(folder, "# times of one unit\n0.5\n")[0].times, std::vector<double>{0.5});
    EXPECT_EQ(read_trains(folder, "[0.5, 0.25]")[0].times, (std::vector<double>{0.25, 0.5})) << "as JSON";
}

TEST(SpikeFiles, ColumnsOfOtherProgramsAreRecognisedOrNamedByOptions) {
    const TemporaryFolder folder;
    const auto phy = read_trains(folder, "times,cluster\n0.5,7\n0.25,3\n");
    ASSERT_EQ(phy.size(), 2U);
    EXPECT_EQ(phy[1].name(), "7");
    const auto commented = read_trains(folder, "# time_s unit\n0.5 7\n");
    EXPECT_EQ(commented[0].name(), "7");
    const auto read_with = [&](const std::string& text, const SpikeColumns& columns) {
        return value_or_throw(read_spikes(folder.write("x.csv", text), columns));
    };
    EXPECT_EQ(read_with("when,who\n0.5,a\n", {"when", "who"})[0].name(), "a");
    EXPECT_EQ(read_with("0.5 7\n0.25 7\n", {"1", "2"})[0].times, (std::vector<double>{0.25, 0.5}));
    EXPECT_EQ(read_with("when [ms],afferent,who\n500,x,a\n", {"when", "who"})[0].name(), "a")
        << "options take precedence over the usual column names";
    const auto wrong = read_spikes(folder.write("x.csv", "time,unit\n0.5,1\n"), {"when", {}});
    EXPECT_NE(wrong.error().message.find("--time when: there is no such column. Columns: 'time', 'unit'"), std::string::npos);
}

TEST(SpikeFiles, JsonLinesOfAStreamAreRead) {
    const TemporaryFolder folder;
    const auto trains = read_trains(
        folder, "{\"time_s\":0.25,\"afferent\":\"sa1#1\",\"address\":0}\n{\"time_s\":0.5,\"afferent\":\"sa1#2\",\"address\":1}\n");
    ASSERT_EQ(trains.size(), 2U);
    EXPECT_EQ(trains[1].name(), "sa1#2");
    EXPECT_EQ(refused(folder.write("x.jsonl", "{\"time_s\":0.25,\"unit\":1}\n{\"time_s\":null,\"unit\":1}\n")),
              "x.jsonl:2: null where a time is expected");
}

std::string npy_of(const std::string& kind, const std::string& shape, const std::string& bytes) {
    std::string header = "{'descr': '" + kind + "', 'fortran_order': False, 'shape': " + shape + ", }";
    header += std::string(117 - header.size(), ' ') + "\n";
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header + bytes;
}

TEST(SpikeFiles, NumpyTimesAreReadAndSampleNumbersAreRefused) {
    const TemporaryFolder folder;
    const double times[] = {0.5, 0.25};
    const std::string bytes(reinterpret_cast<const char*>(times), sizeof times);
    EXPECT_EQ(value_or_throw(read_spikes(folder.write("x.npy", npy_of("<f8", "(2,)", bytes))))[0].times, (std::vector<double>{0.25, 0.5}));
    const std::int64_t samples[] = {3000, 4000};
    const auto message = refused(folder.write("x.npy", npy_of("<i8", "(2,)", {reinterpret_cast<const char*>(samples), sizeof samples})));
    EXPECT_NE(message.find("the times are integers, as sample numbers are"), std::string::npos) << message;
    EXPECT_EQ(refused(folder.write("y.npy", npy_of("<f8", "(2, 2)", bytes + bytes))),
              "y.npy: the array has 2 columns; select the columns of times and trains, such as --time 1 --train 2");
    EXPECT_EQ(value_or_throw(read_spikes(folder / "y.npy", {"1", "2"}))[0].times.size(), 2U);
}

TEST(SpikeFiles, ErrorsForOtherBinaryFilesDoNotPrintTheirBytes) {
    const TemporaryFolder folder;
    EXPECT_EQ(refused(folder.write("x.h5", "\x89HDF\r\n")), "x.h5: not an HDF5 file (in MATLAB use save -v7.3)");
    EXPECT_EQ(refused(folder.write("x.wav", "RIFF1234")),
              "x.wav: this is a sound file, not a spike file; supported are CSV, JSON lines, .npy, .npz, NWB and address events");
    EXPECT_EQ(refused(folder.write("x.bin", std::string("\x01\0\x02", 3))),
              "x.bin: not a text file: it contains NUL bytes, as binary files do");
}

std::string npz_of(const std::map<std::string, std::vector<std::int64_t>>& integers, const std::vector<double>& rate = {1e3}) {
    NpzWriter npz;
    for (const auto& [name, list] : integers) npz.add(name, list);
    npz.add("sampling_frequency", rate);
    return value_or_throw(npz.bytes());
}

TEST(SpikeFiles, NpzOfOtherProgramsIsReadAsSpikeInterfaceReadsIt) {
    const TemporaryFolder folder;
    std::map<std::string, std::vector<std::int64_t>> lists = {{"unit_ids", {7, 3}},           {"num_segment", {2}},
                                                              {"spike_indexes_seg0", {1, 5}}, {"spike_labels_seg0", {7, 3}},
                                                              {"spike_indexes_seg1", {250}},  {"spike_labels_seg1", {7}}};
    const auto trains = value_or_throw(read_spikes(folder.write("x.npz", npz_of(lists))));
    ASSERT_EQ(trains.size(), 4U);
    EXPECT_EQ(trains[0].name(), "3");
    EXPECT_EQ(trains[1].times, std::vector<double>{1e-3});
    EXPECT_EQ(trains[3].name(), "7,segment 2");
    EXPECT_EQ(trains[3].times, std::vector<double>{0.25});

    EXPECT_EQ(refused(folder.write("x.npz", npz_of(lists, {0}))),
              "x.npz: num_segment and sampling_frequency must be one number each, and the frequency must be positive");
    auto bad = lists;
    bad["spike_labels_seg1"] = {8};
    EXPECT_EQ(refused(folder.write("x.npz", npz_of(bad))), "x.npz: spike 0 of segment 1 has label 8, which is not in unit_ids");
    bad["spike_labels_seg1"] = {7, 7};
    EXPECT_EQ(refused(folder.write("x.npz", npz_of(bad))), "x.npz: segment 1 has 1 spikes and 2 labels");
    bad.erase("spike_labels_seg1");
    EXPECT_NE(refused(folder.write("x.npz", npz_of(bad))).find("spike_labels_seg1"), std::string::npos);
}

TEST(SpikeFiles, AnyNameWithoutALineBreakIsReadBackUnchanged) {
    const TemporaryFolder folder;
    EXPECT_TRUE(rc::check("written and read", [&] {
        const auto letters = rc::gen::container<std::vector<std::string>>(
            rc::gen::elementOf(std::vector<std::string>{"a", ",", "\"", " ", ";", "#", "\t", "=", "\u00f6"}));
        const auto afferent = fmt::format("{}", fmt::join(*letters, "")), channel = fmt::format("{}", fmt::join(*letters, ""));
        const auto reread =
            read_trains(folder, "afferent,channel,time_s\n" + quote_csv_field(afferent) + "," + quote_csv_field(channel) + ",0.5\n");
        RC_ASSERT(reread.size() == 1U);
        RC_ASSERT(reread[0].afferent == afferent);
        RC_ASSERT(reread[0].channel == channel);
    }));
}

}  // namespace
}  // namespace corpuscle
