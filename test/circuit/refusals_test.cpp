// All errors of a netlist are reported at once, the worst first.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "circuit/devices.hpp"
#include "circuit/netlist_runner.hpp"
#include "circuit/similar_names.hpp"

namespace corpuscle::circuit {
namespace {

/// All errors of a netlist, one per line, as LINE.COLUMN MESSAGE.
std::string errors_of(const std::string& body) {
    const auto no_file = [](const std::string&) -> Result<std::string> { return bad_input("there is no such file"); };
    const auto netlist = Netlist::parse("faults\n" + body, "faults.cir", no_file);
    auto error = netlist ? std::optional<Error>() : std::optional(netlist.error());
    if (netlist) {
        const auto circuit = netlist->elaborate();
        if (!circuit) error = circuit.error();
        if (circuit)
            if (const auto context = AnalysisContext::make(std::make_shared<const Circuit>(*circuit)); !context) error = context.error();
    }
    if (!error) return "";
    const auto short_text = [](const Error& e) {
        return e.location.line > 0 ? fmt::format("{}.{} {}\n", e.location.line, e.location.column, e.message) : e.message + '\n';
    };
    std::string out = short_text(*error);
    if (error->further)
        for (const auto& other : *error->further) out += short_text(other);
    return out;
}

TEST(Refusals, NameMissingDevicesBeforeDirectivesBeforeAllElse) {
    EXPECT_EQ(errors_of("r1 a\n.hb 1k\nj1 a b 0 jm\nv1 a 0 1\nj2 a b 0 jm\nm1 a a 0 0 bsim w=1u foo=2\n.model bsim nmos level=14 bar=1\n"
                        ".include nowhere.inc\nj3 a b 0 jm\n"),
              "4.1 'j1': unknown element letter j (junction field-effect transistor); known are " + element_letters() +
                  "; also j2, j3\n"
                  "7.12 m1: model 'bsim' has level 14, which is not supported; use " +
                  supported_levels('m') +
                  "\n"
                  "3.1 .hb is not supported; a .tran of many periods with .four gives the harmonics\n"
                  "9.10 'nowhere.inc': there is no such file\n"
                  "2.5 r1: 1 node, but expected 2: plus, minus, then a value or a model\n");
}

TEST(Refusals, ABodyFactorAboveTheSlopeFactorNamesTheLargestOne) {
    const auto with = [](const char* gamma) {
        return errors_of(fmt::format("v1 a 0 1\nm1 a a 0 0 nb\n.model nb nmos(level=80 n=1.27 gamma={} phi=0.85)\n.op\n", gamma));
    };
    EXPECT_EQ(with("0.6"),
              "4.1 nb: gamma = 0.6 V^0.5 with phi = 0.85 V requires n of at least 1.3254, but n = 1.27; reduce gamma to 0.4978 or "
              "increase n\n");
    EXPECT_EQ(with("0.4978"), "");
}

TEST(Refusals, OfElementsAreReportedTogether) {
    EXPECT_EQ(errors_of("r1 a\nr2 a 0 {x}\nr3 a 0 1k foo=1\nr4 a 0 1k\n"),
              "2.5 r1: 1 node, but expected 2: plus, minus, then a value or a model\n"
              "3.9 unknown name 'x'\n"
              "4.11 r3: unknown parameter 'foo'\n");
    EXPECT_EQ(errors_of("v1 a 0 1\nd1 a 0 d1\nd2 a 0 d2\n.model d1 d(is=-1)\n.model d2 d(eeg=1)\n"),
              "5.1 d1: is = -1 A is outside [1e-40, 1000]\n6.1 d2: unknown parameter 'eeg'; did you mean 'eg'?\n");
}

TEST(Refusals, OfUnknownModelsSuggestThoseOfTheirScope) {
    EXPECT_EQ(errors_of(".subckt a d\n.model nmos1 nmos level=1\nm1 d d 0 0 nmos2\n.ends\n.subckt b d\nm1 d d 0 0 nmos2\n.ends\n"
                        "x1 n a\nx2 n b\nv1 n 0 1\n"),
              "4.12 m1: unknown model 'nmos2'; did you mean 'nmos1'?\n7.12 m1: unknown model 'nmos2'\n");
}

TEST(Suggestions, AreSearchedForTheFirstNamesOnlyAndOnceForEach) {
    Suggestions suggestions;
    int searches = 0;
    const std::vector<std::string_view> known{"nmos1"};
    for (int round = 0; round < 2; ++round)
        for (int k = 0; k < 1000; ++k) {
            const auto found = suggestions.for_name(&known, fmt::format("nmos1{}", k), [&] { return ++searches, known; });
            EXPECT_EQ(found.empty(), k >= 20) << k << found;
        }
    EXPECT_EQ(searches, 20);
}

TEST(Refusals, OfDirectivesDoNotHideThoseOfElements) {
    EXPECT_EQ(errors_of("v1 a 0 1\n.parm x=1\n.trans 1m\nr1 a 0 1k foo=1\nr2 a 0 {x}\n"),
              "3.1 unknown statement '.parm'; did you mean '.param'?\n4.1 unknown statement '.trans'; did you mean '.tran'?\n"
              "5.11 r1: unknown parameter 'foo'\n")
        << "x may be a parameter of the refused line";
}

TEST(Refusals, OfNumbersNameTheRemedyThatThePartsNeed) {
    EXPECT_EQ(errors_of("v1 a 0 1\nr1 a 0 4K7\nr2 a 0 2R2\nr3 a 0 1,000\nr4 a 0 0,5\n"),
              "3.8 '4k7' is not a number; write 4.7k\n4.8 '2r2' is not a number; write 2.2\n"
              "5.8 r3: '1,000' has a decimal comma; write 1.000, or 1000\n6.8 r4: '0,5' has a decimal comma; write 0.5\n");
    EXPECT_EQ(errors_of("v1 a 0 1\nr1 a b 1k\nr2 b 0 {r}\n"), "4.9 unknown name 'r'\n") << "one letter resembles too many names";
}

TEST(Refusals, OfStatementsOfOtherSimulatorsSayWhatToDo) {
    EXPECT_EQ(errors_of("v1 a 0 1\n.data corners r c\n1k 2k\n.enddata\n.fft v(a)\nr1 a 0 1k\n"),
              "3.1 .data is not supported; write .step param NAME list VALUE ...\n"
              "6.1 .fft is not supported; use .four FREQUENCY CURVE\n");
    EXPECT_EQ(
        errors_of("v1 a 0 1\nr1 a b 1k\nl1 b 0 1m\nl2 s1 s2 1m\nk1 l1 l2 0.9\nr2 s1 s2 1k\n"),
        "5.1 nodes 's1', 's2' have no path to ground for direct current: their part of the circuit is not connected to ground (a "
        "coupling of inductors connects no nodes), so nothing sets its voltage (connected: l2, r2). Add a large resistor to ground\n");
}

TEST(Refusals, OfASubcircuitAreReportedOnceForAllItsInstances) {
    std::string body = ".subckt s a\nr1 a 0 {x}\n.ends\n";
    for (int k = 0; k < 50; ++k) body += "x" + std::to_string(k) + " a s\n";
    EXPECT_EQ(errors_of(body), "3.9 unknown name 'x'\n");
}

TEST(Refusals, OfConditionsNameTheirLine) {
    EXPECT_EQ(errors_of("v1 a 0 1\n.if (1)\nr1 a 0 1\n"), "3.1 .if is not closed by .endif\n");
    EXPECT_EQ(errors_of("v1 a 0 1\n.endif\n"), "3.1 .endif without .if\n");
    EXPECT_EQ(errors_of("v1 a 0 1\n.if (1)\n.else\n.else\n.endif\n"), "5.1 .else after .else\n");
    EXPECT_EQ(errors_of(".if (x)\nv1 a 0 1\n.endif\n"), "2.6 unknown name 'x'\n");
    EXPECT_EQ(errors_of(".if\nv1 a 0 1\n.endif\n"), "2.4 .if: expected a condition, such as .if (x > 1)\n");
    EXPECT_EQ(errors_of(".if (1)\n.param x=1\n.endif\n"),
              "3.1 .param is not allowed inside .if; move it outside, and write .param x={condition ? a : b}\n");
    EXPECT_EQ(errors_of(".if (1)\n.temp 50\n.endif\n"), "3.1 .temp is not allowed inside .if; move it outside\n");
}

TEST(Refusals, OfTwoModelsThatBothHoldNameThePlaceOfTheFirst) {
    const std::string deck = "v1 a 0 1\nd1 a 0 dm\n.param x=1\n.model dm d is=1f\n.if (x)\n.model dm d is=2f\n.endif\n";
    EXPECT_EQ(errors_of(deck), "7.8 model 'dm' is already defined at faults.cir:5\n");
}

TEST(Refusals, OfAnEmptyWordInAModelNameTheWordBefore) {
    EXPECT_EQ(errors_of("v1 a 0 1\nd1 a 0 dm\n.model dm d is \"\"\n"), "4.13 expected name=value, not 'is'\n");
}

TEST(Refusals, OfTooManyConditionsEndTheElaboration) {
    std::string body = ".subckt s0 a\n";
    for (int k = 0; k < 1000; ++k) body += ".if (1)\n.endif\n";
    body += "r1 a 0 1k\n.ends\n";
    for (int level = 1; level <= 12; ++level) body += fmt::format(".subckt s{0} a\nx1 a s{1}\nx2 a s{1}\n.ends\n", level, level - 1);
    EXPECT_NE(errors_of(body + "x1 a s12\n").find("the circuit has more elements than the limit of 2000000"), std::string::npos);
}

TEST(Refusals, OfDecimalCommasNameTheNumber) {
    EXPECT_EQ(errors_of("v1 a 0 0,5\n"), "2.8 v1: '0,5' has a decimal comma; write 0.5\n");
    EXPECT_EQ(errors_of("r1 a 0 1,5k\n"), "2.8 r1: '1,5k' has a decimal comma; write 1.5k\n");
    EXPECT_EQ(errors_of(".param x=0,5\nr1 a 0 {x}\n"), "2.11 ',' is not a decimal point; write a dot\n");
}

TEST(Refusals, OfATableNameItsPoints) {
    EXPECT_EQ(errors_of("b1 a 0 v=table(v(a),1,2,1,3)\n"), "2.10 table(): x = 1 must be above 1\n");
    EXPECT_EQ(errors_of("b1 a 0 v=table(v(a),1,2,3)\n"), "2.10 table() takes a value and at least two points: table(x, x1,y1, x2,y2)\n");
    EXPECT_EQ(errors_of("e1 a 0 table v(a) 0 0\n"), "2.14 e1: table: expected table {EXPRESSION} = (x1,y1) (x2,y2) ...\n");
}

TEST(Refusals, BeyondTwentyAreCounted) {
    std::string body;
    for (int k = 0; k < 3000; ++k) body += "r" + std::to_string(k) + " a 0 {x}\n";
    const auto text = errors_of(body);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 21);
    EXPECT_NE(text.find("21.10 unknown name 'x'\n980 further errors\n"), std::string::npos) << text;
}

TEST(Refusals, DoNotContainWhatOnlyFollowsFromOtherErrors) {
    // The include that fails would define the model and the subcircuit.
    EXPECT_EQ(errors_of(".include lost.inc\nd1 a 0 dm\nx1 a 0 lost\nr1 a 0 1\n"), "2.10 'lost.inc': there is no such file\n");
}

}  // namespace
}  // namespace corpuscle::circuit
