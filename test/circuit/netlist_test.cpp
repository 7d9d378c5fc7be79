#include "circuit/netlist/netlist.hpp"

#include <fmt/format.h>

#include "support/processor_time.hpp"
#include "support/property.hpp"

namespace corpuscle::circuit {
namespace {

using Files = std::map<std::string, std::string>;

Netlist::FileOpener file_opener(const Files& files) {
    return [&files](const std::string& path) -> Result<std::string> {
        const auto at = files.find(path);
        if (at == files.end()) return bad_input("no such file");
        return at->second;
    };
}

Result<Circuit> read(const std::string& body, const Files& files = {}, const Values& parameters = {}) {
    const auto netlist = Netlist::parse("title\n" + body, "dir/t.cir", file_opener(files));
    if (!netlist) return netlist.error();
    return netlist->elaborate(parameters);
}

Circuit circuit(const std::string& body, const Files& files = {}, const Values& parameters = {}) {
    auto c = read(body, files, parameters);
    EXPECT_TRUE(c) << body << "\n" << (c ? "" : c.error().text());
    return c ? std::move(*c) : Circuit{};
}

std::string error_of(const std::string& body, const Files& files = {}) {
    const auto c = read(body, files);
    return c ? "accepted" : c.error().text();
}

const Element& element_in(const Circuit& c, std::string_view name) {
    static const Element none;
    const int k = c.find_element(name);
    EXPECT_GE(k, 0) << name;
    return k < 0 ? none : c.elements[static_cast<std::size_t>(k)];
}

std::string nodes(const Circuit& c, const Element& e) {
    std::string out;
    for (const int k : e.nodes) out += (out.empty() ? "" : " ") + c.nodes[static_cast<std::size_t>(k)];
    return out;
}

// ---- lines ----

TEST(NetlistLines, JoinContinuationsOverCommentsAndBlankLines) {
    const auto c = circuit("V1 a 0 PULSE(0 1\n* between\n\n+ 1n 2n ; first\n  + 3n $ second\n+4n // third\n+5n)\nR1 a 0 1k;x\n");
    EXPECT_EQ(element_in(c, "v1").waveform.numbers, (std::vector<double>{0, 1, 1e-9, 2e-9, 3e-9, 4e-9, 5e-9}));
    EXPECT_EQ(c.elements.size(), 2U);
}

TEST(NetlistLines, KeepTheTitleAndStopAtDotEnd) {
    const auto netlist = Netlist::parse("\xef\xbb\xbfMy Circuit\r\nR1 A 0 1K\r\n.END\r\nthis is not read\r\n", "t.cir", {});
    ASSERT_TRUE(netlist) << netlist.error().text();
    const auto c = netlist->elaborate();
    ASSERT_TRUE(c);
    EXPECT_EQ(c->title, "My Circuit");
    EXPECT_EQ(c->elements.size(), 1U);
    EXPECT_EQ(c->nodes, (std::vector<std::string>{"0", "a"}));
    EXPECT_TRUE(c->warnings.empty());
}

TEST(NetlistLines, MayHaveNonAsciiCharactersOnlyInCommentsAndTitles) {
    const auto netlist = Netlist::parse("caf\xe9\n* 10 k\xb5\nR1 a 0 1k ; \xb5\xff\n", "t.cir", {});
    ASSERT_TRUE(netlist) << netlist.error().text();
    EXPECT_EQ(netlist->elaborate()->title, "caf\xc3\xa9");
    for (const std::string micro : {"\xb5", "\xc2\xb5", "\xce\xbc"}) {
        EXPECT_EQ(element_in(circuit("C1 a 0 1" + micro + "F"), "c1").value, 1e-6);
        EXPECT_EQ(error_of("C1 a 0 1" + micro + " x=3").substr(0, 31),
                  fmt::format("dir/t.cir:2:{}: c1: unknown para", 10 + micro.size()).substr(0, 31));
    }
    EXPECT_EQ(error_of("R\xe9 a 0 1"),
              "dir/t.cir:2:2: byte 0xE9, '\xc3\xa9': a netlist must be plain ASCII outside comments; write e instead");
    EXPECT_EQ(error_of("R1 v_m\xc3\xa4m 0 1"),
              "dir/t.cir:2:7: byte 0xC3, '\xc3\xa4': a netlist must be plain ASCII outside comments; write a instead");
    EXPECT_EQ(error_of("R1 \xce\xb2 0 1"),
              "dir/t.cir:2:4: byte 0xCE, '\xce\xb2': a netlist must be plain ASCII outside comments; write a name without it");
    EXPECT_EQ(error_of("R1 a\x07 0 1"), "dir/t.cir:2:5: byte 0x07: a control character; remove it");
    EXPECT_EQ(error_of(std::string("R1 a 0\0 1", 9)), "dir/t.cir:2:7: byte 0x00: a netlist is text; is this UTF-16? Save it as UTF-8");
    const auto utf16 = Netlist::parse(std::string("\xff\xfet\0i\0", 6), "t.cir", {});
    ASSERT_FALSE(utf16);
    EXPECT_EQ(utf16.error().text(), "t.cir:1:4: byte 0x00: a netlist is text; is this UTF-16? Save it as UTF-8");
}

// LTspice writes it between the letter of an element and its name.
TEST(NetlistLines, MayHaveASectionSignInNames) {
    for (const std::string section : {"\xa7", "\xc2\xa7"}) {
        const auto c = circuit("V" + section + "Req a 0 5\nB1 b 0 V=I(V" + section + "Req)\nR1 b 0 1\nR2 a 0 1");
        EXPECT_EQ(element_in(c, "v_req").waveform.dc, 5);
    }
}

TEST(NetlistLines, MayEndAsOnOldMacintoshes) {
    const auto netlist = Netlist::parse("title\rR1 a 0 1k\r* comment\rR2 a 0\r+ 2k\r.end\r", "t.cir", {});
    ASSERT_TRUE(netlist) << netlist.error().text();
    EXPECT_EQ(netlist->elaborate()->title, "title");
    EXPECT_EQ(netlist->elaborate()->elements.size(), 2U);
    const auto mixed = Netlist::parse("title\nR1 a 0 1k\rR2 a 0 2k\n", "t.cir", {});
    ASSERT_FALSE(mixed);
    EXPECT_EQ(mixed.error().text(),
              "t.cir:2:10: byte 0x0D: some lines end with a carriage return alone and others do not; end all with a line feed");
}

TEST(Netlist, ThousandsOfUnknownSubcircuitsAreReportedFast) {
    std::string text;
    for (int k = 0; k < 5000; ++k)
        text += fmt::format(".subckt cell_of_library_{0} a b\nr1 a b 1\n.ends\nx{0} a 0 cell_of_lbrary_{0}\n", k);
    std::string error;
    EXPECT_LT(test::processor_time([&] { error = error_of(text + "r1 a 0 1"); }), 3);
    EXPECT_EQ(error, "dir/t.cir:5:8: x0: unknown subcircuit 'cell_of_lbrary_0'; did you mean 'cell_of_library_0'?");
}

TEST(NetlistLines, AreReadInTimeProportionalToTheirLength) {
    const auto seconds = [](std::size_t points) {
        std::string line = "V1 a 0 PWL(";
        for (std::size_t k = 0; k < points; ++k) line += fmt::format("{} {} ", k, k % 7);
        return test::processor_time([&] { EXPECT_EQ(circuit(line + ")").elements.size(), 1U); });
    };
    const double short_line = seconds(100000), long_line = seconds(1000000);
    EXPECT_LT(long_line, 40 * short_line + 0.5);
}

TEST(NetlistLines, HaveTheRightLocationAcrossContinuations) {
    EXPECT_EQ(error_of("R1 a 0\n* c\n+   {2*\n+ xyz}"), "dir/t.cir:5:3: unknown name 'xyz'");
    for (const std::string comment : {"; size", "  $ size", "// size", ""})
        EXPECT_EQ(error_of("R1 a 0\n" + comment + "\n+   xyz"), "dir/t.cir:4:5: r1: unknown model 'xyz'") << comment;
    EXPECT_EQ(error_of("+ R1 a 0 1"), "dir/t.cir:2:1: '+' continues the previous line, but there is none");
    EXPECT_EQ(error_of(".param a='2*3"), "dir/t.cir:2:10: this ' is not closed");
    EXPECT_EQ(error_of(".param a={2*3"), "dir/t.cir:2:10: this '{' is not closed");
    EXPECT_EQ(error_of("V1 a 0 PULSE(0 1"), "dir/t.cir:2:13: this '(' is not closed");
    EXPECT_EQ(error_of("V1 a 0 PULSE 0 1)"), "dir/t.cir:2:17: unmatched ')'");
}

// ---- elements ----

TEST(NetlistElements, RCLTakeTheirValuesInEveryNotation) {
    const auto c = circuit(
        ".param rv=3k\nR1 a 0 1k\nR2 a 0 {rv*2}\nR3 a 0 'rv'\nR4 a 0 r=2k tc1=1m tc2=2u m=2\nR5 a 0 rv\nR6 a 0 rm 5k\nR7 a 0 rm 1k "
        "scale=2\n"
        "R8 a 0 2*rv\nC1 a 0 10pF ic=0.5\nC2 a 0 c={1p*2}\nL1 a 0 1m\nL2 a 0 l=2u\n.model rm r rsh=100\nC3 a 0 q='v(a)*1p'\n");
    EXPECT_EQ(element_in(c, "r1").value, 1e3);
    EXPECT_EQ(element_in(c, "r2").value, 6e3);
    EXPECT_EQ(element_in(c, "r3").value, 3e3);
    EXPECT_EQ(element_in(c, "r4").value, 2e3);
    EXPECT_EQ(element_in(c, "r4").values, (Values{{"m", 2}, {"tc1", 1e-3}, {"tc2", 2e-6}}));
    EXPECT_EQ(element_in(c, "r5").value, 3e3);
    EXPECT_EQ(element_in(c, "r6").value, 5e3);
    EXPECT_EQ(element_in(c, "r6").model, 0);
    EXPECT_EQ(element_in(c, "r7").model, 0);
    EXPECT_EQ(element_in(c, "r7").values.at("scale"), 2);
    EXPECT_EQ(element_in(c, "r8").value, 6e3);
    EXPECT_EQ(element_in(c, "c1").value, 10e-12);
    EXPECT_EQ(element_in(c, "c1").values.at("ic"), 0.5);
    EXPECT_EQ(element_in(c, "c2").value, 2e-12);
    EXPECT_EQ(element_in(c, "l1").value, 1e-3);
    EXPECT_EQ(element_in(c, "l2").value, 2e-6);
    ASSERT_TRUE(element_in(c, "c3").expression);
    EXPECT_EQ(element_in(c, "c3").expression->inputs()[0].name, "a");
    EXPECT_EQ(c.models[0].type, "r");
}

TEST(NetlistElements, RAndCTakeTheirValuesFromTheSizesAndTheSheetOfTheirModel) {
    const auto c = circuit(
        "R1 a 0 rm l=20u w=2u\nR2 a 0 rm l=20u\nR3 a 0 rv\nC1 a 0 cm l=10u w=4u\nC2 a 0 cv\nL1 a 0 lm\nR 1 0 2k\nR0 a 1 0\n"
        ".model rm r rsh=100 defw=4u narrow=1u short=2u\n.model rv r r=5k\n.model cm c cj=1m cjsw=1n\n.model cv c cap=2p\n.model lm l "
        "ind=3u\n");
    EXPECT_DOUBLE_EQ(element_in(c, "r1").value, 100 * 18 / 1.0);
    EXPECT_DOUBLE_EQ(element_in(c, "r2").value, 100 * 18 / 3.0);
    EXPECT_EQ(element_in(c, "r3").value, 5e3);
    EXPECT_DOUBLE_EQ(element_in(c, "c1").value, 1e-3 * 40e-12 + 2e-9 * 14e-6);
    EXPECT_EQ(element_in(c, "c2").value, 2e-12);
    EXPECT_EQ(element_in(c, "l1").value, 3e-6);
    EXPECT_EQ(element_in(c, "r").value, 2e3);
    EXPECT_EQ(element_in(c, "r0").value, 1e-3);
    ASSERT_EQ(c.warnings.size(), 1U);
    EXPECT_EQ(c.warnings[0].text(), "dir/t.cir:9:8: r0: 0 ohm is taken as 0.001 ohm; a 0 V source connects two nodes exactly");
}

TEST(NetlistElements, SourcesHaveTheirWaveforms) {
    using Shape = Waveform::Shape;
    const auto c = circuit(
        ".param vdd=1.8\nV1 a 0 5\nV2 b 0 DC {vdd} AC 1 90\nV3 c 0 PULSE(0, {vdd}, 1n 1n 1n 5n 10n)\nI1 d 0 SIN 0 1 1k\nV5 e 0 EXP(0 1 1n "
        "2n)\n"
        "V6 f 0 pwl ( 0 0 1m 1 2m 0 ) td=1m\nV7 in 0 FORCE\nV8 g 0 FORCE 2\nV9 h 0 AC\nV10 i 0 1 AC 2 PULSE(0 1)\nV11 j 0 dc=2 ac=3\n");
    EXPECT_EQ(element_in(c, "v1").waveform.dc, 5);
    EXPECT_TRUE(element_in(c, "v1").waveform.has_dc);
    EXPECT_EQ(element_in(c, "v2").waveform.dc, 1.8);
    EXPECT_EQ(element_in(c, "v2").waveform.ac_magnitude, 1);
    EXPECT_EQ(element_in(c, "v2").waveform.ac_phase, 90);
    EXPECT_EQ(element_in(c, "v3").waveform.shape, Shape::pulse);
    EXPECT_EQ(element_in(c, "v3").waveform.numbers, (std::vector<double>{0, 1.8, 1e-9, 1e-9, 1e-9, 5e-9, 10e-9}));
    EXPECT_FALSE(element_in(c, "v3").waveform.has_dc);
    EXPECT_EQ(element_in(c, "i1").waveform.shape, Shape::sine);
    EXPECT_EQ(element_in(c, "v5").waveform.shape, Shape::exponential);
    EXPECT_EQ(element_in(c, "v6").waveform.numbers, (std::vector<double>{1e-3, 0, 2e-3, 1, 3e-3, 0}));
    EXPECT_EQ(element_in(c, "v7").waveform.shape, Shape::force);
    EXPECT_EQ(element_in(c, "v7").waveform.numbers, std::vector<double>{1});
    EXPECT_EQ(element_in(c, "v8").waveform.numbers, std::vector<double>{2});
    EXPECT_EQ(element_in(c, "v9").waveform.ac_magnitude, 1);
    EXPECT_EQ(element_in(c, "v10").waveform.ac_magnitude, 2);
    EXPECT_EQ(element_in(c, "v10").waveform.dc, 1);
    EXPECT_EQ(element_in(c, "v10").waveform.shape, Shape::pulse);
    EXPECT_EQ(element_in(c, "v11").waveform.ac_magnitude, 3);
}

TEST(NetlistElements, ControlledSourcesHaveTheirControllingQuantities) {
    const auto c = circuit(
        "V1 a 0 1\nE1 b 0 a 0 10\nE2 c 0 value={v(a)*2}\nE3 d 0 vol='v(a,b)'\nG1 e 0 (a, b) 1m\nG2 f 0 cur='v(a)' m=2\nF1 g 0 V1 2\nH1 h 0 "
        "V1 {2*3}\n"
        "B1 i 0 v = v(a) * 2 + i(v1) == 3 dtemp=0.1\nB2 j 0 i={v(a)}*2\n");
    EXPECT_EQ(nodes(c, element_in(c, "e1")), "b 0 a 0");
    EXPECT_EQ(element_in(c, "e1").value, 10);
    EXPECT_TRUE(element_in(c, "e2").expression_is_voltage);
    EXPECT_EQ(element_in(c, "e3").expression->inputs()[0].minus, "b");
    EXPECT_EQ(nodes(c, element_in(c, "g1")), "e 0 a b");
    EXPECT_FALSE(element_in(c, "g2").expression_is_voltage);
    EXPECT_EQ(element_in(c, "g2").values.at("m"), 2);
    EXPECT_EQ(element_in(c, "f1").control_source, "v1");
    EXPECT_EQ(element_in(c, "h1").value, 6);
    EXPECT_EQ(element_in(c, "b1").expression->inputs().size(), 2U);
    EXPECT_TRUE(element_in(c, "b1").expression_is_voltage);
    EXPECT_EQ(element_in(c, "b1").values.at("dtemp"), 0.1);
    const double x[] = {3};
    EXPECT_EQ(element_in(c, "b2").expression->value(x), 6);
}

TEST(NetlistElements, DiodesAndTransistorsHaveModelsAndGeometry) {
    const auto c = circuit(
        "D1 a 0 dm 2 m=3 off\nD2 a 0 dm area=4\nM1 d g s 0 nm w=2*wn l=1u stack=3 delvto=0.01 mulu0=1.1\n.param wn=2u\n"
        ".model dm d(is=1e-14, n = 1)\n.model nm nmos level=80 vto={wn} version=3.3.0\n.model unused npn bf={nothing}\n");
    EXPECT_EQ(element_in(c, "d1").values, (Values{{"area", 2}, {"m", 3}, {"off", 1}}));
    EXPECT_EQ(element_in(c, "d2").values, (Values{{"area", 4}}));
    EXPECT_EQ(nodes(c, element_in(c, "m1")), "d g s 0");
    EXPECT_EQ(element_in(c, "m1").values, (Values{{"delvto", 0.01}, {"l", 1e-6}, {"mulu0", 1.1}, {"stack", 3}, {"w", 4e-6}}));
    ASSERT_EQ(c.models.size(), 2U) << "a model without elements is not evaluated";
    EXPECT_EQ(c.models[1].values, (Values{{"level", 80}, {"vto", 2e-6}}));
    EXPECT_EQ(c.models[1].texts.at("version"), "3.3.0");
    EXPECT_EQ(c.models[0].values.at("n"), 1);
}

TEST(NetlistElements, AreRejectedWithLocationAndSuggestion) {
    const struct {
        const char *body, *message;
    } cases[] = {
        {"R1 a 0", "2:7: r1: its value is missing"},
        {"C1 a 0 cm\n.model cm c", "2:10: c1: its value is missing; its model does not give one either"},
        {"R1 a 0 rm 1k r=3\n.model rm r", "2:14: r1: its value is given twice"},
        {"R1 a", "2:5: r1: 1 node, but expected 2: plus, minus, then a value or a model"},
        {"R1 a 0 1k 2k", "2:11: r1: unexpected '2k'"},
        {"R1 a 0 1k5", "2:8: '1k5' is not a number; write 1.5k"},
        {"R1 a 0 1 k", "2:10: r1: unknown model 'k'; write a unit directly after its number, without a blank"},
        {"R1 a 0 rmodl\n.model rmod r\nR2 a 0 rmod", "2:8: r1: unknown model 'rmodl'; did you mean 'rmod'?"},
        {"R1 a 0 {1/0}", "2:9: '1/0' is inf, not a finite number"},
        {"R1 a 0 1k tcc1=2", "2:11: r1: unknown parameter 'tcc1'; did you mean 'tc1'?"},
        {"R1 a 0 1k m=0", "2:13: r1: m = 0 must be positive"},
        {"R1 a 0 1k m=2 m=3", "2:15: r1: m is given twice"},
        {"R1 a 0 1k r=3", "2:11: r1: its value is given twice"},
        {"R1 a 0 1k tc1=", "2:14: '=' without a value after it"},
        {"R1 = 1k", "2:4: unexpected '=' after 'r1'; to define a parameter: .param name=value"},
        {"R1 a 0 1k\nR2 a 0 1\nr1 b 0 2k", "4:1: element 'r1' is already defined at dir/t.cir:2"},
        {"Z1 c b e zm", "2:1: 'z1': unknown element letter z (MESFET); known are R C L K V I E F G H B S W D Q M X"},
        {"V1 a 0 PULS(0 1)", "2:8: v1: unknown word 'puls'; did you mean 'pulse'?"},
        {"V1 a 0 PULSE(0)", "2:8: v1: pulse has 1 number; expected pulse(v1 v2 td tr tf pw per np)"},
        {"V1 a 0 PWL(0 0 1m)", "2:16: v1: pwl has 3 numbers; expected pairs of a time and a value"},
        {"V1 a 0 PWL(0 0 1m 1 1m 2)", "2:21: v1: pwl: time 0.001 must be later than 0.001"},
        {"V1 a 0 SIN(0 1) PULSE(0 1)", "2:17: v1: only one time waveform is allowed, not also 'pulse'"},
        {"V1 a 0 TRNOISE(1 1n 1 0.1)",
         "2:21: v1: trnoise: only white noise is supported, trnoise(na nt 0 0); 1/f noise comes from devices with kf, by .options "
         "noisefmax"},
        {"V1 a 0 TRNOISE(1 0)", "2:18: v1: trnoise: the interval of the noise must be above 0 s"},
        {"V1 a 0 PWL(0 0 1m 1) r=2m", "2:24: v1: pwl: r = 0.002 s is not the time of a point before the last"},
        {"V1 a 0 PULSE(0 vd)", "2:16: unknown name 'vd'"},
        {"E1 a 0 POLY(1) b 0 1", "2:8: e1: unknown node 'b'"},
        {"E1 a 0 POLY(1.5) a 0 1", "2:13: e1: poly: expected the number of inputs in parentheses, such as poly(2)"},
        {"E1 a 0 POLY(2) a 0 1 2", "2:23: e1: poly(2): expected 2 pairs of nodes, then the coefficients"},
        {"H1 a 0 POLY(1) V1", "2:18: h1: poly(1): expected 1 voltage sources, then the coefficients"},
        {"E1 a 0 b 0", "2:11: e1: its gain is missing"},
        {"G1 a 0 b", "2:9: g1: 3 nodes, but expected 4: plus, minus, the two controlling nodes, then the gain"},
        {"F1 a 0 V1 2\nR1 a 0 1\nVx a 0 1", "2:8: f1: unknown element 'v1'; did you mean 'vx'?"},
        {"F1 a 0 R1 2\nR1 a 0 1", "2:8: f1: 'r1' is not a voltage source; put a 0 V source in series to measure its current"},
        {"B1 a 0 v=v(out1)\nR1 out 0 1", "2:10: b1: unknown node 'out1'; did you mean 'out'?"},
        {"B1 a 0 v=2*i(r1)\nR1 a 0 1", "2:10: b1: 'r1' is not a voltage source; put a 0 V source in series to measure its current"},
        {"B1 a 0 v=1 i=2", "2:12: b1: has both v=... and i=..."},
        {"B1 a 0", "2:7: b1: expected v=... or i=..."},
        {"B1 a 0 v=sinn(v(a))", "2:10: unknown function 'sinn'; did you mean 'sin'?"},
        {"D1 a 0", "2:7: d1: its model is missing"},
        {"M1 d g s nm\n.model nm nmos", "2:10: m1: 3 nodes, but expected 4: drain, gate, source, bulk, then the model"},
        {"M1 d g s b x nm\n.model nm nmos", "2:12: m1: 5 nodes, but expected 4: drain, gate, source, bulk, then the model"},
        {"M1 d g s b nn\n.model nm nmos", "2:12: m1: unknown model 'nn'; did you mean 'nm'?"},
        {"M1 d g s b dm\n.model dm d", "2:12: m1: model 'dm' has type d; expected nmos or pmos"},
        {"M1 d g s b nm ww=2u\n.model nm nmos", "2:15: m1: unknown parameter 'ww'; did you mean 'w'?"},
        {"M1 d g s b nm w=2x3\n.model nm nmos", "2:17: '2x3' is not a number"},
        {"M1 d g s b nm\n.model nm nmos vto=abc", "3:20: unknown name 'abc'"},
        {".model nm\n", "2:10: .model: expected a name and a type, such as .model nm nmos (vto=0.5)"},
        {".model nm nmos 5\nM1 a a 0 0 nm", "2:16: expected name=value, not '5'"},
        {".model nm nmos\n.model nm pmos", "3:8: model 'nm' is already defined at dir/t.cir:2"},
    };
    for (const auto& c : cases) EXPECT_EQ(error_of(c.body), std::string("dir/t.cir:") + c.message) << c.body;
}

// ---- subcircuits ----

TEST(NetlistSubcircuits, AreFlattenedWithTheirPaths) {
    const auto c = circuit(
        ".subckt inv in out vdd params: w=1u m2={w*2}\nM1 out in 0 0 nm w={w}\nM2 out in vdd vdd pm w={m2} m=2\nR1 n3 gnd 1k\nB1 n3 0 "
        "i=v(in,n3)\n.model nm nmos "
        "vto={w}\n.ends inv\n.model pm pmos\n.global vss\n.subckt two a b\nX1 a m vd inv w=3u\nX2 m b vd inv m=2\nR1 vss vd 1\n.ends\n"
        "Xt in out two\nXu in (q), two params: m=3\n");
    EXPECT_EQ(c.elements.size(), 18U);
    const auto& m1 = element_in(c, "xt.x1.m1");
    EXPECT_EQ(nodes(c, m1), "xt.m in 0 0");
    EXPECT_EQ(m1.values, (Values{{"w", 3e-6}}));
    EXPECT_EQ(c.models[static_cast<std::size_t>(m1.model)].name, "xt.x1.nm");
    EXPECT_EQ(c.models[static_cast<std::size_t>(m1.model)].values.at("vto"), 3e-6);
    const auto& m2 = element_in(c, "xu.x2.m2");
    EXPECT_EQ(m2.values, (Values{{"m", 12}, {"w", 2e-6}})) << "2 of the element, times 2 and 3 of its two calls";
    EXPECT_EQ(c.models[static_cast<std::size_t>(m2.model)].name, "pm");
    EXPECT_EQ(nodes(c, element_in(c, "xt.r1")), "vss xt.vd");
    EXPECT_EQ(nodes(c, element_in(c, "xt.x2.r1")), "xt.x2.n3 0");
    const auto inputs = element_in(c, "xt.x2.b1").expression->inputs();
    EXPECT_EQ(inputs[0].name, "xt.m");
    EXPECT_EQ(inputs[0].minus, "xt.x2.n3");
    EXPECT_EQ(c.find_node("xt.x2.n3"), element_in(c, "xt.x2.r1").nodes[0]);
    EXPECT_EQ(c.find_node("gnd"), 0);
    EXPECT_EQ(c.find_node("nowhere"), -1);
    EXPECT_EQ(element_in(c, "xu.x2.r1").location.line, 5);
}

TEST(NetlistSubcircuits, SeeTheParametersOfTheirCallersAsInNgspice) {
    const auto c = circuit(
        ".param w=1 k=2\n.subckt inner a\nR1 a 0 {w*k}\n.ends\n.subckt outer a params: w=5\nX2 a inner\n.param k={w+1}\n.ends\nX1 a outer "
        "w=7\nX3 a inner\n");
    EXPECT_EQ(element_in(c, "x1.x2.r1").value, 7 * 8);
    EXPECT_EQ(element_in(c, "x3.r1").value, 2);
}

TEST(NetlistSubcircuits, NestAndHideTheirOwnDefinitions) {
    const auto c = circuit(
        ".subckt a x\n.subckt b x\nR1 x 0 rr 1\n.ends b\n.model rr r rsh={q}\n.param q=4\nX1 x b\n.ends a\n.subckt b x\nR2 x 0 "
        "2\n.ends\nX1 n a\nX2 n b\n");
    EXPECT_EQ(element_in(c, "x1.x1.r1").value, 1);
    EXPECT_EQ(c.models[0].name, "x1.rr");
    EXPECT_EQ(c.models[0].values.at("rsh"), 4);
    EXPECT_EQ(element_in(c, "x2.r2").value, 2);
}

TEST(NetlistSubcircuits, InParallelMultiplyOnlyCurrents) {
    const auto c = circuit(
        ".subckt s a\nV1 a b 0\nR1 b 0 1k\nF1 a 0 V1 2\nH1 h 0 V1 6\nE1 e 0 a 0 2\nG1 a 0 e h 1\nI1 a 0 1\nB1 q 0 v=v(a)\nB2 q 0 "
        "i=v(a)\n.ends\nX1 a s m=3\n");
    for (const auto* name : {"x1.r1", "x1.g1", "x1.i1", "x1.b2"}) EXPECT_EQ(element_in(c, name).values.at("m"), 3) << name;
    for (const auto* name : {"x1.v1", "x1.f1", "x1.h1", "x1.e1", "x1.b1"}) EXPECT_TRUE(element_in(c, name).values.empty()) << name;
    EXPECT_EQ(element_in(c, "x1.f1").value, 2) << "its controlling current is already three times as large";
    EXPECT_EQ(element_in(c, "x1.h1").value, 2);
    EXPECT_EQ(element_in(c, "x1.f1").control_source, "x1.v1");
}

TEST(NetlistSubcircuits, AreRejectedWithLocationAndSuggestion) {
    const struct {
        const char *body, *message;
    } cases[] = {
        {".subckt inv a b\n.ends\nX1 a b inw", "4:8: x1: unknown subcircuit 'inw'; did you mean 'inv'?"},
        {".subckt inv in out vdd\n.ends\nX1 a b inv", "4:1: x1: 2 nodes, but subcircuit 'inv' has 3: in out vdd"},
        {".subckt inv a params: w=1\n.ends\nX1 a inv ww=2", "4:10: x1: subcircuit 'inv' has no parameter 'ww'; did you mean 'w'?"},
        {".subckt a x\nX1 x b\n.ends\n.subckt b x\nX1 x a\n.ends\nX1 n a", "6:1: subcircuit 'a' contains itself: a -> b -> a"},
        {".subckt a x\nR1 x 0 1", "2:1: .subckt a is not closed by .ends"},
        {".ends", "2:1: .ends without .subckt"},
        {".subckt a x\n.ends b", "3:7: .ends b does not match .subckt a"},
        {".subckt a x x\n.ends", "2:13: .subckt a: node 'x' is given twice"},
        {".subckt a x\n.ends\n.subckt a y\n.ends", "4:9: subcircuit 'a' is already defined at dir/t.cir:2"},
        {".subckt a x\n.tran 1n 1u\n.ends", "3:1: .tran is not allowed inside .subckt a; move it outside"},
        {"X1 a\n", "2:4: x1: unknown subcircuit 'a'"},
        {"X1", "2:3: x1: expected nodes and the name of a subcircuit"},
        {".subckt a x\n.ends\nX1 n a m=-1", "4:10: x1: m = -1 must be positive"},
        {".subckt a x\nV1 x 0 1\nB1 x 0 i=i(v1)\n.ends\nX1 n a m=2",
         "4:1: b1: an expression with a current is not supported in a subcircuit with m="},
    };
    for (const auto& c : cases) EXPECT_EQ(error_of(c.body), std::string("dir/t.cir:") + c.message) << c.body;
}

TEST(NetlistSubcircuits, ExpandToALimitedNumber) {
    std::string body;
    for (int k = 0; k < 60; ++k) body += fmt::format(".subckt s{0} a\nX1 a s{1}\nX2 a s{1}\n.ends\n", k, k + 1);
    const auto message = error_of(body + ".subckt s60 a\n.ends\nX1 a s0\n");
    EXPECT_NE(message.find("the limit of"), std::string::npos) << message;
    std::string deep;
    for (int k = 0; k < 300; ++k) deep += fmt::format(".subckt s{} a\nX1 a s{}\n.ends\n", k, k + 1);
    EXPECT_NE(error_of(deep + ".subckt s300 a\n.ends\nX1 a s0\n").find("subcircuits are nested deeper than the limit of 200"),
              std::string::npos);
    std::string inside;
    for (int k = 0; k < 300; ++k) inside += fmt::format(".subckt s{} a\n", k);
    EXPECT_NE(error_of(inside).find("definitions of subcircuits are nested deeper than the limit of 200"), std::string::npos);
}

// ---- parameters ----

TEST(NetlistParameters, AreAllowedInAnyOrderAndCanBeOverridden) {
    const std::string body = ".param a={b*2} b = c + 1, c=3\n.param g(x,y)='x*y+a'\n.func h(z) {z+g(1,z)}\nR1 n 0 {h(2)}\nR2 n 0 a\n";
    const auto c = circuit(body);
    EXPECT_EQ(element_in(c, "r2").value, 8);
    EXPECT_EQ(element_in(c, "r1").value, 2 + 2 + 8);
    EXPECT_EQ(element_in(circuit(body, {}, {{"c", 4}}), "r2").value, 10);
    EXPECT_EQ(element_in(circuit(body, {}, {{"b", 1}}), "r2").value, 2);
    const auto unknown = read(body, {}, {{"bb", 1}});
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().text(), "dir/t.cir: there is no .param bb; did you mean 'b'?");
}

TEST(NetlistParameters, CircularDefinitionsAreRejectedWithTheChain) {
    EXPECT_EQ(error_of(".param a={b} b={c}\n+ c={f(1)}\n.func f(x) {a+x}"),
              "dir/t.cir:2:11: parameter a depends on itself: a -> b -> c -> a");
    EXPECT_EQ(error_of(".param a={a}"), "dir/t.cir:2:11: parameter a depends on itself: a -> a");
    EXPECT_EQ(error_of(".func f(x) {g(x)}\n.func g(x) {f(x)}\n.param a={f(1)}"), "dir/t.cir:4:11: in g(): f() calls itself");
    EXPECT_EQ(error_of(".param a={1+bb} b=2"), "dir/t.cir:2:13: unknown name 'bb'; did you mean 'b'?");
    EXPECT_EQ(error_of(".param a"), "dir/t.cir:2:8: expected name=value here");
    EXPECT_EQ(error_of(".param a=ln(-1)"), "dir/t.cir:2:10: 'ln(-1)' is not a number");
    EXPECT_EQ(error_of(".param a=1\n.param b={v(a)}"),
              "dir/t.cir:3:11: v(...) is not available in a parameter, only in an expression of the circuit");
}

TEST(NetlistParameters, AChainOfAHundredThousandDoesNotOverflowTheStack) {
    std::string body;
    for (int k = 0; k < 100000; ++k) body += fmt::format(".param a{}={{a{}+1}}\n", k, k + 1);
    const auto c = circuit(body + ".param a100000=1\nR1 a 0 {a0}\n");
    EXPECT_EQ(element_in(c, "r1").value, 100001);
}

// ---- files ----

TEST(NetlistFiles, AreIncludedRelativeToTheIncludingFile) {
    const Files files{{"dir/Sub/A.inc", "R1 a 0 {w}\n.include \"../b.inc\"\n.end\nnot read\n"},
                      {"dir/b.inc", ".param w=5\n.subckt s a\nR1 a 0 1\n.ends\n"}};
    const auto c = circuit(".INCLUDE 'Sub/A.inc' ; comment\nX1 a s\nR2 a 0 1\n", files);
    EXPECT_EQ(element_in(c, "r1").value, 5);
    EXPECT_EQ(element_in(c, "r1").location.file, "dir/Sub/A.inc");
    EXPECT_EQ(element_in(c, "r1").location.line, 1);
    EXPECT_EQ(c.elements.size(), 3U);
}

TEST(NetlistFiles, LibrariesContributeOnlyTheNamedSection) {
    const Files files{{"dir/p.lib",
                       "* all corners\n.lib TT\n.param v=1\n.lib 'p.lib' base\n.endl TT\n.LIB ss\n.param v=2\n.lib 'p.lib' base\n.ENDL\n"
                       ".lib base\n.model nm nmos vto={v}\n.endl\nthis is outside\n"}};
    const auto c = circuit(".lib 'p.lib' SS\nM1 a b c 0 nm\n", files);
    EXPECT_EQ(c.models[0].values.at("vto"), 2);
    EXPECT_EQ(error_of(".lib 'p.lib' sf", files),
              "dir/t.cir:2:6: library 'dir/p.lib' has no section 'sf'; it has tt, ss, base; did you mean 'ss'?");
    EXPECT_EQ(error_of(".lib ~/p.lib"), "dir/t.cir:2:6: '~/p.lib': no such file; '~' is not replaced, so write the whole path");
    EXPECT_EQ(error_of(".lib tt\nR1 a 0 1"),
              "dir/t.cir:2:1: .lib with one word begins a section, but .endl is missing; to read a file, use .include");
    EXPECT_EQ(error_of(".endl"), "dir/t.cir:2:1: .endl without .lib");
}

TEST(NetlistFiles, OfALibWithoutASectionAreReadCompletely) {
    const Files files{{"dir/sub/p.lib", "R9 a 0 5\n"}};
    for (const char* line : {".lib 'sub/p.lib'\n", ".lib sub/p.lib\n", ".lib sub\\p.lib\n", ".include \"sub\\p.lib\"\n"})
        EXPECT_EQ(element_in(circuit(std::string(line) + "V1 a 0 1\n", files), "r9").value, 5) << line;
}

TEST(NetlistFiles, ThatCannotBeReadAreRejected) {
    const Files files{{"dir/a.inc", ".include b.inc\n"},
                      {"dir/b.inc", "R1 a 0 1k\n.include 'a.inc'"},
                      {"dir/open.inc", ".subckt s a\n"},
                      {"dir/bad.inc", "R1 a 0 {x}\n"},
                      {"dir/ends.inc", ".ends\n"}};
    EXPECT_EQ(error_of(".include 'none.inc'", files), "dir/t.cir:2:10: 'none.inc': no such file");
    EXPECT_EQ(error_of(".include a.inc", files), "dir/b.inc:2:10: 'a.inc' includes itself");
    EXPECT_EQ(error_of(".include t.cir", {{"dir/t.cir", ""}}), "dir/t.cir:2:10: 't.cir' includes itself");
    EXPECT_EQ(error_of(".include open.inc\n.ends", files), "dir/open.inc:1:1: .subckt s is not closed by .ends");
    EXPECT_EQ(error_of(".subckt s a\n.include ends.inc\n", files), "dir/ends.inc:1:1: .ends without .subckt");
    EXPECT_EQ(error_of(".include bad.inc", files), "dir/bad.inc:1:9: unknown name 'x'");
    EXPECT_EQ(error_of(".include", files), "dir/t.cir:2:9: .include: expected one file; put a name with blanks in quotes");
    Files chain;
    for (int k = 0; k < 60; ++k) chain[fmt::format("dir/{}.inc", k)] = fmt::format(".include {}.inc\n", k + 1);
    EXPECT_EQ(error_of(".include 0.inc", chain), "dir/49.inc:1:10: included files are nested deeper than the limit of 50");
    const auto missing = Netlist::read("/nowhere/at/all.cir");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().text(), "/nowhere/at/all.cir: cannot be read: there is no such file");
}

// ---- directives ----

TEST(NetlistCommands, AreWordsWithTheirLocationsAndValues) {
    const auto c = circuit(
        ".param vdd=1.8\nR1 a 0 1\n.TRAN 1n  10u\n.meas tran tt trig v( a , 0 ) val = {vdd/2} rise=1 targ v(a) val='vdd*0.9' fall = "
        "LAST\n.expect rate >= "
        "20, tol={unknown}\n.print \"Keep Case\" v(a,b),i(v1)\n.dc v1 0 {vdd} 0.1\n");
    ASSERT_EQ(c.directives.size(), 5U);
    EXPECT_EQ(c.directives[0].name, "tran");
    EXPECT_EQ(c.directives[0].words, (std::vector<std::string>{"1n", "10u"}));
    EXPECT_EQ(c.directives[0].columns, (std::vector<int>{7, 11}));
    EXPECT_EQ(c.directives[0].location.line, 4);
    EXPECT_EQ(c.directives[1].words, (std::vector<std::string>{"tran", "tt", "trig", "v(a,0)", "val=0.90000000000000002", "rise=1", "targ",
                                                               "v(a)", "val=1.6200000000000001", "fall=last"}));
    EXPECT_EQ(c.directives[2].words, (std::vector<std::string>{"rate", ">=", "20", "tol={unknown}"}));
    EXPECT_EQ(c.directives[3].words, (std::vector<std::string>{"\"Keep Case\"", "v(a,b)", "i(v1)"}));
    EXPECT_EQ(c.directives[4].words[2], "1.8");
}

TEST(NetlistCommands, SetOptionsTemperatureAndInitialConditions) {
    const auto c = circuit(
        ".param x=0.3\n.options reltol=1e-4 METHOD=Gear noacct abstol={1p}\n.temp 85\n.ic v(a)=1 v(x1.n) = {x}\n.nodeset v( a )='x*2'\nR1 "
        "a 0 1\n"
        ".subckt s p\nR1 p n 1\nR2 n 0 1\n.ic v(n)=2 v(p)=3\n.ends\nX1 a s\n");
    EXPECT_EQ(c.options, (Values{{"abstol", 1e-12}, {"noacct", 1}, {"reltol", 1e-4}}));
    EXPECT_EQ(c.option_words.at("method"), "gear");
    EXPECT_EQ(c.temperature, 85);
    const int a = c.find_node("a"), n = c.find_node("x1.n");
    EXPECT_EQ(c.ic, (std::vector<std::pair<int, double>>{{n, 2}, {a, 3}, {a, 1}, {n, 0.3}}));
    EXPECT_EQ(c.nodesets, (std::vector<std::pair<int, double>>{{a, 0.6}}));
}

TEST(NetlistCommands, AreRejectedWithLocationAndSuggestion) {
    const struct {
        const char *body, *message;
    } cases[] = {
        {".trann 1n 1u", "2:1: unknown statement '.trann'; did you mean '.tran'?"},
        {".if (1)", "2:1: .if is not closed by .endif"},
        {".ic v(outt)=1\nR1 out 0 1", "2:5: unknown node 'outt'; did you mean 'out'?"},
        {".ic a=1", "2:5: expected v(node)=value, not 'a=1'"},
        {".ic v(0)=1", "2:5: ground is always at 0 V"},
        {".ic v(a)=x\nR1 a 0 1", "2:10: unknown name 'x'"},
        {".temp", "2:6: .temp: expected temperatures, in Celsius"},
        {".options reltol=1q3", "2:17: '1q3' is not a number"},
        {".control\nrun", "2:1: .control is not closed by .endc"},
        {".endc", "2:1: .endc without .control"},
        {".func f {2}", "2:7: .func: expected a function such as f(x) {2*x}"},
        {".func f(x)", "2:10: .func: the expression is missing; write one such as f(x) {2*x}"},
    };
    for (const auto& c : cases) EXPECT_EQ(error_of(c.body), std::string("dir/t.cir:") + c.message) << c.body;
}

TEST(NetlistWarnings, PointAtMisleadingNumbers) {
    const auto warnings = [](const std::string& text) {
        const auto c = Netlist::parse(text, "t.cir", {});
        EXPECT_TRUE(c) << c.error().text();
        std::vector<std::string> out;
        const auto flat = c->elaborate();
        for (const auto& r : flat->warnings) out.push_back(r.text());
        return out;
    };
    using Messages = std::vector<std::string>;
    EXPECT_EQ(
        warnings("t\nC1 a 0 1F\nC2 a 0 10f\nC3 a 0 1uF\nC4 a 0 c=2F\n"),
        (Messages{"t.cir:2:8: c1: 1F is 1 femtofarad; for a farad write 1", "t.cir:5:10: c4: 2F is 2 femtofarad; for a farad write 2"}));
    EXPECT_EQ(
        warnings("t\nR1 a 0 5M\nR2 a 0 5m\nR3 a 0 5Meg\nR4 a 0 5MEG\nR5 a 0 1Mohm\n"),
        (Messages{"t.cir:2:8: r1: 5M is 5 milliohm; for a megohm write 5Meg", "t.cir:6:8: r5: 1M is 1 milliohm; for a megohm write 1Meg"}));
    EXPECT_EQ(warnings("t\nV1 a 0 SIN(0 1 1MHz)\n"), (Messages{"t.cir:2:16: v1: 1MHz is 1 millihertz; for a megahertz write 1Meg"}));
    EXPECT_EQ(warnings("R1 a b 1k\n"), (Messages{"t.cir:1:1: the first line is the title, so 'R1 a b 1k' is not read as a statement"}));
    EXPECT_EQ(warnings(".param a=1\n"), (Messages{"t.cir:1:1: the first line is the title, so '.param a=1' is not read as a statement"}));
    for (const auto* title : {"Low pass", "* R1 a b 1k", "", "rectifier with a load", "V1 of the chip"})
        EXPECT_TRUE(warnings(std::string(title) + "\n").empty()) << title;
    EXPECT_EQ(warnings("t\n.control\nfoo 'bar \xff\n.endc\n.param a=1\n.param a=2\n"),
              (Messages{"t.cir:3:1: .control: 'foo' has no effect here: it is unknown",
                        "t.cir:6:8: .param a is given twice; this value is used"}));
}

RC_GTEST_PROP(Netlist, AcceptsAnyTextSafely, (const std::vector<std::string>& lines)) {
    std::string text = "t\n";
    for (const auto& line : lines)
        text += *rc::gen::element<std::string>("R1 ", ".param ", "X1 a ", "", "+", ".ic ", "V1 ", ".subckt ") + line + "\n";
    const auto netlist = Netlist::parse(text, "t.cir", [](const std::string&) { return bad_input("no"); });
    if (!netlist) {
        RC_ASSERT(!netlist.error().message.empty());
        return;
    }
    const auto c = netlist->elaborate();
    if (!c) RC_ASSERT(!c.error().message.empty() && c.error().location.line > 0);
}

}  // namespace
}  // namespace corpuscle::circuit
