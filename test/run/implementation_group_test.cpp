// Versions (implementations) of one afferent type: how they are grouped and compared.

#include "run/compare/implementation_comparison.hpp"

#include <nlohmann/json.hpp>

#include "run/afferent_plan.hpp"
#include "run/compare/train_comparison.hpp"
#include "run/summary/run_summary.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::value_or_throw;

AfferentPlan make_named(const std::string& name) {
    auto plan = value_or_throw(plan_any_afferent("sa1")).result;
    plan.name = name;
    return plan;
}

TEST(ImplementationGroup, IsTheAfferentTypeAtTheBeginningOfAName) {
    for (const auto* name :
         {"sa1", "SA1", "SA-I", "sa1-kim", "sa1-circuit", "sa1-macro", "circuits/sa1.cir", "./sa1_biased.cir", "/x.y/SA1-b.cir"})
        EXPECT_EQ(afferent_type_of(make_named(name).name), "sa1") << name;
    EXPECT_EQ(afferent_type_of(make_named("RA").name), "fa1") << "an alias of fa1-nerve";
    EXPECT_EQ(afferent_type_of(make_named("fa1-nerve").name), "fa1");
    EXPECT_EQ(afferent_type_of(make_named("fa1-lee").name), "fa1");
    for (const auto* name : {"sa1b+izhikevich", "fsr+f2i+sa1", "own-thing"})
        EXPECT_EQ(afferent_type_of(make_named(name).name), name) << "not the name of an afferent type";
    EXPECT_EQ(afferent_type_of(make_named("circuits/spiker.cir").name), "spiker");
    EXPECT_EQ(afferent_type_of(make_named("my_sa1.cir").name), "my_sa1") << "does not begin with the name of an afferent";
}

TEST(ImplementationGroup, TheAfferentOfThisNameIsFirstThenModelsThenNetlists) {
    const auto chip = value_or_throw(plan_any_afferent(test::source_root() + "/circuits/sa1.cir")).result;
    const AfferentPlan plans[] = {chip, make_named("sa1-kim"), make_named("fa1"), make_named("sa1")};
    const auto all = implementation_groups(plans);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].afferent_type, "sa1");
    EXPECT_EQ(all[0].members, (std::vector<std::size_t>{3, 1, 0}));
    EXPECT_EQ(all[1].members, std::vector<std::size_t>{2});
}

struct ImplementationRun {
    RunSummary summary;
    std::string document;
};

ImplementationRun run_implementations(const std::vector<std::string>& stimuli, const std::vector<std::string>& names, std::size_t block,
                                      std::uint32_t copies = 0) {
    std::vector<std::unique_ptr<ForceSource>> sources;
    std::vector<AfferentPlan> plans;
    for (const auto& s : stimuli) sources.push_back(value_or_throw(make_stimulus(s, 2e3, 9)));
    for (const auto& n : names) plans.push_back(value_or_throw(plan_any_afferent(n)).result);
    std::vector<AfferentPlan> all_plans;  // with copies
    for (const auto& p : plans)
        for (auto& copy : copies ? value_or_throw(make_copies(p, copies, {}, 1)) : std::vector{p}) all_plans.push_back(std::move(copy));
    ImplementationRun ran;
    Sink* sinks[] = {&ran.summary};
    RespondOptions options;
    options.block = block;
    const auto work = value_or_throw(run(sources, all_plans, sinks, options));
    ran.document = ran.summary.document(plans, work, options, {}).dump();
    return ran;
}

TEST(ImplementationComparisons, HaveCountsByPhaseAndTheDistancesOfCompare) {
    const auto ran = run_implementations({"press"}, {"sa1-kim", "fa1", "sa1"}, 333);
    ASSERT_EQ(ran.summary.comparisons.rows.size(), 1u) << "fa1 has one implementation";
    const auto& row = ran.summary.comparisons.rows[0];
    EXPECT_EQ(row.reference + " " + row.afferent + " " + row.channel, "sa1 sa1-kim press");
    const auto model = test::train("sa1", "press", {.rate = 2e3}), kim = test::train("sa1-kim", "press", {.rate = 2e3});
    EXPECT_EQ(row.total.spikes, kim.size());
    EXPECT_EQ(row.total.reference_spikes, model.size());
    EXPECT_NEAR(row.total.excess(), static_cast<double>(kim.size()) / static_cast<double>(model.size()) - 1, 1e-15);
    const NamedTrain a{"sa1", "press", model}, b{"sa1-kim", "press", kim};
    const auto difference = value_or_throw(compare_trains({&a, &b}, {.window = 20e-3}));
    EXPECT_NEAR(row.victor_purpura, difference.victor_purpura, 1e-9);
    EXPECT_NEAR(row.van_rossum, difference.van_rossum(), 1e-9);
    EXPECT_EQ(row.matched, difference.matched);
    EXPECT_LT(std::abs(row.median_shift), 20e-3);
    EXPECT_LT(std::abs(row.mean_shift), 20e-3);

    std::size_t counted = 0, reference_count = 0;
    for (const auto& p : row.phases) counted += p.spikes, reference_count += p.reference_spikes;
    EXPECT_EQ(counted, kim.size());
    EXPECT_EQ(reference_count, model.size());
    ASSERT_EQ(row.phases.size(), 5u);
    for (const auto& r : ran.summary.rows)
        for (const auto& p : row.phases) {
            if (r.phase != p.phase || r.afferent == "fa1") continue;
            EXPECT_EQ(r.values[0], static_cast<double>(r.afferent == "sa1" ? p.reference_spikes : p.spikes))
                << r.afferent << " " << p.phase;
        }
    EXPECT_TRUE(std::isnan(row.phases[0].excess())) << "the reference has no spikes in this phase";
}

TEST(ImplementationComparisons, AShiftIsPositiveIfTheVersionIsLater) {
    const auto row = run_implementations({"press"}, {"sa1", "SA1"}, 4096).summary.comparisons.rows.at(0);
    EXPECT_EQ(row.matched, row.total.spikes);
    EXPECT_EQ(row.median_shift, 0);
    EXPECT_EQ(row.victor_purpura + row.van_rossum, 0);
    const auto kim = run_implementations({"press"}, {"sa1", "sa1-kim"}, 4096).summary.comparisons.rows.at(0);
    const auto model = test::train("sa1", "press", {.rate = 2e3}), kim_train = test::train("sa1-kim", "press", {.rate = 2e3});
    ASSERT_LT(kim_train[0], model[0]) << "otherwise the next expectation proves nothing";
    EXPECT_LT(kim.median_shift, 0);
}

TEST(ImplementationComparisons, DoNotDependOnTheBlockAndAreSeparateForEachInput) {
    const std::vector<std::string> stimuli = {"press", "noise"}, names = {"sa1", "sa1-kim", "fa1-lee", "fa1"};
    const auto undivided = run_implementations(stimuli, names, 1 << 20);
    EXPECT_EQ(undivided.document, run_implementations(stimuli, names, 77).document);
    const auto pairs = nlohmann::json::parse(undivided.document)["comparisons"]["pairs"];
    ASSERT_EQ(pairs.size(), 4u);
    EXPECT_EQ(pairs[1]["afferent"], "fa1-lee");
    EXPECT_EQ(pairs[1]["reference"], "fa1");
    EXPECT_EQ(pairs[2]["channel"], "noise");
    EXPECT_EQ(pairs[0]["phases"][2]["phase"], "plateau");
    EXPECT_EQ(pairs[0]["phases"][2]["reference_spikes"], 9);
    EXPECT_EQ(pairs[0]["phases"][0]["excess"], nullptr);
}

TEST(ImplementationComparisons, LeaveOutCopiesAndSingleVersions) {
    EXPECT_TRUE(run_implementations({"press"}, {"sa1", "fa1"}, 4096).summary.comparisons.rows.empty());
    const auto copies = run_implementations({"press"}, {"sa1", "sa1-kim"}, 4096, 3);
    EXPECT_TRUE(copies.summary.comparisons.rows.empty());
    EXPECT_FALSE(nlohmann::json::parse(copies.document).contains("comparisons"));
}

/// The chips of the thesis under its press: counts within one spike of the models', and the chips' spikes earlier by these medians.
TEST(ImplementationComparisons, ChipsFireAsTheirModelsDo) {
    const auto ran = run_implementations(
        {"press"}, {"sa1", "fa1", test::source_root() + "/circuits/sa1.cir", test::source_root() + "/circuits/fa1.cir"}, 4096);
    ASSERT_EQ(ran.summary.comparisons.rows.size(), 2u);
    for (const auto& row : ran.summary.comparisons.rows) {
        EXPECT_LE(std::abs(row.total.excess()), 0.07) << row.afferent;
        EXPECT_NEAR(row.median_shift, row.afferent.ends_with("sa1.cir") ? -11.4e-3 : -3.7e-3, 0.1e-3) << row.afferent;
        EXPECT_GE(row.matched, 8u) << row.afferent;
    }
}

}  // namespace
}  // namespace corpuscle
