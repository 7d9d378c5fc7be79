// `corpuscle export --card`: kits with the names of SKY130 and GF180MCU, made up here, run from any folder; and bad input.

#include <sys/stat.h>

#include <cmath>

#include "support/ngspice.hpp"
#include "support/program.hpp"

namespace corpuscle::circuit::test {
namespace {

using corpuscle::test::run_program;

constexpr const char* inverter = R"(an inverter
.lib 'own.lib' tt
vdd vdd 0 0.7
vin in 0 0.35
mp out in vdd vdd pch w=6u l=0.5u m=2 stack=2
mn out in 0 0 nch w=1.5u l=0.5u m=2 stack=2
mh vdd in q 0 nch_hv w=1.5u l=0.5u m=4
vq q 0 0
.op
.print op v(out) i(vq)
.end
)";
constexpr const char* own_library = R"(* a library of the netlist
.lib tt
.model nch nmos (level=80 vto=0.45)
.model nch_hv nmos (level=80 vto=0.6)
.model pch pmos (level=80 vto=0.45 isq=28n)
.endl tt
.lib ss
.model nch nmos (level=80 vto=0.5)
.model nch_hv nmos (level=80 vto=0.65)
.model pch pmos (level=80 vto=0.5 isq=28n)
.endl ss
)";

/// A stub with the names, units, corners and switches of SKY130. All numbers are made up.
constexpr const char* sky130 = R"(* stub
.lib tt
.param mc_mm_switch=0 stub_shift=0
.include 'devices.spice'
.endl tt
.lib ss
.param mc_mm_switch=0 stub_shift=0.05
.include 'devices.spice'
.endl ss
.lib tt_mm
.param mc_mm_switch=1 stub_shift=0
.include 'devices.spice'
.endl tt_mm
)";
constexpr const char* sky130_devices = R"(* stub
.option scale=1.0u
.subckt sky130_fd_pr__nfet_01v8 d g s b l=1 w=1 ad=0 as=0 pd=0 ps=0 mult=1
.param swx_vth={mc_mm_switch*agauss(0,1,1)*5e-3/sqrt(l*w*mult)}
m0 d g s b stub_n l={l} w={w} ad={ad} as={as} pd={pd} ps={ps} delvto={swx_vth+stub_shift}
.ends
.subckt sky130_fd_pr__pfet_01v8 d g s b l=1 w=1 ad=0 as=0 pd=0 ps=0 mult=1
m0 d g s b stub_p l={l} w={w} ad={ad} as={as} pd={pd} ps={ps} delvto={-stub_shift}
.ends
.model stub_n nmos (level=8 version=3.3.0 vth0=0.45 tox=4n u0=350)
.model stub_p pmos (level=8 version=3.3.0 vth0=-0.45 tox=4n u0=90)
)";

/// The same for GF180MCU.
constexpr const char* gf180 = R"(* stub
.lib typical
.param stub_shift=0
.lib 'sm141064.ngspice' fets
.endl typical
.lib ss
.param stub_shift=0.05
.lib 'sm141064.ngspice' fets
.endl ss
.lib fets
.subckt nfet_03v3 d g s b w=1e-5 l=2.8e-7 as=0 ad=0 ps=0 pd=0
.param mis_vth=agauss(0,2m,1)
m0 d g s b stub_n w=w l=l as=as ad=ad ps=ps pd=pd delvto='mis_vth*sw_stat_mismatch+stub_shift'
.ends
.subckt pfet_03v3 d g s b w=1e-5 l=2.8e-7 as=0 ad=0 ps=0 pd=0
m0 d g s b stub_p w=w l=l as=as ad=ad ps=ps pd=pd delvto='-stub_shift'
.ends
.model stub_n nmos (level=8 version=3.3.0 vth0=0.45 tox=4n u0=350)
.model stub_p pmos (level=8 version=3.3.0 vth0=-0.45 tox=4n u0=90)
.endl fets
)";

/// A folder with the netlist, and a kit in two folders of its own. The name of one has a space, which ngspice refuses in a .lib.
struct Folders : TemporaryFolder {
    Folders() {
        for (const char* name : {"kit of ours", "kit", "decks", "elsewhere"}) std::filesystem::create_directory(*this / name);
        write("own.cir", inverter), write("own.lib", own_library);
        write("kit/sky130.lib.spice", sky130), write("kit/devices.spice", sky130_devices);
        write("kit/sm141064.ngspice", gf180), write("kit/design.ngspice", "* stub\n.param sw_stat_mismatch=0\n");
        const std::string devices = sky130_devices;
        write("kit of ours/plain.lib", "* the models alone\n" + devices.substr(devices.find(".model")));
    }
    /// Exports with these options and returns v(out) and i(vq) at the operating point that ngspice finds, from another folder.
    std::pair<double, double> run(const std::string& options) const {
        const auto exported = run_program(*this, "export own.cir --for ngspice --quiet --overwrite -o decks/deck.cir " + options);
        EXPECT_EQ(exported.status, 0) << exported.err;
        const auto log = run_ngspice("../decks/deck.cir", *this / "deck.raw", *this / "elsewhere");
        std::map<std::string, double> values;
        for (const auto& plot : read_raw_file(*this / "deck.raw"))
            for (const auto& c : plot.curves) values[corpuscle_name(c.name)] = c.values.at(0).real();
        std::filesystem::remove(*this / "deck.raw");
        EXPECT_TRUE(values.contains("v(out)") && values.contains("i(vq)")) << log << read_file(*this / "decks/deck.cir");
        return {values["v(out)"], values["i(vq)"]};
    }
};

TEST(KitProgram, AStubWithTheNamesOfSky130RunsFromAnyFolderWithItsUnitsCornersAndMismatch) {
    const Folders folder;
    const std::string kit = "--map sky130 --card kit/sky130.lib.spice ";
    auto typical = folder.run(kit);
    const auto deck = read_file(folder / "decks/deck.cir");
    EXPECT_NE(deck.find(".lib '../kit/sky130.lib.spice' tt\n"), std::string::npos) << deck;
    EXPECT_NE(deck.find("x1 d g n1 b sky130_fd_pr__nfet_01v8 w=1.5 l=0.5 mult=2 m=2 ad=0.75 as=0.375 "), std::string::npos) << deck;
    EXPECT_NE(deck.find("vt g gate 0.15\nx1 d gate s b sky130_fd_pr__nfet_01v8 w=1.5 l=0.5 mult=4 m=4 "), std::string::npos) << deck;
    // The same devices as plain models: sizes in micrometres there mean the same sizes.
    const auto plain = folder.run("--map plain --card 'kit of ours/plain.lib' --nch stub_n --pch stub_p");
    EXPECT_NEAR(typical.first, plain.first, 1e-7);
    EXPECT_NEAR(typical.second, plain.second, 1e-5 * std::abs(plain.second));
    const auto slow = folder.run(kit + "--set own.cir.corner=ss");
    EXPECT_LT(slow.second, 0.4 * typical.second) << "50 mV more threshold";
    const auto one = folder.run(kit + "--set own.cir.mismatch=1"), again = folder.run(kit + "--set own.cir.mismatch=1"),
               two = folder.run(kit + "--set own.cir.mismatch=2");
    EXPECT_NE(read_file(folder / "decks/deck.cir").find("sky130.lib.spice' tt_mm\n"), std::string::npos);
    EXPECT_EQ(one, again);
    EXPECT_NE(one.second, two.second);
    EXPECT_NE(one.second, typical.second);
}

TEST(KitProgram, AStubWithTheNamesOfGf180RunsWithItsCornersAndSwitch) {
    const Folders folder;
    const std::string kit = "--map gf180 --card kit/sm141064.ngspice ";
    const auto typical = folder.run(kit);
    const auto deck = read_file(folder / "decks/deck.cir");
    EXPECT_NE(deck.find(".include '../kit/design.ngspice'\n.lib '../kit/sm141064.ngspice' typical\n"), std::string::npos) << deck;
    EXPECT_NE(deck.find("x1 d g n1 b nfet_03v3 w=1.5e-06 l=5e-07 m=2 ad=7.5e-13 "), std::string::npos) << deck;
    const auto plain = folder.run("--map plain --card 'kit of ours/plain.lib' --nch stub_n --pch stub_p");
    EXPECT_NEAR(typical.first, plain.first, 1e-7);
    EXPECT_NEAR(typical.second, plain.second, 1e-5 * std::abs(plain.second));
    EXPECT_LT(folder.run(kit + "--set own.cir.corner=ss").second, 0.4 * typical.second);
    const auto one = folder.run(kit + "--set own.cir.mismatch=1"), two = folder.run(kit + "--set own.cir.mismatch=2");
    EXPECT_NE(one.second, two.second);
    EXPECT_NE(one.second, typical.second);
}

TEST(KitProgram, AMapOfTheUserNamesDevicesLinesAndUnits) {
    const Folders folder;
    folder.write("kit of ours/kit.toml",
                 "length_unit = \"um\"\nthreshold = \"delvto\"\nlines = [\".include '{card}'\", \".option scale=1.0u\"]\nlast_lines = [\"* "
                 "the end\"]\n"
                 "[devices]\nnch = \"stub_n\"\npch = \"stub_p\"\n");
    const auto mapped = folder.run("--map 'kit of ours/kit.toml' --card 'kit of ours/plain.lib'");
    const auto deck = read_file(folder / "decks/deck.cir");
    EXPECT_NE(deck.find("stub_n w=1.5 l=0.5 m=4 delvto=0.15 ad=0.75 as=0.75 pd=4 ps=4\n"), std::string::npos) << deck;
    EXPECT_NE(deck.find("\n* the end\n"), std::string::npos) << deck;
    const auto plain = folder.run("--map bsim --card 'kit of ours/plain.lib' --nch stub_n --pch stub_p");
    EXPECT_NEAR(mapped.second, plain.second, 1e-6 * std::abs(plain.second));
}

TEST(KitProgram, WithoutAFileForTheDeckThePathOfTheKitIsAbsolute) {
    const Folders folder;
    const auto shown =
        run_program(folder, "export own.cir --for ngspice --quiet --map bsim --card 'kit of ours/plain.lib' --nch stub_n --pch stub_p");
    ASSERT_EQ(shown.status, 0) << shown.err;
    EXPECT_NE(shown.out.find("\n.include '" + std::filesystem::weakly_canonical(folder.path()).string() + "/kit of ours/plain.lib'\n"),
              std::string::npos)
        << shown.out;
}

TEST(KitProgram, BadInputIsAnErrorAndNothingIsWritten) {
    const Folders folder;
    folder.write("quote's.lib", ".model stub_n nmos(level=1)\n.model stub_p pmos(level=1)\n");
    folder.write("kit of ours/sky130.lib.spice", sky130);
    folder.write("wrong.toml", "instance = \"M\"\nlength_unit = \"stone\"\n");
    folder.write("huge.toml", std::string(2000000, '#'));
    folder.write("zero.toml", std::string("a = \"\0\"\n", 9));
    folder.write("r.cir", "no transistor\nv1 a 0 1\nr1 a 0 1k\n.op\n");
    folder.write("semi;colon.lib", ".model stub_n nmos(level=1)\n.model stub_p pmos(level=1)\n");
    folder.write("loop.lib", "* a kit\n.include loop.lib\n");
    folder.write("binary.lib", std::string("\0\x7f\xff\n\0", 5));
    ASSERT_EQ(::mkfifo((folder / "pipe.lib").c_str(), 0600), 0);
    const auto before = folder.file_names();
    const std::string good = "--map bsim --card 'kit of ours/plain.lib' ", names = "--nch stub_n --pch stub_p";
    for (const auto& [arguments, status, message] : std::vector<std::tuple<std::string, int, std::string>>{
             {"own.cir --for ngspice --nch stub_n", 2, "--nch needs --card FILE"},
             {"own.cir --for ngspice --map sky130", 2, "--map needs --card FILE"},
             {"sa1 --for brian2 --card a.lib", 2, "--card is for --for ngspice"},
             {"own.cir --for ngspice --card missing.lib " + names, 1, "missing.lib: cannot be read: there is no such file"},
             {"own.cir --for ngspice --card 'kit of ours' " + names, 1, "kit of ours: this is a directory, not a file of a kit (--card)"},
             {"own.cir --for ngspice --card \"quote's.lib\" " + names, 1, "ngspice reads no path with a quote"},
             {"own.cir --for ngspice --card 'semi;colon.lib' " + names, 1, "ngspice reads no path with a quote, a brace, ';'"},
             {"own.cir --for ngspice --card loop.lib " + names, 1, "loop.lib:2: this line includes loop.lib"},
             {"own.cir --for ngspice --card binary.lib " + names, 1, "it has no .model stub_n; it has none at all"},
             {"own.cir --for ngspice --card pipe.lib " + names, 1, "pipe.lib: ngspice reads the file of a kit (--card) again"},
             {"own.cir --for ngspice " + good + "--nch stub_p --pch stub_n", 1,
              ".model stub_p is pmos, but the device for nch must be nmos"},
             {"own.cir --for ngspice --card 'kit of ours/plain.lib' --map missing.toml", 1,
              "missing.toml: cannot be read: there is no such file; the built-in maps are bsim"},
             {"own.cir --for ngspice --card 'kit of ours/plain.lib' --map 'kit of ours'", 1,
              "kit of ours: this is a directory, not a map of a kit (--map)"},
             {"own.cir --for ngspice --card 'kit of ours/plain.lib' --map wrong.toml", 1, "wrong.toml:2:15: length_unit = 'stone'"},
             {"own.cir --for ngspice --card 'kit of ours/plain.lib' --map huge.toml", 1,
              "huge.toml: not a map of a kit (--map): it is larger than 1 MB"},
             {"own.cir --for ngspice --card 'kit of ours/plain.lib' --map zero.toml", 1, "zero.toml:1:"},
             {"own.cir --for ngspice " + good + "--nch 'stub n' --pch stub_p", 1, "--nch: 'stub n' is not a name of ngspice"},
             {"own.cir --for ngspice " + good + "--nch \"$(printf 'a\\nb')\" --pch stub_p", 1, "is not a name of ngspice"},
             {"own.cir --for ngspice " + good + "--nch stub_q --pch stub_p", 1, "it has no .model stub_q; it has stub_n, stub_p"},
             {"own.cir --for ngspice " + good + "--nch stub_n", 1, "the kit has no device for pmos; name it: --pch NAME"},
             {"own.cir --for ngspice " + good + names + " --set own.cir.corner=ss", 1, "corner=ss: the map 'bsim' has no corners"},
             {"own.cir --for ngspice " + good + names + " --set own.cir.mismatch=1", 1, "the map 'bsim' has no mismatch_lines"},
             {"own.cir --for ngspice --map sky130 --card 'kit of ours/sky130.lib.spice'", 1,
              "ngspice reads no .lib whose path has a space"},
             {"r.cir --for ngspice " + good + names, 1, "r.cir has no transistors of level 80"}}) {
        const auto ran = run_program(folder, "export " + arguments + " -o out.cir");
        EXPECT_EQ(ran.status, status) << arguments << ran.err;
        EXPECT_NE(ran.err.find(message), std::string::npos) << arguments << "\n" << ran.err;
        EXPECT_EQ(folder.file_names(), before) << arguments;
    }
}

TEST(KitProgram, ADeckNeverReplacesTheFileOfTheKitNorItsMap) {
    const Folders folder;
    folder.write("kit.toml", "threshold = \"delvto\"\n");
    for (const char* out : {"kit of ours/plain.lib", "kit.toml"}) {
        const auto text = read_file(folder / out);
        const auto ran = run_program(folder,
                                     "export own.cir --for ngspice --map kit.toml --card 'kit of ours/plain.lib' --nch stub_n --pch stub_p "
                                     "--overwrite -o '" +
                                         std::string(out) + "'");
        EXPECT_EQ(ran.status, 2) << ran.err;
        EXPECT_EQ(read_file(folder / out), text);
    }
}

}  // namespace
}  // namespace corpuscle::circuit::test
