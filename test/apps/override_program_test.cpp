// Every kind of override in every verb: it changes the result, or an error names it, or the table says why it does neither.

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "support/program.hpp"

namespace corpuscle {
namespace {

using test::run_program;
using test::TemporaryFolder;

/// A divider with a process corner, a transistor for mismatch, and a resistance that depends on temperature.
constexpr const char* netlist_text =
    "divider\n.lib 'process.lib' tt\n.param supply=1 r_top=1k\nvdd vdd 0 {supply}\nxdiv vdd mid half\niin 0 mid force 1m\n"
    "rload mid 0 {10*r_corner}\nmn1 mid vdd 0 0 nm w=1u l=1u\n.model nm nmos (level=80 vto=0.4 avt=50n)\n"
    ".subckt half a b\nrtop a b {r_top} tc1=5m\nrlow b 0 1k\nclow b 0 1u\n.ends\n.spike v(mid) 0.6\n.save v(mid)\n.op\n";
constexpr const char* process_text = ".lib tt\n.param r_corner=1k\n.endl\n.lib ss\n.param r_corner=2k\n.endl\n";
constexpr const char* skin_text =
    "[sites]\nrows = 1\ncolumns = 1\npitch = \"1 mm\"\n[[class]]\nafferent = \"sa1\"\nper_site = 1\n[[class]]\nname = \"slow\"\nafferent = "
    "\"sa1\"\nper_site = 1\n";

/// The verbs that take overrides. `skin` is respond --population.
enum class Verb { respond, skin, run, sweep, stream };
constexpr Verb verbs[] = {Verb::respond, Verb::skin, Verb::run, Verb::sweep, Verb::stream};
constexpr const char* verb_names[] = {"respond", "respond --population", "run", "sweep", "stream"};
constexpr const char* name_of(Verb verb) { return verb_names[static_cast<std::size_t>(verb)]; }

/// One kind of override.
struct OverrideKind {
    std::string name;                    ///< for messages
    std::string afferent;                ///< of respond, sweep and stream; run always has the netlist own.cir, and a skin is skin.toml
    std::string target, setting;         ///< "sa1", "f_B=60Hz"; run and sweeps of a netlist take the setting without the target
    std::set<Verb> works;                ///< the verbs in which it changes the result; in all others an error must contain `named`
    std::string named;                   ///< part of the setting, or the name of what it is for
    std::string options = {};            ///< options of the command line that say the same instead of --set: "--temp 85"
    std::string other_options = {};      ///< of respond, with and without the override: "--copies 2"
    std::string stream_population = {};  ///< of stream, if not the afferent
};

/// Cells in which an override neither changes the result nor is refused, with the reason.
const std::map<std::pair<std::string, Verb>, std::string> exceptions = {
    {{"spread", Verb::sweep}, "a sweep file varies parameters by [[vary]]; it has no key for --spread"},
};

std::vector<OverrideKind> override_kinds() {
    const std::set<Verb> front_ends = {Verb::respond, Verb::sweep}, netlists = {Verb::respond, Verb::run, Verb::sweep},
                         every_model = {Verb::respond, Verb::skin, Verb::sweep, Verb::stream};
    return {{"parameter of a model", "sa1", "sa1", "f_B=60Hz", every_model, "f_B"},
            {"parameter of a sensor", "fsr+f2i+sa1", "fsr+f2i+sa1", "F_cal=2N", front_ends, "fsr+f2i+sa1"},
            {"parameter of a converter", "sa1-kim", "sa1-kim", "bits=4", front_ends, "sa1-kim"},
            {"parameter of a stimulus", "sa1", "press", "F_max=3N", every_model, "press"},
            {"parameter of a class of a skin", "sa1", "slow", "V_th=300mV", {Verb::skin, Verb::stream}, "slow", {}, {}, "skin.toml"},
            {".param of a netlist", "own.cir", "own.cir", "r_top=2k", netlists, "own.cir"},
            {"value of a device", "own.cir", "own.cir", "div.rlow=2k", netlists, "own.cir"},
            {"temperature", "own.cir", "", "temp=85", netlists, "--temp", "--temp 85"},
            {"supply", "own.cir", "", "supply=1.2", netlists, "--supply", "--supply 1.2"},
            {"corner", "own.cir", "", "corner=ss", netlists, "--corner", "--corner ss"},
            {"mismatch", "own.cir", "", "mismatch=7", netlists, "--mismatch", "--mismatch 7"},
            {"spread", "sa1", "", "", {Verb::respond}, "--spread", "--spread sa1.f_B=10%", "--copies 2"},
            {"unknown target", "sa1", "sa9", "f_B=60Hz", {}, "sa9"},
            {"unknown parameter", "sa1", "sa1", "f_Q=60Hz", {}, "f_Q"},
            {"unknown device", "own.cir", "own.cir", "div.rtp=2k", {}, "own.cir"},
            {"value with a wrong unit", "sa1", "sa1", "f_B=25ms", {}, "f_B"},
            {"value outside its range", "sa1", "sa1", "f_B=-1Hz", {}, "f_B"}};
}

/// Runs a verb, with the override or without it, and returns what it computes: spikes or curves.
struct Outcome {
    int status;
    std::string result, err;
};

class OverrideRuns {
    TemporaryFolder folder_;

    std::string sweep_file(const OverrideKind& kind, bool with) const {
        const auto equals = kind.setting.find('=');
        const bool has_own_target = kind.target != kind.afferent && kind.target != "";
        const auto set = with ? "[set]\n\"" + (has_own_target ? kind.target + "." : "") + kind.setting.substr(0, equals) + "\" = \"" +
                                    kind.setting.substr(equals + 1) + "\"\n"
                              : "";
        return "afferent = \"" + kind.afferent + "\"\nforce = \"press\"\nsamples = 1\nmeasures = [\"spikes\", \"first_spike\"]\n" + set +
               "[[vary]]\nwhat = \"press.t_post\"\nlist = [\"100ms\"]\n";
    }
    std::string words(const OverrideKind& kind, Verb verb, bool with) const {
        const auto general = !kind.options.empty() ? kind.options : "--set '" + kind.target + "." + kind.setting + "'";
        const bool is_own = kind.target == kind.afferent && kind.afferent == "own.cir";
        const auto given = !with ? "" : verb == Verb::run && is_own ? "--set '" + kind.setting + "'" : general;
        switch (verb) {
            case Verb::respond:
                return "respond press --quiet --json -a '" + kind.afferent + "' " + kind.other_options + " " + given;
            case Verb::skin:
                return "respond press --quiet --json --population skin.toml " + given;
            case Verb::run:
                return "run own.cir --json " + given;
            case Verb::sweep:
                return "sweep " + folder_.write("a.toml", sweep_file(kind, with)) + " --quiet -o a.sqlite";
            default:
                return "stream --in press --pace fast --quiet -o - --population '" +
                       (kind.stream_population.empty() ? kind.afferent : kind.stream_population) + "' " + given;
        }
    }

public:
    OverrideRuns() {
        folder_.write("own.cir", netlist_text), folder_.write("process.lib", process_text), folder_.write("skin.toml", skin_text);
    }
    Outcome run(const OverrideKind& kind, Verb verb, bool with) const {
        std::filesystem::remove(folder_ / "a.sqlite");
        const auto ran = run_program(folder_, words(kind, verb, with));
        if (ran.status != 0 || verb == Verb::stream) return {ran.status, ran.out, ran.err};
        if (verb == Verb::sweep) return {0, run_program(folder_, "sweep dump a.sqlite").out, ran.err};
        return {0, nlohmann::json::parse(ran.out)[verb == Verb::run ? "plots" : "spikes"].dump(), ran.err};
    }
};

TEST(OverrideTable, EveryKindInEveryVerbChangesTheResultOrIsNamedInAnError) {
    const OverrideRuns runs;
    std::set<std::pair<std::string, Verb>> excused;
    for (const auto& kind : override_kinds())
        for (const auto verb : verbs) {
            SCOPED_TRACE(kind.name + " in " + name_of(verb));
            if (exceptions.contains({kind.name, verb})) {
                excused.insert({kind.name, verb});
                continue;
            }
            const auto with = runs.run(kind, verb, true);
            if (!kind.works.contains(verb)) {
                EXPECT_TRUE(with.status == 1 || with.status == 2) << with.status;
                EXPECT_NE(with.err.find(kind.named), std::string::npos) << with.err;
                continue;
            }
            const auto without = runs.run(kind, verb, false);
            ASSERT_EQ(without.status, 0) << without.err;
            EXPECT_EQ(with.status, 0) << with.err;
            EXPECT_NE(with.result, without.result) << "the override has no effect";
        }
    EXPECT_EQ(excused.size(), exceptions.size()) << "an exception has no cell";
}

TEST(OverrideTable, AnUnusedOverrideHasOneErrorInAllVerbs) {
    const OverrideRuns runs;
    const OverrideKind unknown = {"unknown target", "sa1", "sa9", "f_B=60Hz", {}, "sa9"};
    const std::string message = "sa9.f_B=60Hz: nothing here is named 'sa9'; did you mean 'sa1'? (parameters of ";
    for (const auto verb : {Verb::respond, Verb::skin, Verb::stream, Verb::sweep}) {
        const auto err = runs.run(unknown, verb, true).err;
        EXPECT_NE(err.find((verb == Verb::sweep ? "a.toml:6:13: " : "--set ") + message), std::string::npos)
            << name_of(verb) << ": " << err;
    }
    const OverrideKind unknown_spread = {"spread", "sa1", "", "", {}, "sa9", "--spread sa9.f_B=10%", "--copies 2"};
    EXPECT_NE(
        runs.run(unknown_spread, Verb::respond, true).err.find("--spread sa9.f_B=10%: nothing here is named 'sa9'; did you mean 'sa1'?"),
        std::string::npos);
}

}  // namespace
}  // namespace corpuscle
