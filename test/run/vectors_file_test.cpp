// Test vectors for hardware: the program writes the files stored here, and a second implementation, made from the documentation, agrees.

#include "run/run_inputs.hpp"
#include "support/sinks.hpp"

namespace corpuscle {
namespace {

const std::string stored_folder = test::source_root() + "/test/run/vectors/",
                  python = "/usr/bin/python3 " + test::source_root() + "/test/model/fixed_reference.py";

/// Writes the vectors of some afferents under some stimuli at 2 kHz.
std::vector<std::string> write(const test::TemporaryFolder& folder, const std::vector<std::string>& stimuli,
                               const std::vector<std::string>& names, const std::vector<std::string>& settings, std::size_t block = 4096) {
    const auto overrides = test::parse_settings(settings);
    std::vector<std::unique_ptr<ForceSource>> sources;
    std::vector<AfferentPlan> plans;
    for (const auto& s : stimuli) sources.push_back(test::value_or_throw(make_stimulus(s, overrides, 2e3, 9)).result);
    for (const auto& n : names) plans.push_back(test::value_or_throw(plan_afferent(n, overrides)).result);
    const auto vectors = test::make_sink(vectors_format, folder.path());
    Sink* sinks[] = {vectors.get()};
    RespondOptions options;
    options.block = block;
    (void)test::value_or_throw(run(sources, plans, sinks, options));
    EXPECT_TRUE(vectors->commit());
    return vectors->paths();
}

/// Settings of a small converter of 8 bits at 250 Hz, for files that are short enough to store.
std::vector<std::string> small_converter(const std::string& name) { return {name + ".bits=8", name + ".f_s=250Hz"}; }

bool reference_agrees(const std::string& vectors, const std::string& rom) {
    return std::system((python + " '" + vectors + "' '" + rom + "' > /dev/null").c_str()) == 0;
}

TEST(Vectors, ThePressGivesTheStoredFilesByteForByte) {
    for (const std::string name : {"sa1-kim", "fa1-lee"}) {
        const test::TemporaryFolder folder;
        write(folder, {"press"}, {name}, small_converter(name));
        for (const auto& file : {"vectors-" + name + ".csv", "rom-" + name + ".csv"})
            EXPECT_EQ(test::read_file(folder / file), test::read_file(stored_folder + file)) << file;
        EXPECT_TRUE(reference_agrees(stored_folder + "vectors-" + name + ".csv", stored_folder + "rom-" + name + ".csv")) << name;
    }
}

TEST(Vectors, ASecondImplementationAgreesOnEveryAlgorithmAndUnusualWords) {
    for (const std::string receptor : {"sa1a", "sa1b", "fa1a", "fa1b"})
        for (const std::string neuron : {"lif-a", "lif-b", "adaptive"})
            for (const auto& [word, frac] : {std::pair{"32", "24"}, {"24", "20"}, {"17", "9"}, {"12", "5"}}) {
                const test::TemporaryFolder folder;
                const auto name = "fsr+adc+" + receptor + "+" + neuron;
                write(folder, {"press+noise"}, {name},
                      {"noise.F_mean=0", name + ".word=" + word, name + ".frac=" + frac, name + ".f_s=700Hz", name + ".t_ref=3ms",
                       name + ".E_L=0.1"});
                EXPECT_TRUE(reference_agrees(folder / ("vectors-" + name + ".csv"), folder / ("rom-" + name + ".csv"))) << name << word;
            }
}

TEST(Vectors, TheReferenceDetectsASingleWrongBit) {
    const test::TemporaryFolder folder;
    auto text = test::read_file(stored_folder + "vectors-sa1-kim.csv");
    const auto at = text.rfind(",0\n");
    text[at + 1] = '1';
    EXPECT_FALSE(reference_agrees(folder.write("wrong.csv", text), stored_folder + "rom-sa1-kim.csv"));
}

TEST(Vectors, DoNotDependOnTheBlockAndEachInputHasItsOwnFile) {
    const test::TemporaryFolder undivided, parts;
    const auto paths = write(undivided, {"press", "ramp-hold"}, {"sa1", "sa1-kim"}, {});
    write(parts, {"press", "ramp-hold"}, {"sa1", "sa1-kim"}, {}, 7);
    EXPECT_EQ(undivided.file_names(), (std::vector<std::string>{"rom-sa1-kim.csv", "vectors-sa1-kim-2.csv", "vectors-sa1-kim.csv"}));
    EXPECT_EQ(paths.size(), 3U);
    for (const auto& name : undivided.file_names()) EXPECT_EQ(test::read_file(undivided / name), test::read_file(parts / name)) << name;
}

}  // namespace
}  // namespace corpuscle
