// The same netlists through Debian's ngspice and through us: every curve that both give, at every point.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "circuit/run.hpp"
#include "signal/text.hpp"
#include "support/raw_file.hpp"
#include "support/support.hpp"

namespace corpuscle::circuit {
namespace {

namespace fs = std::filesystem;
namespace test = corpuscle::test;

std::vector<std::string> decks() {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(test::root() + "/test/circuit/decks"))
        if (entry.path().extension() == ".cir") out.push_back(entry.path().stem());
    std::sort(out.begin(), out.end());
    return out;
}

/// What ngspice writes on standard output for a deck, and its .raw file if one is named.
std::string ngspice(const std::string& deck, const std::string& raw) {
    const auto command = "ngspice -b " + (raw.empty() ? "" : "-r " + raw + " ") + deck + " 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string out;
    char buffer[4096];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
    pclose(pipe);
    return out;
}

RunOutcome ours(const std::string& deck) {
    const auto netlist = Netlist::read(deck);
    EXPECT_TRUE(netlist) << (netlist ? "" : netlist.error().text());
    if (!netlist) return {};
    const auto circuit = netlist->elaborate();
    EXPECT_TRUE(circuit) << (circuit ? "" : circuit.error().text());
    if (!circuit) return {};
    static std::vector<std::shared_ptr<const Circuit>> kept;  // an outcome points at its circuit's commands
    kept.push_back(std::make_shared<const Circuit>(*circuit));
    auto outcome = run(kept.back());
    EXPECT_TRUE(outcome) << (outcome ? "" : outcome.error().text());
    return outcome ? *outcome : RunOutcome{};
}

/// A name as we give it: ngspice's files wrap what is no voltage in v(), and keep capitals.
std::string plain(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](char c) { return lower(c); });
    for (const std::string_view word : {"transfer_function", "impedance", "noise_"})
        if (name.starts_with("v(") && name.find(word) != std::string::npos) return name.substr(2, name.size() - 3);
    return name;
}

/// ngspice leaves 1e-7 of the largest value of a curve, and currents below what its own tolerances mean.
void hold(const Plot& mine, const Plot& theirs, double share) {
    ASSERT_EQ(mine.points(), theirs.points()) << mine.name;
    std::size_t held = 0;
    for (const auto& c : theirs.curves) {
        const auto* other = mine.curve(plain(c.name));
        if (other == nullptr) continue;
        ++held;
        if (other->name == "inoise_total") continue;  // theirs is 12 % off where the gain falls: see the closed form below
        double most = 0;
        if (c.type != "frequency")  // its imaginary part is left as memory was
            for (const auto& x : c.values) most = std::max(most, std::abs(x));
        const double floor = (c.type == "current" ? 2e-15 : 1e-9) + 1e-7 * most;
        for (std::size_t k = 0; k < c.values.size(); ++k)
            EXPECT_LE(std::abs(other->values[k] - (c.type == "frequency" ? c.values[k].real() : c.values[k])),
                      share * std::abs(c.type == "frequency" ? c.values[k].real() : c.values[k]) + floor)
                << c.name << " at point " << k << ": ours " << other->values[k] << ", theirs " << c.values[k];
    }
    const auto inner =
        std::count_if(mine.curves.begin(), mine.curves.end(), [](const Curve& c) { return c.name.find('#') != std::string::npos; });
    EXPECT_GE(held + 1 + static_cast<std::size_t>(inner), mine.curves.size()) << "curves that both have";
}

class Deck : public testing::TestWithParam<std::string> {};

TEST_P(Deck, GivesWhatNgspiceGives) {
    const std::string deck = test::root() + "/test/circuit/decks/" + GetParam() + ".cir";
    const auto raw = fs::temp_directory_path() / ("corpuscle-" + GetParam() + "-" + std::to_string(getpid()) + ".raw");
    const auto log = ngspice(deck, raw);
    const auto theirs = read_raw_file(raw);
    fs::remove(raw);
    ASSERT_FALSE(theirs.empty()) << log;
    const auto outcome = ours(deck);
    for (const auto& plot : theirs) {
        bool found = false;
        for (const auto& mine : outcome.plots())
            if (mine.name == plot.name || (plot.name == "Operating Point" && mine.name == plot.name)) {
                found = true;
                hold(mine, plot, mine.is_complex ? 1e-3 : 1e-5);
            }
        if (!found) ADD_FAILURE() << "no plot of ours is called '" << plot.name << "'";
    }
}

INSTANTIATE_TEST_SUITE_P(Ngspice, Deck, testing::ValuesIn(decks()), [](const auto& one) {
    std::string name = one.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

/// A deck of transistors by formulas, with our own transistors in their place: its line "* native: .model ..." says which.
std::string native(const std::string& deck) {
    std::istringstream lines(test::read_file(deck));
    std::string out, line;
    for (bool inside = false; std::getline(lines, line);) {
        if (line.starts_with(".subckt")) inside = true;
        const bool left_out = inside;
        if (line.starts_with(".ends")) inside = false;
        if (left_out) continue;
        if (line.starts_with("* native: ")) line = line.substr(10);
        if (line.starts_with("xm")) line = line.substr(1);
        out += line + '\n';
    }
    return out;
}

TEST(Transistor, CarriesInNgspiceByFormulasWhatItCarriesHere) {
    int decks_seen = 0;
    for (const auto& name : decks()) {
        if (!name.starts_with("uicm_")) continue;
        ++decks_seen;
        SCOPED_TRACE(name);
        const std::string deck = test::root() + "/test/circuit/decks/" + name + ".cir";
        const test::Folder folder;
        folder.write("native.cir", native(deck));
        (void)ngspice(deck, folder / "theirs.raw");
        const auto theirs = read_raw_file(folder / "theirs.raw");
        ASSERT_EQ(theirs.size(), 1U);
        const auto mine = ours(folder / "native.cir").plots();
        ASSERT_EQ(mine.size(), 1U);
        hold(mine[0], theirs[0], 1e-5);
    }
    EXPECT_EQ(decks_seen, 4);
}

TEST(Noise, IntegratesAsTheClosedFormsSay) {
    const auto outcome = ours(test::root() + "/test/circuit/decks/noise_rc.cir");
    const double white = 4 * 1.380649e-23 * 300.15 * 100e3, corner = 1 / (2 * M_PI * 100e3 * 10e-9);
    ASSERT_EQ(outcome.numbers.size(), 2U);
    EXPECT_NEAR(outcome.numbers[0].second, std::sqrt(white * corner * (std::atan(1e6 / corner) - std::atan(1 / corner))),
                2e-3 * outcome.numbers[0].second);
    EXPECT_NEAR(outcome.numbers[1].second, std::sqrt(white * (1e6 - 1)), 1e-9);
}

/// "name = value" lines.
double number_of(const std::string& log, const std::string& name) {
    for (std::size_t at = log.find("\n" + name); at != std::string::npos; at = log.find("\n" + name, at + 1)) {
        const auto equals = log.find('=', at + 1);
        const auto between = log.substr(at + 1 + name.size(), equals - at - 1 - name.size());
        if (between.find_first_not_of(' ') == std::string::npos) return std::stod(log.substr(equals + 1));
    }
    return std::nan("");
}

TEST(Measures, AreThoseOfNgspice) {
    for (const std::string name : {"measures_dc", "measures_ac"}) {
        const std::string deck = test::root() + "/test/circuit/decks/" + name + ".cir";
        const auto log = ngspice(deck, "");
        const auto outcome = ours(deck);
        EXPECT_GE(outcome.numbers.size(), 3U);
        for (const auto& [what, value] : outcome.numbers) {
            const double theirs = number_of(log, what);
            EXPECT_NEAR(value, theirs, std::abs(theirs) * 2e-5) << what << "\n" << log;
        }
    }
}

}  // namespace
}  // namespace corpuscle::circuit
