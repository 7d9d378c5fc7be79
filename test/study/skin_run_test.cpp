// A force through a skin as people run it: stopped and gone on with, on ranks, of a recording's channels; each time the same bytes.

#include <unistd.h>

#include "io/events.hpp"
#include "signal/stimuli.hpp"
#include "study/skin_checkpoint.hpp"
#include "study/skin_events_file.hpp"
#include "support/program.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::Folder, test::read_file, test::sure;

/// One run of a press on a fingertip into `out`; stopped after so many blocks (none: -1).
Result<SkinWork> press_fingertip(const Folder& folder, const std::string& out, int blocks, bool keeps,
                                 const std::string& likeness = "press") {
    static const auto skin = sure(innervate(sure(plan_skin("fingertip"))));
    const auto source = sure(make_stimulus("press", {}, 1e3, 0));
    const auto contact = sure(make_contact("sphere", {}, skin->plan.sites, source->clock()));
    const auto force = pressed_force(*source, *contact);
    const auto at_work = sure(Skin::make(skin, {1e-3}, *instruction_set()));
    std::unique_ptr<SkinCheckpoint> spool;
    if (keeps) {
        auto opened = SkinCheckpoint::open(folder / "state", *at_work, likeness);
        if (!opened) return opened.error();
        spool = std::move(*opened);
    }
    Pool pool(1);
    const auto answerer = alone_answerer(*at_work, pool);
    SkinEventsFile file(sure(OutputFile::create(folder / out)), "aer");
    SkinListener* const listeners[] = {&file};
    const SkinInput input{"press", "", source->clock(), {}, *skin};
    auto done = run_skin(*force, input, *answerer, listeners, {[&](double) { return blocks-- != 0; }, spool.get()});
    if (done && file.commit() && spool) spool->done();
    return done;
}

TEST(SkinRun, StoppedAgainAndAgainItGoesOnToTheSameBytes) {
    const Folder folder;
    const auto whole = sure(press_fingertip(folder, "whole", -1, false));
    ASSERT_GT(whole.spikes, 500);
    for (int stops = 0; stops < 20; ++stops) {
        const auto done = press_fingertip(folder, "parts", 2 + 2 * stops, true);  // blocks; those told again among them
        if (done) {
            EXPECT_GT(stops, 3);
            EXPECT_EQ(done->spikes, whole.spikes);
            EXPECT_EQ(done->at_rest, whole.at_rest);
            break;
        }
        ASSERT_EQ(done.error().code, Code::interrupted);
        EXPECT_FALSE(std::filesystem::exists(folder / "parts"));
    }
    EXPECT_EQ(read_file(folder / "parts"), read_file(folder / "whole"));
    EXPECT_FALSE(std::filesystem::exists(folder / "state")) << "it is done";
    EXPECT_FALSE(std::filesystem::exists(folder / "state.spikes"));
}

TEST(SkinRun, ACheckpointOfAnotherRunOrDamagedIsRefusedAndStays) {
    const Folder folder;
    ASSERT_FALSE(press_fingertip(folder, "a", 5, true));
    const auto kept = read_file(folder / "state");
    const auto other = press_fingertip(folder, "a", 5, true, "stroke");
    ASSERT_FALSE(other);
    EXPECT_NE(other.error().sentence.find("this run is another (stroke); the checkpoint is of: press"), std::string::npos);
    for (const std::size_t size : {std::size_t{3}, std::size_t{30}, kept.size() / 2, kept.size() - 1}) {
        folder.write("state", kept.substr(0, size));
        const auto cut = press_fingertip(folder, "a", 5, true);
        ASSERT_FALSE(cut);
        EXPECT_EQ(cut.error().code, Code::bad_input);
    }
    folder.write("state", kept);
    folder.write("state.spikes", "");
    const auto fewer = press_fingertip(folder, "a", 5, true);
    ASSERT_FALSE(fewer);
    EXPECT_NE(fewer.error().sentence.find("it has fewer spikes than"), std::string::npos) << fewer.error().sentence;
}

TEST(SkinRun, ARecordingsChannelsAreItsSitesByNameOrInOrder) {
    const Folder folder;
    std::string named = "time_s,r2c1_N,r1c1_N\n", in_order = "time_s,a_N,b_N,c_N,d_N\n";
    for (int k = 0; k < 600; ++k) {
        const auto force = std::to_string(std::min(4.0, 0.05 * k)), time = std::to_string(k / 1000.0);
        named += time + "," + force + ",0\n";
        in_order += time + ",0,0," + force + ",0\n";
    }
    folder.write("named.csv", named), folder.write("ordered.csv", in_order);
    ASSERT_EQ(test::run(folder, "respond named.csv --population 'grid 2x2' --out named --quiet").status, 0);
    ASSERT_EQ(test::run(folder, "respond ordered.csv --population 'grid 2x2' --out ordered --quiet").status, 0);
    EXPECT_EQ(read_file(folder / "named/spikes.csv"), read_file(folder / "ordered/spikes.csv"));
    EXPECT_NE(read_file(folder / "named/units.csv").find("sa1#3"), std::string::npos);
    const auto wrong = test::run(folder, "respond ordered.csv --population 'grid 3x2' --out wrong");
    EXPECT_EQ(wrong.status, 1);
    EXPECT_NE(wrong.err.find("ordered has 4 channels, and grid 3x2 has 6 sites"), std::string::npos) << wrong.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "wrong"));
}

TEST(SkinRun, WhatIsMeantForAfferentsOnChannelsIsRefused) {
    const Folder folder;
    for (const char* words : {"--afferent fa2", "--copies 3", "--noise 10nA", "--traces --out x", "--npz --out x", "--corner ss"}) {
        const auto ran = test::run(folder, std::string("respond press --population fingertip ") + words);
        EXPECT_EQ(ran.status, 2) << words << ran.err;
        EXPECT_NE(ran.err.find("does not go with --population"), std::string::npos) << ran.err;
    }
    EXPECT_EQ(test::run(folder, "respond press --population fingertip --set sa1.f_X=2Hz").status, 1);
    EXPECT_EQ(test::run(folder, "respond press --population fingertip --set sa9.f_B=2Hz").status, 2);
}

TEST(SkinRanks, GiveWhatOneProcessGives) {
    const Folder folder;
    ASSERT_EQ(test::run(folder, "respond press --population fingertip --events aer --out alone --quiet").status, 0);
    const std::string root = ::geteuid() == 0 ? "--allow-run-as-root " : "";
    const auto ranks = [&](int count, const std::string& words) {
        const auto command = "cd '" + folder.path() + "' && timeout 60 mpirun " + root + "--oversubscribe -n " + std::to_string(count) +
                             " '" + test::program() + "' respond " + words + " --quiet >said 2>&1";
        return WEXITSTATUS(std::system(command.c_str()));
    };
    for (const int count : {2, 3}) {
        ASSERT_EQ(ranks(count, "press --population fingertip --events aer --out r"), 0) << read_file(folder / "said");
        for (const char* file : {"spikes.aer", "units.csv", "summary.json"})
            EXPECT_EQ(read_file((folder / "r/") + file), read_file((folder / "alone/") + file)) << file << " of " << count;
    }
    EXPECT_EQ(ranks(2, "press --population fingertip --set press.F_max=no"), 1);
    EXPECT_NE(read_file(folder / "said").find("F_max"), std::string::npos);
}

}  // namespace
}  // namespace corpuscle
