// Trials of NWB files: our own are read again to the bit, those of other programs are read, and damaged files are refused.

#include "io/nwb/nwb_file.hpp"
#include "run/trials/epoch_table.hpp"
#include "support/file_writers.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::Hdf5File, test::read_file, test::TemporaryFolder, test::value_or_throw;

void write(const std::string& path, const std::vector<NwbTrial>& trials) {
    auto nwb = value_or_throw(NwbFile::create(path, {}));
    nwb.set_default_description("a test");
    for (const auto& ok : {nwb.add_trials(trials), nwb.commit()})
        if (!ok) throw std::runtime_error(ok.error().text());
}

/// "read", or the error without the folder.
std::string error_of(const std::string& path, const std::optional<std::string>& label = {}) {
    const auto table = read_epochs(path, label);
    return table ? "read" : table.error().text().substr(path.rfind('/') + 1);
}

/// Trials of another program: times, the texts "a" and "b" in `textures`, numbers in `blocks`, and several tags for each trial.
void write_foreign(const std::string& path, const std::vector<double>& starts = {3, 1}, const std::vector<double>& stops = {4, 2.5},
                   const char* textures = "texture", const char* blocks = "Block") {
    Hdf5File file(path);
    const auto column = [](const std::string& name) { return "/intervals/trials/" + name; };
    file.write_attribute("/", "neurodata_type", "NWBFile");
    file.write_numbers(column("start_time"), {starts.size()}, starts);
    file.write_numbers(column("stop_time"), {stops.size()}, stops, H5T_IEEE_F32LE);
    file.write_numbers(column(blocks), {2}, {7, 0.5});
    file.write_numbers(column("tags"), {3}, {1, 2, 3});
    file.write_numbers(column("tags_index"), {2}, {1, 3}, H5T_STD_U8LE);
    file.write_raw(column(textures), H5T_C_S1, H5T_C_S1, {2}, "ab");
}

TEST(NwbEpochs, TrialsAreReadAsTheyWereWritten) {
    const TemporaryFolder folder;
    EXPECT_TRUE(rc::check("round trip", [&](const std::map<std::uint16_t, std::uint8_t>& all) {
        std::vector<NwbTrial> trials;
        for (const auto& [start, length] : all)  // not exact in decimal digits
            trials.push_back(
                {start * 0.1, start * 0.1 + (length + 1) / 3.0, length % 2 ? "" : fmt::format("a, \"{}\" \xc3\xa9", length % 5)});
        RC_PRE(!trials.empty());
        write(folder / "x.nwb", trials);
        const auto read = value_or_throw(read_epochs(folder / "x.nwb"));
        RC_ASSERT(read.notes.empty() && read.trials.size() == trials.size());
        for (std::size_t k = 0; k < trials.size(); ++k)
            RC_ASSERT(std::tie(read.trials[k].start, read.trials[k].stop, read.trials[k].label) ==
                      std::tie(trials[k].start, trials[k].stop, trials[k].label));
    }));
}

TEST(NwbEpochs, TrialsOfOtherProgramsAreInOrderOfTimeAndOtherColumnsAreReported) {
    const TemporaryFolder folder;
    write_foreign(folder / "x.nwb");
    const auto table = value_or_throw(read_epochs(folder / "x.nwb"));
    ASSERT_EQ(table.trials.size(), 2U);
    EXPECT_EQ(std::tie(table.trials[0].start, table.trials[0].stop), std::tuple(1.0, 2.5));
    EXPECT_EQ(std::tie(table.trials[1].start, table.trials[1].stop), std::tuple(3.0, 4.0));
    EXPECT_EQ(table.trials[0].label, "trial");
    EXPECT_EQ(table.notes,
              std::vector<std::string>{"'Block', 'tags', 'texture' are not used; --label NAME takes the labels from a column"});
}

TEST(NwbEpochs, LabelsAreTextsOrNumbersOfAColumn) {
    const TemporaryFolder folder;
    write_foreign(folder / "x.nwb", {3, 1}, {4, 2}, "trial_type");
    const auto found = value_or_throw(read_epochs(folder / "x.nwb")), numbers = value_or_throw(read_epochs(folder / "x.nwb", "block"));
    EXPECT_EQ(found.trials[0].label, "b");
    EXPECT_EQ(found.trials[1].label, "a");
    EXPECT_EQ(found.notes, std::vector<std::string>{"'Block', 'tags' are not used"});
    EXPECT_EQ(numbers.trials[0].label, "0.5");
    EXPECT_EQ(numbers.trials[1].label, "7");
    EXPECT_EQ(error_of(folder / "x.nwb", "Texture"),
              "x.nwb: --label Texture: /intervals/trials has no such column; there are: Block, trial_type");
    EXPECT_EQ(error_of(folder / "x.nwb", "tags"),
              "x.nwb: --label tags: this column of /intervals/trials has not one value for each trial; select another column");
}

TEST(NwbEpochs, TheFirstOfTheNamesOfColumnsOfLabelsIsRead) {
    const TemporaryFolder folder;
    write_foreign(folder / "x.nwb", {3, 1}, {4, 2}, "condition", "Class");  // the last of the names of columns of labels
    EXPECT_EQ(value_or_throw(read_epochs(folder / "x.nwb")).trials[0].label, "b");
    EXPECT_EQ(value_or_throw(read_epochs(folder / "x.nwb", "class")).trials[0].label, "0.5");
}

TEST(NwbEpochs, WrongTablesAreRefusedWithTheRowAndTheValue) {
    const TemporaryFolder folder;
    const auto error = [&](const std::vector<double>& starts, const std::vector<double>& stops) {
        write_foreign(folder / "x.nwb", starts, stops);
        return error_of(folder / "x.nwb", "texture");
    };
    const double nan = std::nan("");
    EXPECT_EQ(error({1, 2}, {3, 1.5}),
              "x.nwb: /intervals/trials: row 1 (from 0): the trial stops at 1.5 s, but starts at 2 s; stop_time must be after start_time");
    EXPECT_EQ(error({nan, 2}, {3, 4}),
              "x.nwb: /intervals/trials: row 0 (from 0): start_time is nan, which is not a time; correct it, or give the trials as CSV");
    EXPECT_EQ(error({1, 2}, {3, HUGE_VAL}),
              "x.nwb: /intervals/trials: row 1 (from 0): stop_time is inf, which is not a time; correct it, or give the trials as CSV");
    EXPECT_EQ(error({1, 2}, {3}), "x.nwb: /intervals/trials: start_time has 2 elements, but stop_time has 1; the file may be damaged");
    EXPECT_EQ(error({1}, {3}), "x.nwb: /intervals/trials: start_time has 1 elements, but texture has 2; the file may be damaged");
}

TEST(NwbEpochs, FilesWithoutTrialsAreRefused) {
    const TemporaryFolder folder;
    Hdf5File(folder / "a.nwb").write_numbers("/intervals/trials/start_time", {1}, {0});
    EXPECT_EQ(error_of(folder / "a.nwb"),
              "a.nwb: this HDF5 file is not an NWB file, the only HDF5 format with trials that is read: its root has "
              "no attribute neurodata_type = NWBFile");
    write(folder / "b.nwb", {});
    EXPECT_EQ(error_of(folder / "b.nwb"), "b.nwb: this NWB file has no trials: it has no table /intervals/trials; give the trials as CSV");
    const auto write_only = [&](const std::string& column, const std::vector<hsize_t>& shape) {
        Hdf5File file(folder / "c.nwb");
        file.write_attribute("/", "neurodata_type", "NWBFile");
        file.write_numbers("/intervals/trials/" + column, shape, {1, 2, 3, 4});
        return folder / "c.nwb";
    };
    EXPECT_EQ(error_of(write_only("stop_time", {4})), "c.nwb: /intervals/trials has no column 'start_time'");
    EXPECT_EQ(error_of(write_only("start_time", {4})), "c.nwb: /intervals/trials has no column 'stop_time'");
    EXPECT_EQ(error_of(write_only("start_time", {2, 2})), "c.nwb: /intervals/trials/start_time (2 x 2) must have one dimension");
}

TEST(NwbEpochs, DamagedFilesGiveAnErrorOrAreReadWithoutACrash) {
    const TemporaryFolder folder;
    write(folder / "x.nwb", {{0.5, 1, "tap"}, {1, 2, "press"}});
    const auto bytes = read_file(folder / "x.nwb");
    ASSERT_EQ(error_of(folder / "x.nwb"), "read");
    std::size_t refused = 0;
    for (std::size_t at = 0; at < bytes.size(); at += bytes.size() / 101) {
        auto damaged = bytes;
        damaged[at] = static_cast<char>(~damaged[at]);
        const auto error = error_of(folder.write("y.nwb", damaged));
        EXPECT_FALSE(error.empty());
        refused += error != "read";
    }
    EXPECT_GT(refused, 0U);
    for (std::size_t end = 0; end < bytes.size(); end += bytes.size() / 40 + 1)
        EXPECT_NE(error_of(folder.write("y.nwb", bytes.substr(0, end))), "read") << end;
}

}  // namespace
}  // namespace corpuscle
