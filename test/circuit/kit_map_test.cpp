// Maps of kits: their keys, the errors of wrong ones, and the built-in ones.

#include <gtest/gtest.h>

#include "circuit/export/kit_card.hpp"
#include "support/support.hpp"

namespace corpuscle::circuit {
namespace {

using corpuscle::test::TemporaryFolder;
using corpuscle::test::value_or_throw;

std::string error_of(const std::string& text) {
    const auto map = parse_kit_map(text, "kit.toml");
    return map ? "no error" : map.error().text();
}

TEST(KitMap, AnEmptyMapIsThatOfPlainModels) {
    const auto map = value_or_throw(parse_kit_map("", "kit.toml"));
    EXPECT_FALSE(map.is_subcircuit);
    EXPECT_EQ(map.length_unit, 1);
    EXPECT_EQ(map.multipliers, std::vector<std::string>{"m"});
    EXPECT_TRUE(map.has_areas && map.has_temperature && map.threshold.empty());
    EXPECT_EQ(map.lines, std::vector<std::string>{".include '{card}'"});
}

TEST(KitMap, EveryKeyIsRead) {
    const auto map = value_or_throw(
        parse_kit_map("instance = \"X\"\nlength_unit = \"um\"\nmultiplier = [\"mult\", \"m\"]\nareas = false\ntemperature = "
                      "true\nthreshold = \"delvto\"\n"
                      "pmos_threshold = \"positive\"\nhv_shift = \"120 mV\"\nmobility = \"mulu0\"\nlines = [\".lib '{card}' {corner}\", "
                      "\"* from {folder}\"]\n"
                      "mismatch_lines = [\".param mm=1\", \".include '{card}'\"]\nlast_lines = [\".options scale=1u\"]\n[devices]\nnch = "
                      "\"n\"\nhv_pch = \"p.2\"\n"
                      "[models]\nMine = \"hv_nch\"\n[corners]\nSS = \"slow\"\n",
                      "kit.toml"));
    EXPECT_TRUE(map.is_subcircuit && map.has_temperature && !map.has_areas && !map.pmos_threshold_is_negative);
    EXPECT_DOUBLE_EQ(map.length_unit, 1e-6);
    EXPECT_DOUBLE_EQ(map.hv_shift.value_or(0), 0.12);
    EXPECT_EQ(map.multipliers.size(), 2U);
    EXPECT_EQ(map.device(KitDevice::nch) + map.device(KitDevice::pch) + map.device(KitDevice::hv_pch), "np.2");
    EXPECT_EQ(map.models.at("mine"), KitDevice::hv_nch);
    EXPECT_EQ(map.corners.at("ss"), "slow");
    EXPECT_EQ(value_or_throw(fill_kit_line(map.lines[0], {"a b.lib", "f", "slow"})), ".lib 'a b.lib' slow");
    EXPECT_EQ(value_or_throw(fill_kit_line(map.lines[1], {"a b.lib", "f", "slow"})), "* from f");
}

TEST(KitMap, AnErrorNamesItsPlaceAndARemedy) {
    for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
             {"instance = \"Q\"", "kit.toml:1:12: instance = 'Q'; write X or M"},
             {"x = 1", "kit.toml:1:1: there is no 'x'"},
             {"\nlenght_unit = \"um\"", "kit.toml:2:1: there is no 'lenght_unit'; did you mean 'length_unit'?"},
             {"length_unit = \"V\"", "length_unit = 'V' is not a unit of length; write m, um or nm"},
             {"length_unit = \"-2 um\"", "length_unit = '-2 um' is not a unit of length"},
             {"length_unit = 3", "length_unit = '3' is not a unit of length"},
             {"multiplier = \"m\"", "multiplier must be a list: multiplier = [...]"},
             {"multiplier = [\"m = 1\"]", "multiplier: 'm = 1' is not a name of ngspice; use letters, digits and _ . $ : -"},
             {"areas = 1", "areas must be true or false"},
             {"threshold = \"\"", "threshold: '' is not a name of ngspice"},
             {"hv_shift = \"0.1 A\"", "kit.toml:1:12: hv_shift: "},
             {"pmos_threshold = \"up\"", "pmos_threshold = 'up'; write negative or positive"},
             {"lines = [\".control\"]", "lines: '.control' is not one of .lib, .include"},
             {"lines = [\".include a\\n.control\"]", "has a line break or a control character; write a list of lines"},
             {"lines = [\".param x=\\u0001\"]", "has a line break or a control character"},
             {"lines = []", "kit.toml:1:9: lines: no line reads the kit's file; add .include '{card}'"},
             {"lines = [\"* {card}\"]", "lines: no line reads the kit's file"},
             {"mismatch_lines = [\".param mm=1\"]", "mismatch_lines: no line reads the kit's file"},
             {"length_unit = \"km\"", "length_unit = 'km' is not a unit of length"},
             {"multiplier = [1]", "kit.toml:1:15: multiplier = '1' is not the name of a parameter; write one such as m"},
             {"threshold = \"W\"", "threshold = 'W': the export writes W itself; name another parameter"},
             {"hv_shift = \"1 kV\"", "kit.toml:1:12: hv_shift = '1 kV' is outside [0, 5] V"},
             {"hv_shift = \"-0.1 V\"", "is outside [0, 5] V"},
             {"lines = [\".include '{path}'\"]", "lines: '{path}' is not {card}, {folder} or {corner}"},
             {"lines = [\".include '{card'\"]", "lines: '{card'' is not {card}, {folder} or {corner}"},
             {"last_lines = [\".end\"]", "last_lines: '.end' is not one of"},
             {"lines = [\"\"]", "lines: '' is not one of"},
             {"[devices]\nnch = \"a b\"", "kit.toml:2:7: nch: 'a b' is not a name of ngspice"},
             {"[devices]\nnch = \"a\\nb\"", "is not a name of ngspice"},
             {"[devices]\nnmos = \"a\"", "there is no 'nmos'"},
             {"[models]\na = \"hv\"", "there is no 'hv'"},
             {"[corners]\nss = \"s s\"", "ss: 's s' is not a name of ngspice"},
             {"devices = 1", "devices must be a table"},
             {"lines = [+\u00fc\ufeb5", "kit.toml:1:"},
             {"lines = [", "kit.toml:1:"}})
        EXPECT_NE(error_of(text).find(message), std::string::npos) << error_of(text) << "\nexpected: " << message;
}

TEST(KitMap, TheBuiltInMapsAreRead) {
    const auto names = kit_map_names();
    ASSERT_EQ(names.size(), 4U);
    for (const auto& name : names) EXPECT_TRUE(read_kit_map(name)) << name;
    EXPECT_EQ(value_or_throw(read_kit_map("sky130")).device(KitDevice::nch), "sky130_fd_pr__nfet_01v8");
    EXPECT_EQ(value_or_throw(read_kit_map("gf180")).corners.at("tt"), "typical");
}

TEST(KitMap, ADeviceThatTheCardLacksIsAnError) {
    auto map = value_or_throw(read_kit_map("bsim"));
    map.devices = {"made_n", "", "", ""};
    EXPECT_TRUE(check_devices_in_card(map, "* a\n.MODEL Made_N nmos(level=8)\n", "a.lib"));
    EXPECT_TRUE(check_devices_in_card(map, ".model made_n.1 nmos(level=8 lmin=1u)\n", "a.lib")) << "a binned model";
    EXPECT_TRUE(check_devices_in_card(map, ".include 'others.lib'\n", "a.lib"));
    EXPECT_TRUE(check_devices_in_card(map, ".lib tt\n.lib 'others.lib' tt\n.endl\n", "a.lib"));
    const auto missing = check_devices_in_card(map, ".model other nmos(level=8)\n.subckt made_n d g s b\n.ends\n", "a.lib");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().message, "--card a.lib: it has no .model made_n; it has other");
    const auto none = check_devices_in_card(map, std::string("\0\xff\n", 3), "a.lib");
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message,
              "--card a.lib: it has no .model made_n; it has none at all, so name the file of the kit that defines it");
    const auto other_polarity = check_devices_in_card(map, "* a\n.model MADE_N PMOS(level=8)\n", "a.lib");
    ASSERT_FALSE(other_polarity);
    EXPECT_EQ(other_polarity.error().text(), "a.lib:2: .model made_n is pmos, but the device for nch must be nmos; name another");
    EXPECT_TRUE(check_devices_in_card(map, ".model made_n\n+ pmos(level=8)\n", "a.lib")) << "the type is on the next line";
}

TEST(KitMap, IncludesThatLeadBackToAFileAreAnError) {
    const TemporaryFolder folder;
    const auto map = value_or_throw(read_kit_map("plain"));
    const auto error_of_card = [&](const std::string& text, const std::string& other) {
        folder.write("other.lib", other);
        const auto checked = check_card(map, folder.write("card.lib", text));
        return checked ? "no error" : checked.error().text();
    };
    EXPECT_EQ(error_of_card("* a kit\n.include 'other.lib'\n", "* nothing"), "no error");
    EXPECT_EQ(error_of_card(".inc other.lib\n.include \"other.lib\"\n.include missing.lib\n", ""), "no error") << "twice is not a loop";
    EXPECT_EQ(error_of_card(".lib a\n.lib 'card.lib' b\n.endl a\n.lib b\n.endl b\n", ""), "no error") << "sections of one file";
    EXPECT_NE(error_of_card(".include card.lib\n", "").find("/card.lib:1: this line includes "), std::string::npos);
    const auto loop = error_of_card(".include 'other.lib'\n", "\n.include './card.lib'\n");
    EXPECT_NE(loop.find("/other.lib:2: this line includes "), std::string::npos) << loop;
    EXPECT_NE(loop.find("Remove one of the lines"), std::string::npos) << loop;
}

}  // namespace
}  // namespace corpuscle::circuit
