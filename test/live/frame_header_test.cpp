// The names and units in the header of live frames, and lines with decimal commas.

#include <fmt/format.h>

#include "live/input/frame_decoder.hpp"
#include "live/input/frame_header.hpp"
#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::run_program, test::TemporaryFolder;
using Names = std::vector<std::string>;

/// Readings of equal columns: presses of 3 N, in a unit of which `per_newton` are one newton.
std::string readings(std::string_view header, std::size_t columns, double per_newton, std::string_view separator = ",") {
    std::string text(header);
    text += '\n';
    for (int k = 0; k < 500; ++k)
        for (std::size_t c = 0; c < columns; ++c)
            text += fmt::format("{:.5f}{}", (k % 100 < 30 ? 0.0 : 3.0) * per_newton, c + 1 == columns ? "\n" : separator);
    return text;
}

test::ProgramResult streamed(const TemporaryFolder& folder, const std::string& text, const std::string& options) {
    folder.write("frames.csv", text);
    return run_program(folder, "stream --rate 1kHz " + options + " < frames.csv");
}

TEST(FrameHeader, SentencesAndEmptyFieldsAreNotHeaders) {
    EXPECT_EQ(header_names("force (mN)", 1), Names{"force (mN)"});
    EXPECT_EQ(header_names("load cell HX711 (serial 0417)", 1), Names{});
    EXPECT_EQ(header_names("load cell (0417), left (b)", 2, true), Names{});
    EXPECT_EQ(header_names(",,", 3), Names{});
    const TemporaryFolder folder;
    for (const std::string comment : {"# load cell HX711 (serial 0417)", "# sampled in ms"}) {
        const auto ran = streamed(folder, readings(comment, 3, 1), "--population sa1 --channels 3 -q");
        EXPECT_EQ(ran.out, streamed(folder, readings("# ", 3, 1), "--population sa1 --channels 3 -q").out) << comment << ran.err;
        EXPECT_GT(std::count(ran.out.begin(), ran.out.end(), '\n'), 10);
    }
}

TEST(FrameHeader, GivesTheUnitOfEachColumnAsThatOfARecording) {
    const TemporaryFolder folder;
    const std::string options = "--population sa1,fa1 --channels 2";
    const auto newtons = streamed(folder, readings("a_N,b_N", 2, 1), options).out;
    EXPECT_GT(std::count(newtons.begin(), newtons.end(), '\n'), 10);
    for (const std::string header : {"a_mN,b_mN", "a [mN],b [mN]", "\"a (mN)\",\"b (mN)\"", "a/mN;b/mN", "# a_mN,b_mN"}) {
        const auto ran = streamed(folder, readings(header, 2, 1e3, header.find(';') == header.npos ? "," : ";"), options);
        EXPECT_EQ(ran.out, newtons) << header << ran.err;
        EXPECT_EQ(ran.err.find("unit"), std::string::npos) << ran.err;
        const auto recording = run_program(folder, "stream --in frames.csv --pace fast --rate 1kHz --population sa1,fa1 -q").out;
        EXPECT_EQ(std::count(recording.begin(), recording.end(), '\n'), std::count(newtons.begin(), newtons.end(), '\n')) << header;
    }
    const auto one = streamed(folder, readings("f [mN]", 1, 1e3), "").out;
    EXPECT_EQ(one, streamed(folder, readings("f", 1, 1), "").out) << "a blank in the only name";
    const auto grid = streamed(folder, readings("r1c1_N,r1c2_N,r2c1_N,r2c2_N", 4, 1), "--population 'grid 2x2'").out;
    EXPECT_EQ(streamed(folder, readings("r2c1_mN,r1c2_mN,r1c1_mN,r2c2_mN", 4, 1e3), "--population 'grid 2x2'").out, grid);
}

TEST(FrameHeader, WithoutAUnitOrWithAnotherThanTheOptionIsReported) {
    const TemporaryFolder folder;
    const auto overridden = streamed(folder, readings("f_N", 1, 1), "--unit mN");
    EXPECT_NE(overridden.err.find("standard input: --unit mN overrides the unit of 'f' in the header, N"), std::string::npos);
    EXPECT_EQ(overridden.out, streamed(folder, readings("f_mN", 1, 1), "").out);
    EXPECT_NE(streamed(folder, readings("f", 1, 1), "").err.find("standard input: no unit for 'f': assuming newtons"), std::string::npos);
    const auto quiet = streamed(folder, readings("f_N", 1, 1), "--unit mN --quiet");
    EXPECT_EQ(quiet.err, "");
    EXPECT_EQ(streamed(folder, readings("f_V", 1, 1), "--scale 2").err.find("unit"), std::string::npos) << "the scale is that of volts";
}

TEST(FrameHeader, WithAUnitThatIsNotAForceIsRefusedAsThatOfARecording) {
    const TemporaryFolder folder;
    for (const auto& [header, message] :
         {std::pair{"f_V",
                    "standard input: header: 'f' is in V, which is not a force; use --scale S for S newtons per V, --unit N if the "
                    "header is wrong, or send only the columns that are forces, as cut -d, -f2 does"},
          {"f [foo]", "'f' is in foo, which is not a known unit of force"},
          {"f_kg", "'f' is in kg, which is a mass; use --unit kgf if it is the weight of that mass"}}) {
        const auto refused = streamed(folder, readings(header, 1, 1), "");
        EXPECT_EQ(refused.status, 1);
        EXPECT_NE(refused.err.find(message), std::string::npos) << refused.err;
        EXPECT_EQ(streamed(folder, readings(header, 1, 1), "--unit N").status, 0) << header;
        EXPECT_EQ(streamed(folder, readings(header, 1, 1), "--scale 1").status, 0) << header;
    }
    const auto both = streamed(folder, readings("f", 1, 1), "--unit mN --scale 2");
    EXPECT_EQ(both.status, 2);
    EXPECT_NE(both.err.find("--unit and --scale exclude each other"), std::string::npos) << both.err;
}

TEST(FrameHeader, ANumberOrAnotherWidthIsNotAHeader) {
    EXPECT_EQ(header_names("a, b [mN] ,\"c_N\"", 3), (Names{"a", "b [mN]", "c_N"}));
    EXPECT_EQ(header_names("a b", 2), (Names{"a", "b"}));
    EXPECT_EQ(header_names("Force 1 [mN]", 1), Names{"Force 1 [mN]"});
    EXPECT_EQ(header_names("a,b,", 2), (Names{"a", "b"}));
    for (const auto& [line, fields] :
         {std::pair{"1,2", 2}, {"nan,nan", 2}, {"3 4", 1}, {"0,5;0,7", 2}, {"a,1", 2}, {"a,b", 3}, {"a,b", 1}, {"", 1}})
        EXPECT_TRUE(header_names(line, static_cast<std::size_t>(fields)).empty()) << line;
}

TEST(FrameHeader, ColumnsOfDifferentUnitsHaveTheirOwnScales) {
    const FrameLayout layout{.sites = 3};
    FrameDecoder decoder(layout, 1,
                         [](std::span<const std::string>) -> Result<FrameColumns> { return FrameColumns{{2, 0, 1}, {1e-3, 1, 1}}; });
    const std::string text = "a,b,c\n500,2,3\n";
    std::copy(text.begin(), text.end(), decoder.buffer().begin());
    decoder.add_bytes(text.size());
    ASSERT_EQ(decoder.next(), FrameDecoder::Status::frame);
    std::vector<double> force(3);
    EXPECT_EQ(decoder.read_forces(force), 0U);
    EXPECT_EQ(force, (std::vector{2.0, 3.0, 0.5}));
    decoder.reset();  // the next sender has no header
    const std::string other = "1,2,3\n";
    std::copy(other.begin(), other.end(), decoder.buffer().begin());
    decoder.add_bytes(other.size());
    ASSERT_EQ(decoder.next(), FrameDecoder::Status::frame);
    EXPECT_EQ(decoder.read_forces(force), 0U);
    EXPECT_EQ(force, (std::vector{1.0, 2.0, 3.0}));
}

TEST(FrameHeader, DecimalCommasAreRecognisedAndTheRemedyWorks) {
    const TemporaryFolder folder;
    auto german = readings("", 4, 1, ";");
    std::replace(german.begin(), german.end(), '.', ',');
    const auto refused = streamed(folder, german, "--population 'grid 2x2'");
    EXPECT_EQ(refused.status, 1);
    const std::string command = "sed -u 's/,/./g'";
    EXPECT_NE(refused.err.find("frame 1 has 8 numbers; 'grid 2x2' has 4 sites, so a frame must have 4 numbers; if its commas are decimal "
                               "commas, replace them by points before sending, as " +
                               command + " does\n"),
              std::string::npos)
        << refused.err;
    ASSERT_EQ(std::system(fmt::format("{} '{}' > '{}'", command, folder / "frames.csv", folder / "points.csv").c_str()), 0);
    const auto repaired = run_program(folder, "stream --rate 1kHz --population 'grid 2x2' < points.csv");
    EXPECT_EQ(repaired.out, streamed(folder, readings("", 4, 1), "--population 'grid 2x2'").out);
    EXPECT_TRUE(has_decimal_commas("1;0,5;2", 3));
    EXPECT_FALSE(has_decimal_commas("1,2,3", 2));
    EXPECT_FALSE(has_decimal_commas("1;2;3", 3));
    EXPECT_FALSE(has_decimal_commas("a;0,5", 2));
}

}  // namespace
}  // namespace corpuscle
