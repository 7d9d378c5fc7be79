// Netlists exported with the transistors of a kit run in ngspice, and each array has the size, threshold and current that it should.

#include <cmath>

#include "circuit/devices.hpp"
#include "circuit/export/ngspice_deck.hpp"
#include "circuit/expression/spice_number.hpp"
#include "support/ngspice.hpp"

namespace corpuscle::circuit::test {
namespace {

using corpuscle::test::source_root;

constexpr const char* arrays = R"(arrays
vd d 0 0.6
vg g 0 0.4
vs s 0 0
vpd pd 0 -0.6
vpg pg 0 -0.4
m1 d g s 0 nch w=2u l=0.5u m=4
m2 d g s 0 nch w=2u l=0.5u m=2 stack=3 delvto=0.05
m3 d g s 0 nch_hv w=2u l=0.5u
m4 pd pg s 0 pch_hv w=6u l=0.5u m=2 delvto=0.1
m5 pd pg s 0 pch w=6u l=0.5u as=1p ad=2p ps=3u pd=4u
.model nch nmos (level=80 vto=0.4 ldif=0.4u)
.model nch_hv nmos (level=80 vto=0.55 ldif=0.4u)
.model pch pmos (level=80 vto=0.4)
.model pch_hv pmos (level=80 vto=0.55)
.op
)";

std::string kit_path(const std::string& name) { return source_root() + "/test/kits/" + name; }

Kit kit_of(const std::string& map, const std::string& card, std::array<std::string, 4> devices) {
    Kit kit{value_or_throw(read_kit_map(map)), card, ".", ""};
    kit.map.devices = std::move(devices);
    return kit;
}
Kit bsim3_kit() { return kit_of("bsim", kit_path("made_up_bsim3.lib"), {"made_n", "made_p", "", ""}); }
Kit level1_kit() { return kit_of("plain", kit_path("made_up_level1.lib"), {"simple_n", "simple_p", "", ""}); }

std::string deck_of(const std::shared_ptr<const Circuit>& circuit, const Kit& kit) {
    const auto deck = ngspice_deck(circuit, &kit);
    EXPECT_TRUE(deck) << (deck ? "" : deck.error().text());
    return deck ? deck->text : "";
}
std::string message_of(const std::string& netlist, const Kit& kit) {
    const auto deck = ngspice_deck(elaborate_netlist(Netlist::parse_text(netlist, "arrays.cir")), &kit);
    return deck ? "no error" : deck.error().text();
}

/// The currents of sources at the operating point that ngspice finds for a deck.
std::map<std::string, double> currents(const TemporaryFolder& folder, const std::string& deck) {
    const auto log = run_ngspice(folder.write("deck.cir", deck), folder / "deck.raw", folder.path());
    std::map<std::string, double> out;
    const auto plots = read_raw_file(folder / "deck.raw");
    EXPECT_EQ(plots.size(), 1U) << log;
    for (const auto& plot : plots)
        for (const auto& c : plot.curves) out[corpuscle_name(c.name)] = c.values.at(0).real();
    return out;
}

TEST(KitExport, ColumnsAreMultipliersAndUnitsInSeriesAreAChainUnderOneGate) {
    const auto deck = deck_of(elaborate_netlist(Netlist::parse_text(arrays, "arrays.cir")), bsim3_kit());
    for (const char* text : {"m1 d g s b made_n w=2e-06 l=5e-07 m=4 ad=8e-13 as=8e-13 pd=4.8e-06 ps=4.8e-06\n.ends",
                             "m1 d g n1 b made_n w=2e-06 l=5e-07 m=2 delvto=0.05 ad=8e-13 as=4e-13 pd=4.8e-06 ps=2.4e-06\n"
                             "m2 n1 g n2 b made_n w=2e-06 l=5e-07 m=2 delvto=0.05 ad=4e-13 as=4e-13 pd=2.4e-06 ps=2.4e-06\n"
                             "m3 n2 g s b made_n w=2e-06 l=5e-07 m=2 delvto=0.05 ad=4e-13 as=8e-13 pd=2.4e-06 ps=4.8e-06\n.ends",
                             "made_n w=2e-06 l=5e-07 m=1 delvto=0.15 ", "made_p w=6e-06 l=5e-07 m=2 delvto=-0.25 ",
                             "made_p w=6e-06 l=5e-07 m=1 ad=2e-12 as=1e-12 pd=4e-06 ps=3e-06\n"})
        EXPECT_NE(deck.find(text), std::string::npos) << text << "\n" << deck;
    EXPECT_EQ(deck.find("uicm_"), std::string::npos);
}

TEST(KitExport, EqualArraysShareASubcircuit) {
    const auto text = std::string(arrays) + "m6 d g s 0 nch w=2u l=0.5u m=4\n";
    const auto deck = deck_of(elaborate_netlist(Netlist::parse_text(text, "arrays.cir")), bsim3_kit());
    std::size_t count = 0;
    for (auto at = deck.find(".subckt"); at != std::string::npos; at = deck.find(".subckt", at + 1)) ++count;
    EXPECT_EQ(count, 5U) << deck;
    EXPECT_NE(deck.find("xm6 d g s 0 corpuscle_array_1\n"), std::string::npos) << deck;
}

/// Level 1 depends on the gate only through v_GS - V_T, so a source at the gate must be exact.
TEST(KitExport, ASourceAtTheGateShiftsTheThresholdExactly) {
    const TemporaryFolder folder;
    const std::string devices =
        "vd d 0 0.6\nvg g 0 0.5\nvpd pd 0 -0.6\nvpg pg 0 -0.55\nm1 d g 0 0 {} w=2u l=0.5u stack=2 {}\n"
        "m2 pd pg 0 0 {} w=6u l=0.5u {}\n";
    const std::string cards = ".model nch nmos (level=80)\n.model pch pmos (level=80)\n.op\n";
    const auto text = fmt::format(fmt::runtime("shifted\n" + devices + cards), "nch", "delvto=0.1", "pch", "delvto=0.15");
    const auto deck = deck_of(elaborate_netlist(Netlist::parse_text(text, "shifted.cir")), level1_kit());
    EXPECT_NE(deck.find("vt g gate 0.1\n"), std::string::npos) << deck;
    EXPECT_NE(deck.find("vt gate g 0.15\n"), std::string::npos) << deck;
    auto card = read_file(kit_path("made_up_level1.lib"));
    for (const auto& [from, to] : {std::pair{"vto=0.25", "vto=0.35"}, {"vto=-0.25", "vto=-0.4"}})
        card.replace(card.find(from), std::string(from).size(), to);
    folder.write("shifted.lib", card);
    const auto plain_text = fmt::format(fmt::runtime("plain\n" + devices + cards), "nch", "", "pch", "");
    const auto reference = deck_of(elaborate_netlist(Netlist::parse_text(plain_text, "plain.cir")),
                                   kit_of("plain", folder / "shifted.lib", {"simple_n", "simple_p", "", ""}));
    auto shifted = currents(folder, deck), expected = currents(folder, reference);
    for (const char* name : {"i(vd)", "i(vpd)"}) {
        EXPECT_GT(std::abs(expected.at(name)), 1e-7);
        EXPECT_NEAR(shifted.at(name), expected.at(name), 1e-6 * std::abs(expected.at(name))) << name;
    }
}

/// In level 1 a chain of N equal units without length modulation is one device of N times the length.
TEST(KitExport, AChainCarriesTheCurrentOfOneLongTransistor) {
    const TemporaryFolder folder;
    folder.write("simple.lib", ".model simple_n nmos (level=1 vto=0.3 kp=100u)\n");
    const auto kit = kit_of("plain", "simple.lib", {"simple_n", "", "", ""});
    const auto run = [&](const std::string& size) {
        const auto text = "chain\nvd d 0 0.1\nvg g 0 0.6\nm1 d g 0 0 nch " + size + "\n.model nch nmos (level=80)\n.op\n";
        return currents(folder, deck_of(elaborate_netlist(Netlist::parse_text(text, "chain.cir")), kit)).at("i(vd)");
    };
    const double chain = run("w=1u l=0.5u m=3 stack=8"), single = run("w=1u l=4u m=3");
    EXPECT_NEAR(chain, single, 1e-6 * std::abs(single));
    EXPECT_NEAR(single, -100e-6 * 3 / 4 * (0.3 * 0.1 - 0.005), 1e-9);
}

TEST(KitExport, ADeviceOfHigherThresholdOfTheKitIsUsedWithoutAShift) {
    const TemporaryFolder folder;
    auto kit = level1_kit();
    kit.map.devices = {"simple_n", "simple_p", "high_n", "high_p"};
    const auto deck = deck_of(elaborate_netlist(Netlist::parse_text(arrays, "arrays.cir")), kit);
    EXPECT_NE(deck.find("m1 d g s b high_n w=2e-06"), std::string::npos) << deck;
    EXPECT_NE(deck.find("vt gate g 0.1\nm1 d gate s b high_p w=6e-06"), std::string::npos) << deck;
}

class KitExportOfCircuit : public testing::TestWithParam<std::string> {};

/// Makes every analysis short: a sweep of about 30 points, a transient of 20 us. Sweeps of circuits with a transient are left out: ngspice
/// searches a minute for the points of the rectifiers.
std::shared_ptr<const Circuit> shortened(const std::shared_ptr<const Circuit>& circuit) {
    auto out = std::make_shared<Circuit>(*circuit);
    const bool has_transient = circuit->has_directive("tran");
    std::erase_if(out->directives,
                  [&](const Directive& c) { return c.name.starts_with("meas") || c.name == "save" || (has_transient && c.name == "dc"); });
    for (auto& c : out->directives) {
        if (c.name == "tran") c.words = {"1u", "20u"};
        if (c.name != "dc") continue;
        if (c.words.back() == "updown") c.words.pop_back();
        for (std::size_t k = 0; k + 3 < c.words.size(); k += 4) {
            const auto number = [&](std::size_t j) { return parse_number(c.words[k + j])->value; };
            c.words[k + 3] = fmt::format(
                "{:.17g}", std::copysign(std::max(std::abs(number(3)), std::abs(number(2) - number(1)) / 30), number(2) - number(1)));
        }
    }
    return out;
}

TEST_P(KitExportOfCircuit, RunsInNgspice) {
    const TemporaryFolder folder;
    const auto circuit = shortened(elaborate_netlist(GetParam()));
    const bool has_transistors = std::ranges::any_of(circuit->elements, [](const Element& e) { return has_role(e, Role::transistor); });
    const auto kit = bsim3_kit();
    const auto deck = ngspice_deck(circuit, &kit);
    if (!has_transistors) {
        ASSERT_FALSE(deck);
        EXPECT_NE(deck.error().text().find("has no transistors of level 80"), std::string::npos) << deck.error().text();
        return;
    }
    ASSERT_TRUE(deck) << deck.error().text();
    const auto log = run_ngspice(folder.write("deck.cir", deck->text), folder / "deck.raw", folder.path());
    const auto plots = read_raw_file(folder / "deck.raw");
    EXPECT_FALSE(plots.empty()) << log;
    for (const char* trouble : {"Timestep too small", "singular matrix", "could not find a valid modelname", "unknown subckt", "aborted"})
        EXPECT_EQ(log.find(trouble), std::string::npos) << log;
    for (const auto& plot : plots) {
        EXPECT_GT(plot.point_count(), 0U) << plot.name;
        for (const auto& c : plot.curves)
            for (const auto& x : c.values) ASSERT_TRUE(std::isfinite(std::abs(x))) << c.name;
    }
}

std::vector<std::string> circuit_files() {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(source_root() + "/circuits"))
        if (entry.path().extension() == ".cir") out.push_back(entry.path().string());
    std::sort(out.begin(), out.end());
    return out;
}

INSTANTIATE_TEST_SUITE_P(Circuits, KitExportOfCircuit, testing::ValuesIn(circuit_files()),
                         [](const auto& one) { return std::filesystem::path(one.param).stem().string(); });

TEST(KitExport, RefusesWhatAKitCannotSpell) {
    const auto with = [](const std::string& line) { return std::string(arrays) + line; };
    auto sky = value_or_throw(read_kit_map("sky130"));
    const Kit subcircuits{sky, "sky130.lib.spice", ".", ""};
    auto without_p = bsim3_kit(), without_shift = bsim3_kit(), without_columns = bsim3_kit();
    without_p.map.devices[1] = "", without_shift.map.hv_shift.reset(), without_columns.map.multipliers.clear();
    for (const auto& [netlist, kit, message] : std::vector<std::tuple<std::string, Kit, std::string>>{
             {"r\nr1 a 0 1k\nv1 a 0 1\n.op\n", bsim3_kit(), "--card: arrays.cir has no transistors of level 80"},
             {with("m9 d g s 0 nch w=1u l=1u stack=2.5\n"), bsim3_kit(),
              "arrays.cir:17:1: m9: stack=2.5 cannot be a chain of transistors; write a whole"},
             {with("m9 d g s 0 nch w=1u l=1u stack=1e6\n"), bsim3_kit(), "m9: stack=1000000 cannot be a chain"},
             {with("m9 d g s 0 nch w=1u l=1u mulu0=2\n"), level1_kit(), "m9: mulu0 has no counterpart in the map 'plain'"},
             {with("m9 d g s 0 nch w=1u l=1u temp=50\n"), subcircuits, "m9: temp has no counterpart in the map 'sky130'"},
             {arrays, without_columns, "m1: m has no counterpart in the map 'bsim'; leave it out, or write multiplier = "},
             {arrays, without_p, "m4: the kit has no device for pmos; name it: --pch NAME"},
             {"hv\nv1 d 0 1\nm1 d d 0 0 n_hv w=1u l=1u\n.model n_hv nmos (level=80)\n.op\n", without_shift,
              "m1: the kit has no hv_nch, and the netlist no other model of nmos"}})
        EXPECT_NE(message_of(netlist, kit).find(message), std::string::npos) << message_of(netlist, kit) << "\nexpected: " << message;
    auto swapped = bsim3_kit();
    swapped.map.models = {{"nch", KitDevice::pch}};
    EXPECT_NE(message_of(arrays, swapped).find("model nch is nmos, but the map 'bsim' has it as pch; write nch or hv_nch in [models]"),
              std::string::npos);
    auto cornered = bsim3_kit();
    cornered.corner = "ss";
    EXPECT_NE(message_of(arrays, cornered).find("corner=ss: the map 'bsim' has no corners"), std::string::npos);
}

TEST(KitExport, AModelOfTheNetlistIsTheDeviceThatTheMapNames) {
    auto kit = level1_kit();
    kit.map.models = {{"nch", KitDevice::hv_nch}};
    kit.map.devices[2] = "high_n";
    EXPECT_NE(deck_of(elaborate_netlist(Netlist::parse_text(arrays, "arrays.cir")), kit).find("m1 d g s b high_n w=2e-06 l=5e-07 m=4"),
              std::string::npos);
}

}  // namespace
}  // namespace corpuscle::circuit::test
