// Which dimension of an array is time. Arrays with more channels than samples are refused, unless an option selects the dimension.

#include <cstring>

#include "io/table/archive.hpp"
#include "support/file_writers.hpp"
#include "support/loaded_recording.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::npy_bytes, test::load_recording, test::load_error;

/// An array of `rows` channels by 3000 samples; `by_columns`: stored in Fortran order.
std::string wide_array(std::size_t rows = 2, bool by_columns = false) {
    std::string data(rows * 3000 * sizeof(double), '\0');
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t k = 0; k < 3000; ++k) {
            const double x = static_cast<double>(r * 3000 + k) * 1e-4;
            std::memcpy(&data[(by_columns ? k * rows + r : r * 3000 + k) * sizeof x], &x, sizeof x);
        }
    return npy_bytes("'<f8'", fmt::format("({}, 3000)", rows), data, by_columns);
}

TEST(Orientation, AnArrayOfMoreChannelsThanSamplesIsRefusedUnlessAnOptionSelectsTheTime) {
    const TemporaryFolder folder;
    for (const bool by_columns : {false, true}) {
        const auto path = folder.write("x.npy", wide_array(2, by_columns));
        EXPECT_EQ(load_error(path, {.rate = 500}),
                  "x.npy: the array (2 x 3000): 3000 channels of only 2 samples? Use --transpose if each row is a channel, or "
                  "--no-transpose if each row is a sample");
        const auto transposed = load_recording(path, {.table = {{}, true}, .rate = 500}, 1000);
        EXPECT_EQ(transposed.names, (std::vector<std::string>{"ch1", "ch2"}));
        EXPECT_EQ(transposed.force[1][2999], 5999 * 1e-4);
        EXPECT_EQ(load_recording(path, {.table = {{}, true}, .channels = {"2"}, .rate = 500}).force[0][7], 3007 * 1e-4);
        const auto not_transposed = load_recording(path, {.table = {{}, false}, .rate = 500});
        EXPECT_EQ(not_transposed.names.size(), 3000U);
        EXPECT_EQ(not_transposed.force[7][1], 3007 * 1e-4);
    }
    const auto row = folder.write("row.npy", wide_array(1));
    EXPECT_EQ(load_recording(row, {.rate = 500}).force[0].size(), 3000U);
    EXPECT_EQ(load_recording(row, {.table = {{}, false}, .rate = 500}).names.size(), 3000U)
        << "--no-transpose: one sample of many electrodes";
}

TEST(Orientation, TimesInTheSameArchiveDetermineWhichDimensionIsTime) {
    const TemporaryFolder folder;
    const auto times = [](std::size_t count) {
        std::string data;
        for (std::size_t k = 0; k < count; ++k) {
            const double t = static_cast<double>(k) * 0.01;
            data.append(reinterpret_cast<const char*>(&t), sizeof t);
        }
        return ArchiveEntry{"t.npy", npy_bytes("'<f8'", fmt::format("({},)", count), data)};
    };
    for (const bool by_columns : {false, true}) {
        const ArchiveEntry force{"force.npy", wide_array(2, by_columns)};
        const auto transposed = load_recording(folder.write("x.npz", test::value_or_throw(make_archive({force, times(3000)}))));
        EXPECT_EQ(transposed.force.size(), 2U);
        EXPECT_EQ(transposed.force[1][5], 3005 * 1e-4);
        EXPECT_NE(transposed.notes.at(0).find("2 channels of 3000 samples, to match the times"), std::string::npos);
        EXPECT_EQ(load_recording(folder.write("y.npz", test::value_or_throw(make_archive({force, times(2)})))).force.size(), 3000U);
    }
}

std::string wide_text(const std::string& header = "") {
    std::string text = header;
    for (int r = 0; r < 3; ++r)
        for (int k = 0; k < 40; ++k) text += fmt::format("{}{}", 0.01 * (r * 40 + k), k == 39 ? "\n" : ",");
    return text;
}

TEST(Orientation, WideTextCausesAWarningAndCanBeTransposed) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.csv", wide_text());
    const auto not_transposed = load_recording(path, {.time = "none", .rate = 100});
    EXPECT_EQ(not_transposed.names.size(), 40U);
    ASSERT_FALSE(not_transposed.quality.warnings.empty());
    EXPECT_EQ(not_transposed.quality.warnings.back(),
              "40 columns, but only 3 rows. Use --transpose if each row is a channel, or --no-transpose if each row is a sample");
    const auto confirmed = load_recording(path, {.table = {{}, false}, .time = "none", .rate = 100});
    for (const auto& w : confirmed.quality.warnings) EXPECT_EQ(w.find("--transpose"), std::string::npos);
    const auto transposed = load_recording(path, {.table = {{}, true}, .rate = 100});
    EXPECT_EQ(transposed.names, (std::vector<std::string>{"ch1", "ch2", "ch3"}));
    EXPECT_NEAR(transposed.force[2][39], 1.19, 1e-12);
    std::string names;
    for (int k = 0; k < 40; ++k) names += fmt::format("taxel{}_N{}", k, k == 39 ? "\n" : ",");
    const auto named = load_recording(folder.write("y.csv", wide_text(names)), {.time = "none", .rate = 100});
    for (const auto& w : named.quality.warnings) EXPECT_EQ(w.find("--transpose"), std::string::npos) << "its columns have names";
}

TEST(Orientation, ASoundFileCannotBeTransposed) {
    const TemporaryFolder folder;
    test::write_audio(folder / "x.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 1000, {{0, 0.5, 0.25}});
    EXPECT_EQ(load_error(folder / "x.wav", {.table = {{}, true}, .scale = 1}),
              "--transpose: a sound file defines its channels, so it cannot be transposed");
}

TEST(Orientation, OneChannelThatNeverChangesCausesAWarning) {
    const TemporaryFolder folder;
    std::string text = "fz_N\n";
    for (int k = 0; k < 100; ++k) text += "0\n";
    const auto recording = load_recording(folder.write("x.csv", text), {.rate = 100});
    ASSERT_EQ(recording.quality.warnings.size(), 1U);
    EXPECT_EQ(recording.quality.warnings[0], "the force is constant, 0 N; check the file and the channel");
}

}  // namespace
}  // namespace corpuscle
