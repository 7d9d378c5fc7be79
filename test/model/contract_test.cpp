// What every entry of the catalogue must keep to. One that is excused carries its reason.

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::afferent, test::every_afferent, test::force, test::spikes;

TEST(Contract, NoForceGivesNoSpikes) {
    for (const auto& name : every_afferent())
        for (const auto method : {Method::exact, Method::backward_euler})
            for (const double rate : {1e3, 10e3})
                EXPECT_TRUE(spikes(*afferent(name, {.rate = rate, .method = method}), std::vector<double>(20000)).empty())
                    << name << ' ' << rate;
}

TEST(Contract, EachAnswersToATouchOfItsKind) {
    for (const auto& name : every_afferent()) {
        const bool feels_vibration_only = name == "fa2" || name.starts_with("vibration");
        const auto touch = feels_vibration_only ? force("sine", {.settings = {"sine.f=250Hz", "sine.F_amp=0.3N"}}) : force("press");
        EXPECT_FALSE(spikes(*afferent(name), touch).empty()) << name;
    }
}

TEST(Contract, ParametersOfATransductionAndANeuronNeverShareAName) {
    for (const auto& r : receptor_cards())
        for (const auto& n : neuron_cards()) {
            std::set<std::string_view> names;
            for (const auto* card : {&r, &n})
                for (const auto& row : card->rows)
                    EXPECT_TRUE(names.insert(row.name).second) << r.name << '+' << n.name << ": " << row.name;
        }
}

TEST(Contract, EveryRowHasASentenceAReadableUnitAndItsDefaultInRange) {
    for (const auto& cards : {receptor_cards(), neuron_cards(), stimulus_cards()})
        for (const auto& card : cards) {
            EXPECT_FALSE(card.sentence.empty() || card.source.empty()) << card.name;
            for (const auto& row : card.rows) {
                EXPECT_FALSE(row.sentence.empty()) << card.name << '.' << row.name;
                EXPECT_TRUE(row.initial >= row.low && row.initial <= row.high) << card.name << '.' << row.name;
            }
        }
}

TEST(Contract, ValuesOutsideARowsRangeAreRefusedByName) {
    for (const auto& name : every_afferent()) {
        const auto plan = test::sure(plan_afferent(name, {}));
        for (const auto& p : plan.parameters) {
            const Wish wish{name, std::string(p.row.name), fmt::format("{}", p.row.high * 2 + 1)};
            const auto refused = plan_afferent(name, std::span(&wish, 1));
            ASSERT_FALSE(refused) << wish.text();
            EXPECT_NE(refused.error().text().find(std::string(p.row.name) + " = "), std::string::npos) << refused.error().text();
        }
    }
}

TEST(Contract, BlocksOfAnySizeGiveTheSameSpikesAndTraces) {
    rc::check("chunked equals whole, byte for byte", [] {
        const auto names = every_afferent();
        const auto name = names[*rc::gen::inRange<std::size_t>(0, names.size())];
        const auto method = *rc::gen::element(Method::exact, Method::backward_euler);
        const auto f = force(*rc::gen::element<std::string>("press+noise", "ramp-hold", "grating", "step+sine"),
                             {.settings = {"noise.F_mean=0"}, .rate = 2e3, .seed = 5});
        const auto a = afferent(name, {.rate = 2e3, .method = method});
        const auto shown = [&](const std::vector<std::size_t>& sizes) {
            std::vector<Spike> out;
            std::vector<std::vector<double>> probes(a->probes().size(), std::vector<double>(f.size()));
            auto state = a->start();
            for (std::size_t k = 0, n = 0; k < f.size(); ++n) {
                const auto size = std::min(sizes[n % sizes.size()], f.size() - k);
                std::vector<double*> here;
                for (auto& p : probes) here.push_back(p.data() + k);
                Answer answer{out, 3, here, 0};
                state = test::sure(unpack(pack(state)));  // and saved and resumed between blocks
                RC_ASSERT(static_cast<bool>(a->respond(std::span(f).subspan(k, size), state, answer)));
                k += size;
            }
            return std::pair(out, probes);
        };
        const auto sizes = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(1, 700)));
        const auto whole = shown({f.size()}), parts = shown(sizes);
        RC_ASSERT(whole.first == parts.first);
        RC_ASSERT(whole.second == parts.second);
        RC_ASSERT(spikes(*a, f) == [&] {
            auto s = whole.first;
            for (auto& x : s) x.unit = 0;
            return s;
        }());  // watching changes nothing
    });
}

TEST(Contract, SpikesComeInOrderInsideTheirSteps) {
    for (const auto& name : every_afferent())
        for (const auto method : {Method::exact, Method::backward_euler}) {
            const auto train = spikes(*afferent(name, {.rate = 500, .method = method}),
                                      force("press+noise", {.settings = {"noise.F_sd=2N"}, .rate = 500}));
            EXPECT_TRUE(std::is_sorted(train.begin(), train.end())) << name;
            for (const auto& s : train) ASSERT_TRUE(s.offset > 0 && s.offset <= 1) << name << ' ' << s.offset;
        }
}

TEST(Contract, AStateOfAnotherAfferentIsRefused) {
    std::vector<Spike> out;
    Answer answer{out};
    auto state = afferent("sa1")->start();
    const std::vector<double> f(10);
    EXPECT_EQ(afferent("fa1")->respond(f, state, answer).error().sentence, "a state of 'sa1b+lif-b/1' was handed to 'fa1b+lif-b/1'");
}

TEST(Contract, EachConvergesToItsOwnFineStepAnswer) {
    for (const auto& name : every_afferent()) {
        const bool vibration = name == "fa2" || name.starts_with("vibration"),
                   substeps = name.ends_with("izhikevich") || name.ends_with("adex");
        const auto at = [&](double rate) {
            std::vector<std::string> settings = {"sine.f=200Hz", "sine.F_amp=0.3N", "sine.duration=100ms"};
            if (substeps) settings.push_back(fmt::format("{}.substep={}us", name, std::min(1e6 / rate, 1000.0)));
            auto t = test::train(name, vibration ? "sine" : "press", {.settings = settings, .rate = rate});
            while (vibration && !t.empty() && t.back() > 0.095) t.pop_back();  // one that the end may or may not cut off
            return t;
        };
        const auto fine = at(2.048e6);
        double before = INFINITY, error = 0;
        for (const double rate : {16e3, 64e3, 256e3}) {
            const auto coarse = at(rate);
            ASSERT_EQ(coarse.size(), fine.size()) << name << " at " << rate;
            error = 0;
            for (std::size_t k = 0; k < fine.size(); ++k) error = std::max(error, std::abs(coarse[k] - fine[k]));
            EXPECT_LT(error, std::max(0.5 * before, 1e-9)) << name << " at " << rate;
            before = error;
        }
        EXPECT_LT(error, 1e-6) << name;
    }
}

TEST(Contract, FirstSampleSetsTheForceThatWentBeforeIt) {
    for (const auto& name : every_afferent()) {
        if (name.starts_with("sa")) continue;  // they answer to force that stands still
        EXPECT_TRUE(spikes(*afferent(name), std::vector<double>(10000, 3.0)).empty()) << name << " took the first sample for a step";
    }
}

}  // namespace
}  // namespace corpuscle
