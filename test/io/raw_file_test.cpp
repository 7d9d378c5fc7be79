// Reading the .raw files of ngspice, of LTspice and of this program.

#include "io/spice/raw_file.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "support/program.hpp"

namespace corpuscle {
namespace {

std::string header(const std::string& points = "2", const std::string& flags = "real") {
    return "Title: t\nPlotname: DC transfer characteristic\nFlags: " + flags + "\nNo. Variables: 2\nNo. Points: " + points +
           "\nVariables:\n\t0\tv(g)\tvoltage\n\t1\ti(vd)\tcurrent\n";
}

std::string wide(const std::string& text) {
    std::string out;
    for (const char c : text) out += c, out += '\0';
    return out;
}

template <class T, class Bits>
std::string bytes_of(std::initializer_list<T> values) {
    std::string out;
    for (const T x : values)
        for (std::size_t k = 0; k < sizeof x; ++k) out += static_cast<char>(std::bit_cast<Bits>(x) >> (8 * k));
    return out;
}
std::string doubles(std::initializer_list<double> values) { return bytes_of<double, std::uint64_t>(values); }
std::string floats(std::initializer_list<float> values) { return bytes_of<float, std::uint32_t>(values); }

void expect_curve(const Result<std::vector<RawPlot>>& plots, std::size_t count) {
    ASSERT_TRUE(plots) << plots.error().text();
    ASSERT_EQ(plots->size(), count);
    for (const auto& plot : *plots) {
        EXPECT_EQ(plot.name, "DC transfer characteristic");
        EXPECT_EQ(plot.variables, (std::vector<std::string>{"v(g)", "i(vd)"}));
        EXPECT_EQ(plot.values[0], (std::vector<double>{0, 0.5}));
        EXPECT_NEAR(plot.values[1][1], -1e-6, 1e-13);
    }
}

TEST(RawFile, ReadsSeveralPlotsOfNgspiceInBothForms) {
    const auto text = header() + "Values:\n 0\t0.0\n\t-1e-12\n\n 1\t5e-1\n\t-1e-6\n\n";
    expect_curve(parse_raw(text + text, "a.raw"), 2);
    const auto binary = header() + "Binary:\n" + doubles({0, -1e-12, 0.5, -1e-6});
    expect_curve(parse_raw(binary + binary, "a.raw"), 2);
}

TEST(RawFile, ReadsTheFormsOfLtspiceWithAHeaderInUtf16) {
    const auto points = wide(header() + "Binary:\n"), fast = wide(header("2", "real forward fastaccess") + "Binary:\n"),
               precise = wide(header("2", "real forward double") + "Binary:\n");
    const auto mixed = [](double a, float b) { return doubles({a}) + floats({b}); };
    expect_curve(parse_raw(points + mixed(0, -1e-12F) + mixed(0.5, -1e-6F), "a.raw"), 1);
    expect_curve(parse_raw(points + floats({0, -1e-12F, 0.5F, -1e-6F}), "a.raw"), 1);
    expect_curve(parse_raw(fast + doubles({0, 0.5}) + floats({-1e-12F, -1e-6F}), "a.raw"), 1);
    expect_curve(parse_raw(precise + doubles({0, -1e-12, 0.5, -1e-6}), "a.raw"), 1);
}

TEST(RawFile, ReadsWhatRunWrites) {
    const test::TemporaryFolder folder;
    folder.write("c.cir", "t\nvg g 0 0\nrd g 0 1meg\n.dc vg 0 0.5 0.5\n.save v(g) i(vg)\n");
    for (const std::string form : {"", " --ascii"}) {
        ASSERT_EQ(test::run_program(folder, "run c.cir -q -o c.raw" + form).status, 0);
        const auto plots = read_raw_file(folder / "c.raw");
        ASSERT_TRUE(plots) << plots.error().text();
        EXPECT_EQ((*plots)[0].variables, (std::vector<std::string>{"v-sweep", "v(g)", "i(vg)"}));
        EXPECT_NEAR((*plots)[0].values[2][1], -0.5e-6, 1e-12);
    }
}

TEST(RawFile, ErrorsNameTheLineAndTheRemedy) {
    const std::pair<std::string, std::string> rows[] = {
        {"", "the file is empty; expected a .raw file"},
        {"VGS,ID\n0,1\n", "a.raw:1: a .raw file of SPICE begins with 'Title:'; for columns of numbers, name the file .csv"},
        {header(), "the file ends before its numbers"},
        {header("0") + "Values:\n", "has no points; run the simulation again"},
        {header("x"), "a.raw:5: 'x' is not a number of points"},
        {header("-1"), "'-1' is not a number of points"},
        {header() + "Binary:\n" + doubles({1, 2, 3}), "the file ends after 1 of 2 points"},
        {header() + "Values:\n 0\t0.0\n\tabc\n", "a.raw:11: 'abc' is not a number; point 0 of 2 needs a value of i(vd)"},
        {header("2", "complex") + "Binary:\n", "is complex (an AC analysis); real curves are needed"},
        {header() + "No. Variables: 3\nValues:\n 0 1 2 3\n 1 1 2 3\n",
         "a.raw:10: 'No. Variables: 3' differs from the list of 2 variables above it"},
        {"Title: t\nNo. Points: 1\nVariables:\n", "a.raw:3: the line 'No. Variables:' is missing"},
    };
    for (const auto& [bytes, expected] : rows) {
        const auto refused = parse_raw(bytes, "a.raw");
        ASSERT_FALSE(refused) << expected;
        EXPECT_NE(refused.error().text().find(expected), std::string::npos) << refused.error().text();
    }
}

}  // namespace
}  // namespace corpuscle
