// .set lines of a netlist, and the embedded process card that a netlist in any folder can use.

#include <gtest/gtest.h>

#include <map>

#include "circuit/devices.hpp"
#include "circuit/variant/named_value.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "support/support.hpp"

namespace corpuscle::circuit {
namespace {

using corpuscle::test::TemporaryFolder;
using corpuscle::test::value_or_throw;

const std::string amplifier =
    "amplifier\n.param r=1k i_0=1u\n.lib 'process/tsmc180.lib' tt\n.subckt stage a\nm1 a a 0 0 nch w=1.5u l=0.5u m=2\nr1 a 0 {2*r}\n.ends\n"
    "xs a stage\ni1 0 a {i_0}\n.op\n.expect v(a) 0.1 10\n";

Result<Circuit> circuit_of(const std::string& lines, const Values& parameters = {}) {
    const auto netlist = Netlist::parse_text(amplifier + lines + ".end\n", "a.cir");
    return netlist ? netlist->elaborate(parameters) : netlist.error();
}
const Element& element(const Circuit& c, const std::string& name) { return c.elements[static_cast<std::size_t>(c.find_element(name))]; }
std::string error_of(const std::string& lines) {
    const auto circuit = circuit_of(lines);
    return circuit ? "" : circuit.error().text();
}

TEST(SetLines, ReplaceParametersDevicesAndTheirParameters) {
    const auto c = value_or_throw(circuit_of(".set r=3k xs.m1.m=5 i1=2u\n.set XS.M1.W=2u\n"));
    EXPECT_EQ(element(c, "xs.r1").value, 6e3);
    EXPECT_EQ(element(c, "xs.m1").values.at("m"), 5);
    EXPECT_EQ(element(c, "xs.m1").values.at("w"), 2e-6);
    EXPECT_EQ(element(c, "i1").waveform.dc, 2e-6);
    EXPECT_TRUE(c.has_directive("expect"));  // the netlist is as it was written
}

TEST(SetLines, OverridesAndStepsReplaceThem) {
    const TemporaryFolder folder;
    folder.write("a.cir", amplifier + ".set r=3k xs.m1.m=5\n.end\n");
    const std::string path = folder / "a.cir";
    const std::vector overrides = {value_or_throw(parse_netlist_override(path, "r=4k")),
                                   value_or_throw(parse_netlist_override(path, "s.m1.m=7"))};
    const auto c = value_or_throw(value_or_throw(apply_overrides(path, overrides)).result.elaborate());
    EXPECT_EQ(element(c, "xs.r1").value, 8e3);
    EXPECT_EQ(element(c, "xs.m1").values.at("m"), 7);
    EXPECT_FALSE(c.has_directive("expect"));
    EXPECT_EQ(element(value_or_throw(circuit_of(".set r=3k\n", {{"r", 5e3}})), "xs.r1").value, 10e3);
}

TEST(SetLines, ErrorsNameTheLineAndWhatThereIs) {
    const std::map<std::string, std::string> expected = {
        {".set\n", "a.cir:12:5: .set: expected NAME=NUMBER"},
        {".set r\n", "a.cir:12:6: .set: expected NAME=NUMBER"},
        {".set r={x}\n", "a.cir:12:"},
        {".set rr=1k\n", "a.cir:12:6: .set: there is no .param or device 'rr' (a device needs its full path); did you mean 'r'?"},
        {".set s.m1.m=2\n", "a.cir:12:6: .set: there is no .param or device 's.m1.m'"},
        {".set xs.m1=2\n", "a.cir:12:6: .set: xs.m1 has no single value; set one of"},
        {".set xs.m1.q=2\n", "a.cir:12:6: .set: xs.m1 has no 'q'"},
        {".set xs.m1.m=0\n", "a.cir:12:14: .set: 0 is not allowed for xs.m1.m"},
        {".set xs.r1=0\n", "a.cir:12:12: .set:"},
        {".set r=1e999\n", "a.cir:12:8: .set: '1e999' is not a number"},
        {".set r=1 r=2\n", "a.cir:12:"},
    };
    for (const auto& [line, message] : expected) EXPECT_EQ(error_of(line).substr(0, message.size()), message) << line;
}

TEST(SetLines, NamedValuesAreThoseOfTheCircuit) {
    const auto c = value_or_throw(circuit_of(""));
    const auto r = find_named_value(c, "R");
    ASSERT_TRUE(r && r->is_parameter);
    EXPECT_EQ(r->value, 1e3);
    const auto m = find_named_value(c, "s.m1.m");
    ASSERT_TRUE(m && m->is_count);
    EXPECT_EQ(m->full_name, "xs.m1.m");
    EXPECT_EQ(m->value, 2);
    EXPECT_EQ(find_named_value(c, "i1")->unit, "A");
    EXPECT_FALSE(find_named_value(c, "nothing"));
    EXPECT_FALSE(find_named_value(c, "xs.m1"));
    EXPECT_EQ(unit_of_difference(c, value_or_throw(circuit_of("", {{"r", 2e3}}))), "ohm");
    EXPECT_EQ(unit_of_difference(c, value_or_throw(circuit_of("", {{"r", 2e3}, {"i_0", 2e-6}}))), "");
    EXPECT_EQ(unit_of_difference(c, c), "");
}

TEST(EmbeddedCard, IsUsedUnlessThereIsSuchAFile) {
    EXPECT_EQ(element(value_or_throw(circuit_of("")), "xs.m1").model, 0);
    const TemporaryFolder folder;
    folder.write("a.cir", amplifier + ".end\n");
    EXPECT_TRUE(Netlist::read(folder / "a.cir"));
    EXPECT_TRUE(Netlist::read(folder / "a.cir", "ss"));
    std::filesystem::create_directory(folder / "process");
    folder.write("process/tsmc180.lib", ".lib tt\n.endl\n");
    const auto read = value_or_throw(Netlist::read(folder / "a.cir")).elaborate();
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().text().find("nch"), std::string::npos) << read.error().text();
}

}  // namespace
}  // namespace corpuscle::circuit
