// Overrides of netlist values by name, and selection of probes by name.

#include "circuit/variant/netlist_overrides.hpp"

#include <gtest/gtest.h>

#include <map>

#include "circuit/afferent/circuit_afferent.hpp"
#include "circuit/devices.hpp"
#include "circuit/netlist_runner.hpp"
#include "circuit/output/saved_quantities.hpp"
#include "circuit/variant/hierarchical_names.hpp"
#include "support/support.hpp"

namespace corpuscle::circuit {
namespace {

using corpuscle::test::value_or_throw;

ParameterOverride make_override(const std::string& netlist, const std::string& text) {
    return value_or_throw(parse_netlist_override(netlist, text, "--set"));
}

/// Temporary netlist files, and overrides of the first one, own.cir.
class OverrideFiles {
    corpuscle::test::TemporaryFolder folder_;

public:
    OverrideFiles(const std::string& netlist, const std::map<std::string, std::string>& more = {}) {
        folder_.write("own.cir", netlist);
        for (const auto& [name, text] : more) folder_.write(name, text);
    }
    Result<Circuit> set(const std::vector<std::string>& texts) const {
        std::vector<ParameterOverride> overrides;
        const std::string netlist = folder_ / "own.cir";
        for (const auto& t : texts) overrides.push_back(make_override(netlist, t));
        const auto applied = apply_overrides(netlist, overrides);
        return applied ? applied->result.elaborate() : applied.error();
    }
    std::string error_of(const std::vector<std::string>& texts) const {
        const auto done = set(texts);
        return done ? "" : done.error().message;
    }
};

const Element& element(const Circuit& c, const std::string& name) { return c.elements[static_cast<std::size_t>(c.find_element(name))]; }

constexpr const char* blocks =
    "blocks\n.param c_u=1p gain=2 i_0='2*gain*1n'\n.model nm nmos (level=80)\n"
    ".subckt cell a b\nmn1 a b 0 0 nm w=1u l=0.5u m=2 stack=4\nru a b 10k\ncu a 0 {c_u}\n.ends\n"
    ".subckt pair a b\nxleft a b cell\nxright b a cell\n.ends\n"
    "xone p q pair\nxtwo q p pair\nxtriple p q cell m=3\nvp p 0 1\nii q 0 {i_0}\nvs s 0 sin(0 1 1k)\nrs s 0 1k\nb1 q 0 "
    "i={gain*v(p)*1n}\n.op\n";

std::vector<std::string_view> some_names() { return {"xone.xleft.mn1", "xone.xright.mn1", "xtwo.xleft.mn1", "mn1", "m1", "xone.x", "mm1"}; }

TEST(PathNames, TheEndOfAPathIsEnoughAndACompleteNameTakesPrecedence) {
    const auto names = some_names();
    using Indices = std::vector<std::size_t>;
    EXPECT_EQ(find_matching_names(names, "xone.xleft.mn1", LastPiece::element), Indices{0});
    EXPECT_EQ(find_matching_names(names, "ONE.Left.N1", LastPiece::element), Indices{0});
    EXPECT_EQ(find_matching_names(names, "right.n1", LastPiece::element), Indices{1});
    EXPECT_EQ(find_matching_names(names, "left.n1", LastPiece::element), (Indices{0, 2}));
    EXPECT_EQ(find_matching_names(names, "mn1", LastPiece::element), Indices{3});
    EXPECT_EQ(find_matching_names(names, "m1", LastPiece::element), Indices{4}) << "mm1 without its letter has lower precedence";
    EXPECT_EQ(find_matching_names(names, "x", LastPiece::node), Indices{5});
    EXPECT_TRUE(find_matching_names(names, "n1", LastPiece::node).empty()) << "a node's name has no element letter to omit";
    EXPECT_TRUE(find_matching_names(names, "ft.n1", LastPiece::element).empty());
    EXPECT_TRUE(find_matching_names(names, "", LastPiece::element).empty());
    EXPECT_EQ(short_name("xone.xleft.mn1", 2, LastPiece::element), "left.n1");
    EXPECT_EQ(short_name("xone.xleft.mn1", 9, LastPiece::node), "one.left.mn1");
}

TEST(NetlistOverrides, ANumberHasTheUnitsOfTheProgramsOptions) {
    const auto expect_result = [](const std::string& text, double value, std::string_view unit) {
        const auto read = parse_number_with_unit(text);
        ASSERT_TRUE(read) << text;
        EXPECT_NEAR(read->value, value, 1e-12 * std::abs(value)) << text;
        EXPECT_EQ(read->unit, unit) << text;
    };
    expect_result("4pF", 4e-12, "F"), expect_result("7 pA", 7e-12, "A"), expect_result("0.65V", 0.65, "V"),
        expect_result("200nA", 200e-9, "A"), expect_result("10Mohm", 1e7, "ohm");
    expect_result("5m", 5e-3, ""), expect_result("5M", 5e6, ""), expect_result("1.2um", 1.2e-6, "m"), expect_result("-3", -3, ""),
        expect_result("20 kHz", 2e4, "Hz"), expect_result("3 ms", 3e-3, "s");
    for (const auto* wrong : {"10meg", "", "four", "4pF5", "1e999"}) EXPECT_FALSE(parse_number_with_unit(wrong)) << wrong;
}

TEST(NetlistOverrides, AnOverrideChangesItsValueAndNothingElse) {
    const OverrideFiles files(blocks);
    const auto plain = value_or_throw(files.set({}));
    const auto c = value_or_throw(files.set({"C_u=4pF", "GAIN=3", "one.left.N1=8x3", "xtwo.xright.mn1.w=1.2um", "triple.n1.M=5",
                                             "two.left.ru=20 kohm", "two.right.cu=7p", "triple.ru.m=4", "p=2 V", "temp=85"}));
    EXPECT_EQ(c.parameters.at("c_u"), 4e-12);
    EXPECT_EQ(element(c, "xone.xleft.cu").value, 4e-12);
    EXPECT_EQ(element(c, "xtwo.xright.cu").value, 7e-12);
    EXPECT_NEAR(element(c, "ii").waveform.dc, 6e-9, 1e-21) << "a .param computed from gain, which is overridden";
    EXPECT_EQ(element(c, "xone.xleft.mn1").values.at("m"), 8);
    EXPECT_EQ(element(c, "xone.xleft.mn1").values.at("stack"), 3);
    EXPECT_EQ(element(c, "xtwo.xright.mn1").values.at("w"), 1.2e-6);
    EXPECT_EQ(element(c, "xtriple.mn1").values.at("m"), 15) << "five columns in each of three";
    EXPECT_EQ(element(c, "xtriple.ru").values.at("m"), 12);
    EXPECT_EQ(element(c, "xtwo.xleft.ru").value, 20e3);
    EXPECT_EQ(element(c, "vp").waveform.dc, 2);
    EXPECT_EQ(c.temperature, 85);
    EXPECT_EQ(plain.temperature, 27);
    for (const auto* untouched : {"xone.xright.mn1", "xtwo.xleft.mn1"})
        EXPECT_EQ(element(c, untouched).values, element(plain, untouched).values);
    EXPECT_EQ(value_or_throw(files.set({"c_u=1p", "C_U=2p"})).parameters.at("c_u"), 2e-12) << "the later override takes precedence";
}

TEST(NetlistOverrides, UnknownNamesAndWrongValuesAreRejectedWithSuggestions) {
    const OverrideFiles files(blocks);
    const auto expect_error = [&](const std::string& override_text, const std::string& what) {
        const auto message = files.error_of({override_text});
        EXPECT_NE(message.find("--set " + override_text + ": "), std::string::npos) << message;
        EXPECT_NE(message.find(what), std::string::npos) << message;
    };
    expect_error("c_v=4pF", "has no parameter or device 'c_v'; did you mean 'c_u'?");
    expect_error("one.left.n2=8x4", "did you mean 'one.left.n1'?");
    expect_error("one.lft.n1.w=1u", "did you mean 'one.left.n1.w'?");
    expect_error("left.n1=8x4", "'left.n1' is ambiguous: xone.xleft.mn1, xtwo.xleft.mn1; write more of its path");
    expect_error("left.n1.w=1u", "'left.n1' is ambiguous: xone.xleft.mn1, xtwo.xleft.mn1; write more of its path");
    expect_error("one.left.n1.ww=1u", "xone.xleft.mn1 has no 'ww'; did you mean 'w'? (it has w, l, m, stack, delvto");
    expect_error("one.left.n1=0x4", "0 columns; at least 1 is required");
    expect_error("one.left.n1=8x0", "0 units in series; at least 1 is required");
    expect_error("one.left.n1=2.5x4", "'2.5x4' is not an array; write COLUMNSxSERIES, such as 8x4");
    expect_error("one.left.n1=4pF", "'4pF' is not an array");
    expect_error("one.left.n1.w=-1u", "-1 um is outside [1 nm, 1 m]");
    expect_error("one.left.n1.w=1V", "'1V' is a voltage; expected a value in m");
    expect_error("one.left.n1.m=0", "0 is outside [1e-06, 1e+09]");
    expect_error("one.left.ru=0", "a resistor must not be 0 ohm");
    expect_error("one.left.cu=-1p", "-1 pF must not be below 0");
    expect_error("one.left.ru.m=0", "0 must be above 0");
    expect_error("vs=2V", "vs is a source with a time waveform");
    expect_error("b1=2", "b1 has an expression; its value is not a single number");
    expect_error("c_u=4q", "'4q' is not a number; write a number and a unit of V, A, F, ohm, s, Hz, m, S, N or none");
    expect_error("temp=hot", "'hot' is not a temperature");
    expect_error("temp=-300", "-300 C is outside");
    expect_error("mismatch=-1", "'-1' is not a seed");
    expect_error("mismatch=7/half", "'7/half' is not a seed; write an integer from 0 to 2^53, or SEED/CHIP");
    expect_error("corner=ss", "there is no corner 'ss': the netlist has no line .lib 'file' section");
}

constexpr const char* cards =
    ".lib tt\n.param shift=0\n.lib 'card.lib' devices\n.endl\n.lib ss\n.param shift=40m\n.lib 'card.lib' devices\n.endl\n"
    ".lib devices\n.model nm nmos (level=80 vto='0.4+shift')\n.endl\n";

TEST(NetlistOverrides, AChipOfASeedIsTheSameInASampleOfMany) {
    const OverrideFiles files("t\nm1 a a 0 0 nm\n.model nm nmos (level=80 avt=1n)\nv1 a 0 1\n.op\n", {});
    const auto chip = chip_sample_of(value_or_throw(files.set({"mismatch=7/5"})));
    ASSERT_TRUE(chip);
    EXPECT_EQ(chip->seed, 7U);
    EXPECT_EQ(chip->chip, 5U);
    EXPECT_TRUE(std::ranges::equal(chip->process, ChipSpec{10, 7}.sample(5).process));
    EXPECT_EQ(chip_sample_of(value_or_throw(files.set({"mismatch=7"})))->chip, 0U);
    EXPECT_FALSE(chip_sample_of(value_or_throw(files.set({}))));
}

TEST(NetlistOverrides, ACornerReplacesTheSectionOfEachLibraryThatHasIt) {
    const std::string netlist = "t\n.lib 'card.lib' tt\nm1 a a 0 0 nm\nv1 a 0 1\n.op\n";
    const OverrideFiles files(netlist, {{"card.lib", cards}});
    EXPECT_NEAR(value_or_throw(files.set({})).models[0].values.at("vto"), 0.4, 1e-12);
    EXPECT_NEAR(value_or_throw(files.set({"corner=SS"})).models[0].values.at("vto"), 0.44, 1e-12);
    EXPECT_NEAR(value_or_throw(files.set({"corner=ss", "corner=tt"})).models[0].values.at("vto"), 0.4, 1e-12);
    EXPECT_NE(
        files.error_of({"corner=sz"}).find("--set corner=sz: no corner 'sz': library 'card.lib' has tt, ss, devices; did you mean 'ss'?"),
        std::string::npos)
        << files.error_of({"corner=sz"});
    const OverrideFiles two(
        netlist + ".include 'more.inc'\n",
        {{"card.lib", cards}, {"other.lib", ".lib usual\n.param r=1k\n.endl\n"}, {"more.inc", ".lib 'other.lib' usual\nr1 a 0 {r}\n"}});
    const auto c = value_or_throw(two.set({"corner=ss"}));
    EXPECT_NEAR(c.models[0].values.at("vto"), 0.44, 1e-12);
    EXPECT_EQ(element(c, "r1").value, 1e3) << "a library without that corner keeps its own section";
}

TEST(EmbeddedNetlists, AreTheFilesOfTheProject) {
    for (const auto& c : embedded_netlists) {
        const auto by_name = value_or_throw(CircuitAfferentFactory::create(value_or_throw(open_netlist(std::string(c.name)))));
        const auto by_path =
            value_or_throw(CircuitAfferentFactory::create(value_or_throw(Netlist::read(test::source_root() + "/" + std::string(c.file)))));
        EXPECT_EQ(by_name->fingerprint, by_path->fingerprint) << c.name;
        EXPECT_EQ(by_name->circuit->title, by_path->circuit->title);
        EXPECT_EQ(by_name->circuit->file, c.file);
    }
    EXPECT_NE(find_embedded_netlist("SA1-Circuit"), nullptr);
    EXPECT_EQ(find_embedded_netlist("sa1"), nullptr);
    const auto overrides = std::vector{make_override("sa1-circuit", "corner=ss"), make_override("sa1-circuit", "summer.N3B=8x4")};
    const auto ss = value_or_throw(test::applied_or_throw(apply_overrides("sa1-circuit", overrides)).elaborate());
    EXPECT_EQ(element(ss, "xsummer.mn3b").values.at("m"), 8);
    EXPECT_NEAR(
        ss.models[0].values.at("vto") - value_or_throw(value_or_throw(open_netlist("sa1-circuit")).elaborate()).models[0].values.at("vto"),
        0.04, 1e-12);
}

std::string spiker_text(const std::string& section, const std::string& more) {
    auto text = corpuscle::test::read_file(test::source_root() + "/circuits/spiker.cir");
    text.replace(text.find("' tt") + 2, 2, section);
    text.insert(text.find(".save"), more);
    return text;
}

std::vector<Spike> spikes_of_copy(const Netlist& netlist, std::uint32_t copy) {
    const auto afferent = value_or_throw(CircuitAfferentFactory::create(netlist))->make(1e-3, false, copy);
    std::vector<double> force(200 + static_cast<std::size_t>(afferent->delay()), 4.0);
    return corpuscle::test::spikes(*afferent, force, 4096);
}

TEST(NetlistOverrides, MismatchIsTheFirstChipOfASample) {
    for (const std::string section : {"tt", "mc"}) {
        const auto sampled = value_or_throw(parse_netlist_text(spiker_text(section, ".mc 3 seed=7\n"))),
                   plain = value_or_throw(parse_netlist_text(spiker_text(section, "")));
        auto with = [&](const Netlist& netlist) {
            ResolvedOverrides changes;
            changes.mismatch_seed = 7;
            return netlist.with_overrides(changes);
        };
        const auto chip = spikes_of_copy(sampled, 1);
        ASSERT_GT(chip.size(), 3U);
        EXPECT_EQ(spikes_of_copy(with(plain), 0), chip);
        EXPECT_EQ(spikes_of_copy(with(sampled), 0), chip) << "instead of .mc";
        EXPECT_EQ(spikes_of_copy(with(plain), 2), spikes_of_copy(sampled, 2)) << "its copies are the chips of that seed";
        EXPECT_NE(spikes_of_copy(plain, 0), chip);
        auto variants = value_or_throw(NetlistVariants::create(with(sampled)));
        EXPECT_EQ(variants.count(), 1U);
        EXPECT_FALSE(variants.has_chips());
        ASSERT_TRUE(value_or_throw(variants.at(0)).sample);
    }
}

TEST(NetlistOverrides, ADifferentNumberGivesADifferentFingerprintAlsoInAnExpression) {
    const std::string text =
        "t\n.param g=1 v0=0\niin 0 a force 1u\nr1 a 0 1k\nb1 a 0 i={g*1u*v(a)}\nc1 a 0 1n\n.ic v(a)={v0}\n.spike v(a) 1\n";
    const OverrideFiles files(text);
    const auto fingerprint = [&](const std::vector<std::string>& overrides) {
        return value_or_throw(CircuitAfferentFactory::create(std::make_shared<const Circuit>(value_or_throw(files.set(overrides)))))
            ->fingerprint;
    };
    EXPECT_EQ(fingerprint({}), fingerprint({"g=1"}));
    EXPECT_NE(fingerprint({}), fingerprint({"g=2"}));
    EXPECT_NE(fingerprint({}), fingerprint({"v0=1"}));
    EXPECT_NE(fingerprint({}), fingerprint({"r1=2k"}));
    EXPECT_NE(fingerprint({}), fingerprint({"temp=28"}));
}

TEST(ProbeNames, NodesAndCurrentsAreFoundByPartialNames) {
    const auto c =
        value_or_throw(OverrideFiles("t\n.model nm nmos (level=80)\n.subckt cell a\nmn1 a o 0 0 nm\nro o 0 1k\nco o 0 1p\n.ends\n"
                                     "xb Vf cell\nxc vf cell\nvdd vf 0 1\nr1 vf u 1\nr2 u 0 1\n.op\n")
                           .set({}));
    const auto expect_result = [&](const std::string& word, const std::string& name) {
        const auto probe = resolve_probe(c, word);
        ASSERT_TRUE(probe) << probe.error().message;
        EXPECT_EQ(probe->value_or("nothing"), name) << word;
    };
    expect_result("vf", "v(vf)"), expect_result("VF", "v(vf)"), expect_result("v(b.O)", "v(xb.o)"),
        expect_result("v(vf, xc.o)", "v(vf,xc.o)"), expect_result("i(VDD)", "i(vdd)");
    expect_result("i(c.n1)", "i(xc.mn1)"), expect_result("I(xb.ro)", "i(xb.ro)"), expect_result("V(u,0)", "v(u,0)"),
        expect_result("w", "nothing"), expect_result("i(m9)", "nothing");
    const auto refused = [&](const std::string& word, const std::string& what) {
        const auto probe = resolve_probe(c, word);
        ASSERT_FALSE(probe) << word;
        EXPECT_NE(probe.error().message.find(what), std::string::npos) << probe.error().message;
    };
    refused("o", "own.cir (xb.o, xc.o); write more of its path");
    refused("i(n1)", "xb.mn1, xc.mn1); write more of its path");
    refused("i(b.co)", "the current of xb.co cannot be recorded");
    for (const auto* wrong : {"", "v()", "i(a,b)", "v(a", "p(a)", "a b"}) refused(wrong, "write a node, v(NODE), v(NODE,NODE), i(SOURCE)");
    EXPECT_EQ(suggest_probe(c, "vg"), "; did you mean 'vf'?");
    EXPECT_EQ(suggest_probe(c, "membrane_potential"), "; there are the nodes vf, xb.o, xc.o, u") << "no name is similar";
    EXPECT_EQ(suggest_probe(c, "c.n1"), "; a device's current is i(c.n1)");
    EXPECT_EQ(split_probes("vf,v(a,b),i(N3B)"), (std::vector<std::string>{"vf", "v(a,b)", "i(N3B)"}));
}

TEST(SavedQuantity, TheCurrentOfADeviceEqualsThatOfItsSupply) {
    const auto run = run_netlist(
        "t\n.lib 'tsmc180.lib' tt\nvd d 0 0.5\nvg g 0 0.45\nm1 d g 0 0 nch w=1.5u l=0.5u m=2\nvr a 0 1\nr1 a 0 4k\n"
        ".save i(m1) i(vd) i(r1) v(d)\n.meas dc most max i(m1)\n.op\n.dc vg 0.3 0.5 0.1\n.tran 1m 2m\n");
    for (const std::string analysis : {"op", "dc", "tran"}) {
        const auto drain = run.curve("i(m1)", analysis), supply = run.curve("i(vd)", analysis);
        ASSERT_EQ(drain.size(), supply.size()) << analysis;
        for (std::size_t k = 0; k < drain.size(); ++k) {
            EXPECT_GT(drain[k], 1e-9);
            EXPECT_NEAR(drain[k], -supply[k], 1e-9 * drain[k] + 1e-14) << analysis;
            EXPECT_NEAR(run.curve("i(r1)", analysis)[k], 0.25e-3, 1e-12);
        }
    }
    EXPECT_EQ(run.number("most"), run.curve("i(m1)", "dc").back());
}

TEST(Elements, TheTableInTheManualListsEachKindAndItsParameters) {
    std::string table = "| letter | element | values that `--set` changes |\n| --- | --- | --- |\n";
    for (const auto* kind : device_kinds) {
        std::vector<std::string> values;
        for (const auto& p : kind->parameters) values.push_back(p.name.empty() ? "the gain" : fmt::format("`{}`", p.name));
        table += fmt::format("| {} | {} | {} |\n", static_cast<char>(kind->letter - 'a' + 'A'), kind->description, fmt::join(values, " "));
    }
    EXPECT_NE(corpuscle::test::read_file(corpuscle::test::source_root() + "/doc/circuits.md").find(table), std::string::npos) << table;
}

}  // namespace
}  // namespace corpuscle::circuit
