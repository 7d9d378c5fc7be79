// Audio files as recordings: integers are fractions of full scale, floats are newtons, and the rate comes from the file.

#include "io/recording/recording_formats.hpp"
#include "support/file_writers.hpp"
#include "support/loaded_recording.hpp"
#include "support/property.hpp"

namespace corpuscle {
namespace {

using test::TemporaryFolder, test::load_recording, test::load_error, test::write_audio;

struct SampleFormat {
    const char* name;
    int format;
};

TEST(Wav, EverySampleFormatIsReadAsItWasWritten) {
    const SampleFormat sample_formats[] = {{"x.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16},   {"x.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_24},
                                           {"x.w64", SF_FORMAT_W64 | SF_FORMAT_PCM_32},   {"x.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT},
                                           {"x.wav", SF_FORMAT_WAV | SF_FORMAT_DOUBLE},   {"x.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_24},
                                           {"x.aiff", SF_FORMAT_AIFF | SF_FORMAT_PCM_16}, {"x.au", SF_FORMAT_AU | SF_FORMAT_PCM_16}};
    EXPECT_TRUE(rc::check("round trip", [&] {
        const auto& sample_format = *rc::gen::elementOf(std::vector(std::begin(sample_formats), std::end(sample_formats)));
        const auto rows = *rc::gen::inRange<std::size_t>(2, 200), columns = *rc::gen::inRange<std::size_t>(1, 4);
        const int rate = *rc::gen::inRange(1, 65536);  // the limit of plain FLAC
        std::vector<std::vector<double>> values(columns);
        for (auto& c : values)
            c = *rc::gen::container<std::vector<double>>(rows,
                                                         rc::gen::map(rc::gen::inRange(-1024, 1024), [](int x) { return x / 1024.0; }));
        const auto path =
            (std::filesystem::temp_directory_path() / fmt::format("corpuscle-{}-{}", ::getpid(), sample_format.name)).string();
        write_audio(path, sample_format.format, rate, values);
        const auto recording = test::try_load_recording(path, {.scale = 2});
        std::filesystem::remove(path);
        RC_ASSERT(static_cast<bool>(recording));
        RC_ASSERT(recording->clock.rate() == rate);
        for (auto& c : values)
            for (auto& x : c) x *= 2;
        RC_ASSERT(recording->force == values);
    }));
}

TEST(Wav, IntegersNeedAScaleAndFloatsAreNewtons) {
    const TemporaryFolder folder;
    const std::vector<std::vector<double>> force = {std::vector<double>(9000, 0.25), std::vector<double>(9000, 0.5)};
    write_audio(folder / "x.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 8000, force);
    EXPECT_EQ(load_error(folder / "x.wav"),
              "x.wav: 'ch1' is in full scale, which is not a known unit of force (N, mN, gf, kgf, lbf ...); use --scale S for S newtons "
              "per full scale, --unit N if the header is wrong, or --channel to select another column");
    EXPECT_EQ(load_recording(folder / "x.wav", {.channels = {"ch2"}, .scale = 8}).force[0][8999], 4);
    write_audio(folder / "y.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 8000, force);
    EXPECT_EQ(load_recording(folder / "y.wav").force[1][8999], 0.5);
    EXPECT_EQ(load_recording(folder / "y.wav").notes.at(0), "no unit for 'ch1', 'ch2': assuming newtons");
}

TEST(Wav, UnreadableFilesGiveAnError) {
    const TemporaryFolder folder;
    EXPECT_EQ(load_error(folder.write("x.wav", "t,F\n0,1\n")), "x.wav: not a readable sound file: Format not recognised.");
    EXPECT_EQ(load_error(folder / "none.wav"), "none.wav: cannot be opened: No such file or directory");
    EXPECT_EQ(load_error(folder.write("x.wav", ""), {.table = {"a"}}), "--dataset a: a sound file has only one array");
    write_audio(folder / "y.wav", SF_FORMAT_WAV | SF_FORMAT_FLOAT, 100, {{1, std::nan("")}});
    EXPECT_EQ(load_error(folder / "y.wav"), "y.wav: row 2: column 'ch1': nan where a number is expected");
    write_audio(folder / "z.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16, 100, {{}});
    EXPECT_EQ(load_error(folder / "z.wav"), "z.wav: this sound file has no samples");
}

TEST(Wav, TheBeginningOfATruncatedFileIsRead) {
    const TemporaryFolder folder;
    write_audio(folder / "x.wav", SF_FORMAT_WAV | SF_FORMAT_DOUBLE, 100, {std::vector<double>(1000, 1.5)});
    const auto complete = test::read_file(folder / "x.wav");
    const auto recording = load_recording(folder.write("cut.wav", complete.substr(0, complete.size() - 4000)));
    EXPECT_EQ(recording.force[0], std::vector<double>(500, 1.5));
    EXPECT_EQ(recording.notes.at(0),
              "the samples need 8000 bytes, but the file has 4000; it may be incomplete, and only this part of the recording is read");
    for (const auto& [name, format] : {std::pair{"x.aiff", SF_FORMAT_AIFF | SF_FORMAT_PCM_16}, {"x.au", SF_FORMAT_AU | SF_FORMAT_PCM_16}}) {
        write_audio(folder / name, format, 100, {std::vector<double>(1000, 0.5)});
        EXPECT_TRUE(load_recording(folder / name, {.scale = 1}).notes.empty()) << name;
        const auto bytes = test::read_file(folder / name);
        const auto cut = load_recording(folder.write(name, bytes.substr(0, bytes.size() - 1000)), {.scale = 1});
        EXPECT_EQ(cut.force[0].size(), 500U) << name;
        ASSERT_FALSE(cut.notes.empty()) << name;
        EXPECT_NE(cut.notes[0].find("it may be incomplete"), std::string::npos) << cut.notes[0];
    }
    write_audio(folder / "x.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16, 100, {test::force("noise", {.rate = 20000})});
    const auto compressed = test::read_file(folder / "x.flac");
    EXPECT_NE(load_error(folder.write("cut.flac", compressed.substr(0, compressed.size() / 2)), {.scale = 1}).find("may be truncated"),
              std::string::npos);
}

}  // namespace
}  // namespace corpuscle
