// For every recording format: the same samples give the same force.

#include "io/recording/recording_formats.hpp"

#include <cmath>

#include "io/table/archive.hpp"
#include "support/file_writers.hpp"
#include "support/loaded_recording.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder;

constexpr double sample_rate = 500;
const std::vector<std::vector<double>> two_channels = [] {
    std::vector<std::vector<double>> f(2, std::vector<double>(5000));
    for (std::size_t k = 0; k < 5000; ++k) f[0][k] = static_cast<double>(k % 1000) / 1024, f[1][k] = f[0][k] / 2;
    return f;
}();

std::string interleaved() {
    std::string data;
    for (std::size_t k = 0; k < two_channels[0].size(); ++k)
        for (const auto& c : two_channels) data.append(reinterpret_cast<const char*>(&c[k]), sizeof(double));
    return data;
}

std::string text() {
    std::string out = "t_s,ch1_N,ch2_N\n";
    for (std::size_t k = 0; k < two_channels[0].size(); ++k)
        out += fmt::format("{},{},{}\n", static_cast<double>(k) / sample_rate, two_channels[0][k], two_channels[1][k]);
    return out;
}

/// Writers for each format of the list. A new format needs an entry here.
const std::pair<std::string_view, void (*)(const TemporaryFolder&, const std::string& name)> writers[] = {
    {"text", [](const TemporaryFolder& f, const std::string& name) { f.write(name, text()); }},
    {"npy", [](const TemporaryFolder& f, const std::string& name) { f.write(name, test::npy_bytes("'<f8'", "(5000, 2)", interleaved())); }},
    {"npz",
     [](const TemporaryFolder& f, const std::string& name) {
         f.write(name, test::value_or_throw(make_archive({{"force_N.npy", test::npy_bytes("'<f8'", "(5000, 2)", interleaved())}})));
     }},
    {"sound",
     [](const TemporaryFolder& f, const std::string& name) {
         const auto kind = name.substr(name.find('.'));
         const int outer = kind == ".wav"    ? SF_FORMAT_WAV
                           : kind == ".w64"  ? SF_FORMAT_W64
                           : kind == ".flac" ? SF_FORMAT_FLAC
                           : kind == ".au"   ? SF_FORMAT_AU
                                             : SF_FORMAT_AIFF;
         test::write_audio(f / name, outer | (outer == SF_FORMAT_FLAC ? SF_FORMAT_PCM_16 : SF_FORMAT_FLOAT), 500, two_channels);
     }},
    {"hdf5",
     [](const TemporaryFolder& f, const std::string& name) {
         const auto data = interleaved();
         test::Hdf5File(f / name).write_raw("/force", H5T_NATIVE_DOUBLE, H5T_NATIVE_DOUBLE, {5000, 2}, data.data());
     }},
};

TEST(EveryFormat, GivesTheSameForce) {
    const TemporaryFolder folder;
    for (const auto& format : recording_formats) {
        const auto writer = std::find_if(std::begin(writers), std::end(writers), [&](const auto& w) { return w.first == format.name; });
        ASSERT_NE(writer, std::end(writers)) << "no writer for " << format.name;
        std::istringstream extensions{std::string(format.extensions)};
        for (std::string extension; extensions >> extension;) {
            const std::string name = "x" + extension;
            if (format.name == "text" && extension != ".csv") continue;  // recording_test.cpp tests the other extensions of text
            writer->second(folder, name);
            const auto recording = test::load_recording(folder / name, {.rate = sample_rate, .scale = 1});
            EXPECT_EQ(recording.force, two_channels) << name;
            EXPECT_EQ(recording.names, (std::vector<std::string>{"ch1", "ch2"})) << name;
            EXPECT_EQ(recording.clock.rate(), sample_rate) << name;
        }
    }
}

TEST(EveryFormat, ReportsAMissingOrEmptyFile) {
    const TemporaryFolder folder;
    for (const auto& format : recording_formats) {
        const auto name = "x" + std::string(format.extensions.substr(0, format.extensions.find(' ')));
        EXPECT_EQ(test::load_error(folder / name), name + ": cannot be opened: No such file or directory");
        EXPECT_NE(test::load_error(folder.write(name, "")), "read") << format.name;
        std::filesystem::remove(folder / name);
        std::filesystem::create_directory(folder / name);
        EXPECT_EQ(test::load_error(folder / name), name + ": this is a directory, not a file");
    }
}

}  // namespace
}  // namespace corpuscle
