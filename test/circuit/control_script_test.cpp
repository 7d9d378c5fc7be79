// Scripts of ngspice between .control and .endc: what they compute is computed, all else is named in a warning.

#include <unistd.h>

#include <fmt/format.h>
#include <filesystem>

#include "netlist_runner.hpp"

namespace corpuscle::circuit {
namespace {

const std::string deck = "script\nv1 in 0 dc 1 ac 1 pulse(0 1 0 1n 1n 5m 10m)\nr1 in out 1k\nc1 out 0 1u\n";

NetlistRun run_script(const std::string& commands) { return run_netlist(deck + ".control\n" + commands + ".endc\n.end\n"); }

std::string warnings_of(const std::string& commands) {
    std::string out;
    const auto run = run_script(commands);
    for (const auto& w : run.warnings()) out += w.text() + "\n";
    return out;
}

std::string table_of(const NetlistRun& run, std::size_t analysis) { return run.analyses().at(analysis).printed_tables; }

TEST(ControlScript, MeasuresAndPrintsBelongToTheAnalysisBeforeThem) {
    const auto run = run_script(
        "tran 10u 1m\nmeas tran first max v(out)\ntran 10u 2m\nmeas tran second max v(out)\nop\nprint v(in)\nop\nprint v(out) v(in)\n");
    EXPECT_NEAR(run.number("first"), 1 - std::exp(-1.0), 1e-4);
    EXPECT_NEAR(run.number("second"), 1 - std::exp(-2.0), 1e-4);
    ASSERT_EQ(run.analyses().size(), 4U);
    EXPECT_EQ(table_of(run, 0) + table_of(run, 1), "");
    EXPECT_EQ(table_of(run, 2).find("v(out)"), std::string::npos);
    EXPECT_NE(table_of(run, 3).find("v(out)"), std::string::npos);
}

TEST(ControlScript, APrintBelongsToTheDirectiveThatRepeatsItsAnalysis) {
    const auto run = run_netlist(deck + ".op\n.op\n.tran 10u 1m\n.control\ntran 10u 1m\nmeas tran top max v(out)\nprint v(out)\n.endc\n");
    ASSERT_EQ(run.analyses().size(), 3U);
    EXPECT_NEAR(run.number("top"), 1 - std::exp(-1.0), 1e-4);
    EXPECT_NE(table_of(run, 2), "");
}

TEST(ControlScript, VectorsAreExpressionsOfCurves) {
    const auto run = run_script(
        "let gain = 2*5\ntran 10u 1m\nlet p = v(in) * -v1#branch\nlet twice = 2 * p\nmeas tran top max twice\nlet scaled = top * gain\n"
        "print scaled gain\nac dec 1 159.15494309 1k\nlet level = db(out) + 1\nmeas ac at find level at=159.15494309\n"
        "let z = log(100)\nprint z\n");
    EXPECT_NEAR(run.number("top"), 2e-3, 1e-6);
    EXPECT_NEAR(run.number("scaled"), 2e-2, 1e-5);
    EXPECT_EQ(run.number("gain"), 10);
    EXPECT_NEAR(run.number("at"), 1 - 10 * std::log10(2), 1e-6);
    EXPECT_EQ(run.number("z"), 2);
}

TEST(ControlScript, VariablesAndContinuationsAreReplaced) {
    const auto run = run_script("set stop = 2m\nlet from = 1m\ntran 10u\n+ $stop\nmeas tran m find v(out) at=$&from\n");
    EXPECT_NEAR(run.number("m"), 1 - std::exp(-1.0), 1e-4);
    EXPECT_NEAR(run.curve("time", "tran").back(), 2e-3, 1e-12);
}

TEST(ControlScript, AVectorThatIsNotAvailableIsLeftOutWithTheReason) {
    const std::string warnings = warnings_of(
        "tran 10u 1m\nlet n = length(v(out))\nprint n\nlet x = v(out)[3]\nlet y = v(out)^3\nlet ok = v(out)^2\nprint ok\nfft v(out)\n"
        "print v(out)\nmeas tran m max n\nac dec 1 1 10\nprint ok\n");
    for (const char* text :
         {"7:1: .control: let n is left out: unknown function 'length'", "8:1: .control: print n is left out: 'n' is not available",
          "9:1: .control: let x is left out: elements of a vector are not available",
          "10:1: .control: let y is left out: '^' takes the magnitude", "13:1: .control: 'fft' has no effect here: .four",
          "14:1: .control: print v(out) is left out: the curves of the current plot",
          "15:1: .control: .meas m is left out: 'n' is not available", "17:1: .control: print ok is left out: 'ok' is not available"})
        EXPECT_NE(warnings.find(text), std::string::npos) << text << "\n" << warnings;
    EXPECT_EQ(warnings.find("11:1"), std::string::npos) << "an even power is that of the magnitude";
}

TEST(ControlScript, ConditionsWithoutAnAnalysisAreSkippedAndOthersEndIt) {
    const auto skipped = run_script("op\nif v(out) > 2\nlet bad = 1\nif 1\necho no\nend\nelse\nquit 1\nend\nac dec 1 1 10\nprint bad\n");
    ASSERT_EQ(skipped.analyses().size(), 2U);
    const auto ended = run_script("op\nforeach r 1k 2k\nalter r1 $r\nop\nend\nac dec 1 1 10\n");
    EXPECT_EQ(ended.analyses().size(), 1U);
    EXPECT_NE(warnings_of("op\nforeach r 1k 2k\nop\nend\nac dec 1 1 10\n").find("9:1: .control: 'op' is not supported; the rest of this"),
              std::string::npos);
    EXPECT_EQ(run_script("op\nquit\nac dec 1 1 10\n").analyses().size(), 1U);
    const auto hot = warnings_of("op\nset temp=85\nop\n");
    EXPECT_NE(hot.find("7:1: .control: 'set temp' is not supported; the rest of this script is not run; write it as .options"),
              std::string::npos)
        << hot;
}

TEST(ControlScript, UnknownCommandsAndTheirLinesAreNamed) {
    const auto warnings = warnings_of("op\nplto v(out)\nfrobnicate\n");
    EXPECT_NE(warnings.find("7:1: .control: 'plto' has no effect here: it is unknown; did you mean 'plot'?"), std::string::npos)
        << warnings;
    EXPECT_NE(warnings.find("8:1: .control: 'frobnicate' has no effect here: it is unknown"), std::string::npos) << warnings;
}

TEST(ControlScript, IsClosedByTheEndOfTheNetlist) {
    const auto run = run_netlist(deck + ".ac dec 1 1 10\n.control\nrun\nplot v(out)\n.end\nnot a statement\n");
    EXPECT_EQ(run.analyses().size(), 1U);
    EXPECT_FALSE(parse_netlist_text(deck + ".control\nop\n"));
}

TEST(ControlScript, WritesNoFileAndStartsNoProgram) {
    namespace fs = std::filesystem;
    const auto folder = fs::temp_directory_path() / fmt::format("corpuscle-script-{}", getpid());
    fs::create_directories(folder / "inside");
    const auto outside = (folder / "outside.raw").string();
    const auto run = run_script("op\nwrite " + outside + " v(out)\nwrite ../outside.raw\nwrdata " + outside + " v(out)\nprint v(out) > " +
                                outside + "\nmeas op m find v(out) > " + outside + "\nshell touch " + outside + "\nhardcopy " + outside +
                                " v(out)\nset x=`touch " + outside + "`\n");
    EXPECT_EQ(run.analyses().size(), 1U);
    EXPECT_TRUE(fs::is_empty(folder / "inside"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1) << "only the folder 'inside'";
    fs::remove_all(folder);
}

TEST(ControlScript, OfManyReplacementsStaysSmall) {
    std::string commands = "let a = v(out)+v(in)\n";
    for (int k = 0; k < 60; ++k) commands += "let a = a+a\n";
    EXPECT_NE(warnings_of("op\n" + commands + "print a\n").find("it is longer than 10000 characters"), std::string::npos);
    std::string variables = "set a = xxxxxxxxxx\n";
    for (int k = 0; k < 60; ++k) variables += "set a = $a$a\n";
    EXPECT_EQ(run_script("op\n" + variables).analyses().size(), 1U);
}

TEST(ControlScript, AMeasureOfAnAnalysisThatIsLeftOutIsLeftOut) {
    const std::string commands = "tran 10u 1m\nmeas tran first max v(out)\nlet n = 5\nif 1\nlet n = 7\nend\ntran 10u $&n\n";
    const auto warnings = warnings_of(commands + "meas tran second max v(out)\nfourier 1k v(out)\nprint v(out)\n");
    for (const char* text :
         {"12:1: .control: tran 10u $&n is left out: it depends on a variable", "13:1: .control: .meas second is left out: the tran before",
          "14:1: .control: fourier is left out: the tran before it", "15:1: .control: print v(out) is left out: the curves of the current"})
        EXPECT_NE(warnings.find(text), std::string::npos) << text << "\n" << warnings;
    const auto run = run_script(commands + "ac dec 1 1 10\nmeas ac other max vm(out)\ntran 10u 2m\nmeas tran third max v(out)\n");
    EXPECT_NEAR(run.number("first"), 1 - std::exp(-1.0), 1e-4);
    EXPECT_NEAR(run.number("third"), 1 - std::exp(-2.0), 1e-4);
    EXPECT_GT(run.number("other"), 0.9);
}

TEST(ControlScript, SetplotSelectsAnAnalysisByItsNumber) {
    const auto run = run_script("op\ntran 10u 1m\ntran 10u 2m\nac dec 1 1 10\nsetplot tran2\nprint v(out)\nsetplot op1\nprint v(in)\n");
    ASSERT_EQ(run.analyses().size(), 4U);
    EXPECT_NE(table_of(run, 0), "");
    EXPECT_EQ(table_of(run, 1), "");
    EXPECT_NE(table_of(run, 2), "");
    for (const std::string commands : {"tran 10u 1m\nsetplot tran2\n", "run\ntran 10u 1m\nsetplot tran1\n", "tran 10u 1m\nsetplot tranx\n"})
        EXPECT_NE(warnings_of(commands + "print v(out)\n").find("does not name an analysis of this script"), std::string::npos) << commands;
}

TEST(ControlScript, AnAnalysisIsRunOnceIfADirectiveThatHoldsHasTheSameWords) {
    const std::string script = ".control\ntran 10u 1m\nprint v(out)\n.endc\n";
    EXPECT_EQ(run_netlist(deck + ".tran 10u  1m\n" + script).analyses().size(), 1U) << "blanks do not matter";
    const auto run = run_netlist(deck + ".param x=0\n.if (x)\n.tran 10u 1m\n.endif\n" + script);
    ASSERT_EQ(run.analyses().size(), 1U) << "the directive does not hold";
    EXPECT_NE(table_of(run, 0), "");
}

TEST(ControlScript, CommandsOfASkippedBlockMakeUnknownWhatTheyWouldChange) {
    const auto run = run_script("set n=1m k=2m\ntran 10u $n\nif 1\nset n = 3m\nend\ntran 10u $n\ntran 10u $k\n");
    EXPECT_EQ(run.analyses().size(), 2U) << "the value of n is unknown";
    for (const std::string command : {"set temp = 85", "quit", "op", "alter r1 2k"})
        EXPECT_EQ(run_script("op\nif 1\n" + command + "\nend\nac dec 1 1 10\n").analyses().size(), 1U) << command;
    for (const std::string command : {"setplot op1", "fft v(out)"})
        EXPECT_NE(warnings_of("op\nif 1\n" + command + "\nend\nprint v(out)\n").find("print v(out) is left out"), std::string::npos);
    const auto warnings = warnings_of("op\nif 1\necho a\nend\nif 1\necho b\nend\n");
    EXPECT_NE(warnings.find("7:1: .control: the commands of this 'if' up to 'end' are skipped (and 1 more); write those of one branch"),
              std::string::npos)
        << warnings;
    EXPECT_NE(
        warnings_of("op\nforeach r 1k 2k\nop\n").find("7:1: .control: 'foreach' is not closed by 'end'; the commands after it are not"),
        std::string::npos);
}

TEST(ControlScript, NoScriptRunsAfterOneThatWasStopped) {
    const auto run = run_netlist(deck + ".control\nop\nalter r1 2k\nop\n.endc\n.control\ntran 10u 1m\n.endc\n");
    EXPECT_EQ(run.analyses().size(), 1U);
    EXPECT_NE(run.warnings().at(1).text().find("10:1: .control: this script is not run, since an earlier one ended"), std::string::npos);
}

TEST(ControlScript, FourierBelongsToTheTransientBeforeIt) {
    const auto run = run_script("tran 10u 1m\ntran 10u 20m\nfourier 100 v(in)\ntran 10u 30m\nfourier 100 v(out)\n");
    ASSERT_EQ(run.analyses().size(), 3U);
    EXPECT_TRUE(run.analyses()[0].spectra.empty());
    ASSERT_EQ(run.analyses()[1].spectra.size(), 1U);
    EXPECT_EQ(run.analyses()[1].spectra[0].curve, "v(in)");
    EXPECT_EQ(run.analyses()[2].spectra.at(0).curve, "v(out)");
}

TEST(ControlScript, PartsOfCurvesAndNumbersArePrintedAsSuch) {
    const auto run = run_script(
        "ac lin 1 159.15494309 159.15494309\nlet b = 2\nlet out2 = vdb(out) + 1\nmeas ac level find out2 at=159.15494309\n"
        "meas ac down find vdb(out) at=159.15494309\nset n = 10 k = 3\nprint $n $k b\nprint v(in)-v(out) im(v(out))\n");
    EXPECT_NEAR(run.number("down"), -10 * std::log10(2), 1e-6);
    EXPECT_NEAR(run.number("level"), 1 - 10 * std::log10(2), 1e-6);
    EXPECT_EQ(run.number("10"), 10);
    EXPECT_EQ(run.number("3"), 3);
    EXPECT_EQ(run.number("b"), 2);
    ASSERT_EQ(run.warnings().size(), 2U);
    EXPECT_NE(run.warnings()[0].text().find("expressions of complex curves are not available in .ac; print their parts, such as vm(a)"),
              std::string::npos);
    EXPECT_NE(table_of(run, 0).find("-5.0000000e-01"), std::string::npos) << table_of(run, 0);
}

TEST(ControlScript, DecibelsOfAQuotientOfCurvesAreTaken) {
    const auto run = run_script("ac dec 100 1 10k\nlet gain = db(v(out)/v(in))\nmeas ac corner when gain=-3.0103\nprint gain\n");
    EXPECT_NEAR(run.number("corner") / 159.15494, 1, 1e-3);
    EXPECT_TRUE(run.warnings().empty()) << run.warnings()[0].text();
}

TEST(ControlScript, UnsetAndUnletRemoveTheirNames) {
    const auto run = run_script("let in = 5\nset n = 2m\nunlet in\nunset n\ntran 10u 1m\ntran 10u $n\nprint in\n");
    EXPECT_EQ(run.analyses().size(), 1U);
    EXPECT_TRUE(run.numbers().empty()) << "in is the node";
}

TEST(ControlScript, IsBounded) {
    std::string sum = "let z = v(in)";
    while (sum.size() < 9900) sum += "+v(in)";
    std::string commands = "op\n" + sum + "\n";
    for (int k = 0; k < 2000; ++k) commands += "print z\n";
    const auto netlist = parse_netlist_text(deck + ".control\n" + commands + ".endc\n");
    ASSERT_FALSE(netlist);
    EXPECT_NE(netlist.error().message.find("exceeds the limit of 10 MB"), std::string::npos);
    EXPECT_NE(warnings_of("op\nprint " + std::string(20000, '(') + "\n").find("a command is longer than 10000 characters"),
              std::string::npos);
}

}  // namespace
}  // namespace corpuscle::circuit
