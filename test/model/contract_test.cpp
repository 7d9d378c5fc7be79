// Requirements that every entry of the catalogue must satisfy, with a reason for each exception.

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/text/quantity.hpp"
#include "support/property.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

using test::afferent, test::all_afferent_names, test::force, test::spikes;

TEST(Contract, NoForceGivesNoSpikes) {
    for (const auto& name : all_afferent_names())
        for (const auto method : {Method::exact, Method::backward_euler})
            for (const double rate : {1e3, 10e3})
                EXPECT_TRUE(spikes(*afferent(name, {.rate = rate, .method = method}), std::vector<double>(20000)).empty())
                    << name << ' ' << rate;
}

TEST(Contract, EveryAfferentFiresUnderAStimulusOfItsKind) {
    for (const auto& name : all_afferent_names()) {
        const bool feels_vibration_only = name == "fa2" || name.starts_with("vibration");
        const auto touch = feels_vibration_only ? force("sine", {.settings = {"sine.f=250Hz", "sine.F_amp=0.3N"}}) : force("press");
        EXPECT_FALSE(spikes(*afferent(name), touch).empty()) << name;
    }
}

TEST(Contract, ParametersOfCombinedComponentsNeverShareAName) {
    const std::vector<std::vector<CatalogEntry>> kinds = {sensor_entries(), transducer_entries(), converter_entries(), receptor_entries(),
                                                          neuron_entries()};
    for (const auto& first : kinds)
        for (const auto& second : kinds) {
            if (&first == &second) continue;  // two components of the same kind are never combined
            for (const auto& a : first)
                for (const auto& b : second)
                    for (const auto& x : a.parameters)
                        for (const auto& y : b.parameters) EXPECT_NE(x.name, y.name) << a.name << " and " << b.name;
        }
}

TEST(Contract, EveryParameterHasADescriptionAReadableUnitAndItsDefaultInRange) {
    for (const auto& entries :
         {sensor_entries(), transducer_entries(), converter_entries(), receptor_entries(), neuron_entries(), stimulus_catalog()})
        for (const auto& entry : entries) {
            EXPECT_FALSE(entry.description.empty() || entry.source.empty()) << entry.name;
            for (const auto& row : entry.parameters) {
                EXPECT_FALSE(row.description.empty()) << entry.name << '.' << row.name;
                EXPECT_TRUE(parse_unit(row.unit)) << entry.name << '.' << row.name << ": " << row.unit;
                EXPECT_TRUE(row.default_value >= row.low && row.default_value <= row.high) << entry.name << '.' << row.name;
            }
        }
}

TEST(Contract, ValuesOutsideAParametersRangeAreRefusedByName) {
    for (const auto& name : all_afferent_names()) {
        const auto plan = test::value_or_throw(plan_afferent(name));
        for (const auto& p : *plan.parameters) {
            for (const double value : {p.info.high * 2 + 1, p.info.low - std::abs(p.info.low) - 1}) {
                const ParameterOverride parameter_override{name, std::string(p.info.name), fmt::format("{}", value)};
                const auto refused = plan_afferent(name, std::span(&parameter_override, 1));
                ASSERT_FALSE(refused) << parameter_override.text();
                EXPECT_NE(refused.error().text().find(std::string(p.info.name) + " = "), std::string::npos) << refused.error().text();
            }
        }
    }
}

TEST(Contract, BlocksOfAnySizeGiveTheSameSpikesAndProbes) {
    EXPECT_TRUE(rc::check("the response in blocks equals the undivided response, bit for bit", [] {
        const auto names = all_afferent_names();
        const auto name = names[*rc::gen::inRange<std::size_t>(0, names.size())];
        const auto method = *rc::gen::element(Method::exact, Method::backward_euler);
        const auto f = force(*rc::gen::element<std::string>("press+noise", "ramp-hold", "grating", "step+sine"),
                             {.settings = {"noise.F_mean=0"}, .rate = 2e3, .seed = 5});
        const auto plan = test::value_or_throw(plan_afferent(name));
        std::vector<std::string> settings;
        if (plan.value("t_ref")) settings.push_back(fmt::format("{}.t_ref={}us", name, *rc::gen::inRange(0, 20000)));
        const auto a = afferent(name, {.settings = settings, .rate = 2e3, .method = method});
        const auto simulate = [&](const std::vector<std::size_t>& sizes, bool records = true) {
            std::vector<Spike> out;
            std::vector<std::vector<double>> probes(a->probes().size(), std::vector<double>(f.size()));
            auto state = a->start();
            for (std::size_t k = 0, n = 0; k < f.size(); ++n) {
                const auto size = std::min(sizes[n % sizes.size()], f.size() - k);
                std::vector<double*> here;
                if (records)
                    for (auto& p : probes) here.push_back(p.data() + k);
                ResponseBlock response{out, 3, here};               // 3: any afferent index
                state = test::value_or_throw(unpack(pack(state)));  // saved and resumed between blocks
                RC_ASSERT(static_cast<bool>(a->respond(std::span(f).subspan(k, size), state, response)));
                k += size;
            }
            return std::pair(out, probes);
        };
        const auto sizes = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(1, 700)));
        const auto undivided = simulate({f.size()}), in_blocks = simulate(sizes);
        RC_ASSERT(undivided.first == in_blocks.first);
        RC_ASSERT(undivided.second == in_blocks.second);
        RC_ASSERT(undivided.first == simulate({f.size()}, false).first);  // recording probes does not change the spikes
    }));
}

TEST(Contract, ANonFiniteForceIsRefused) {
    for (const auto& name : all_afferent_names())
        for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
            std::vector<Spike> out;
            ResponseBlock response{out};
            const auto a = afferent(name);
            auto state = a->start();
            std::vector<double> f(100, 1.0);
            f[17] = bad;
            const auto done = a->respond(f, state, response);
            ASSERT_FALSE(done) << name;
            EXPECT_NE(done.error().message.find("the force of sample 17 is"), std::string::npos) << done.error().message;
        }
}

TEST(Contract, ForcesFarTooLargeGiveSpikesOrAnErrorNeverSilence) {
    for (const auto& name : all_afferent_names())
        for (const double newtons : {100.0, 3e4, 1e9}) {
            std::vector<Spike> out;
            ResponseBlock response{out};
            const auto a = afferent(name);
            auto state = a->start();
            const auto f = force("step", {.settings = {"step.F_max=1000N"}});
            std::vector<double> big;
            for (const double x : f) big.push_back(x * newtons / 1000);
            const auto done = a->respond(big, state, response);
            // A compressed current lasts so short after a step that a membrane of microfarads does not reach its threshold.
            const bool may_be_silent = name.starts_with("fast-adapting+") && !name.ends_with("+alif");
            if (done) {
                EXPECT_TRUE(may_be_silent || !out.empty()) << name << ' ' << newtons;
            } else {
                EXPECT_EQ(done.error().code, ErrorCode::not_converged);
            }
        }
}

TEST(Contract, NoSpikeComesBeforeTheFirstSample) {
    for (const auto& name : all_afferent_names()) {
        const auto train = spikes(*afferent(name, {.rate = 1e3, .method = Method::backward_euler}), std::vector<double>(1000, 300.0));
        if (train.empty()) continue;
        EXPECT_GE((Clock{1000, 1}.time(train[0].step, train[0].offset)), 0) << name;
    }
}

/// The hash FNV-1a of the bits of all spikes.
std::uint64_t fingerprint(const std::vector<Spike>& train) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto mix = [&](std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (word >> 8 * byte & 0xff)) * 0x100000001b3U;
    };
    for (const auto& s : train) mix(static_cast<std::uint64_t>(s.step)), mix(std::bit_cast<std::uint64_t>(s.offset));
    return hash;
}

TEST(Contract, EveryMachineAndCompilerGivesTheSameBits) {
    const std::map<std::string, std::uint64_t> right = {
        // computed once; they change only if a model changes
        {"sa1", 6440322472683748240U},          {"fa1", 12148808211675308903U},
        {"sa2", 8982413015169182121U},          {"fa2", 5417457917347364582U},
        {"sa1a+lif-a", 15603805738671303522U},  {"fa1a+adaptive", 17096642722010903437U},
        {"sa1-kim", 6230854961166624511U},      {"fa1-lee", 7773308965379674424U},
        {"fsr+f2i+sa1", 11309936020457257991U}, {"sa1b+izhikevich", 6574269746275925316U},
        {"sa1b+adex", 5189800272929609608U},
    };
    const auto f = force("press+noise+chirp", {.settings = {"noise.F_mean=0", "chirp.F_mean=0"}, .rate = 5e3, .seed = 11});
    for (const auto& [name, hash] : right) EXPECT_EQ(fingerprint(spikes(*afferent(name, {.rate = 5e3}), f)), hash) << name;
}

TEST(Contract, SpikesAreOrderedAndLieWithinTheirSteps) {
    for (const auto& name : all_afferent_names())
        for (const auto method : {Method::exact, Method::backward_euler}) {
            const auto train = spikes(*afferent(name, {.rate = 500, .method = method}),
                                      force("press+noise", {.settings = {"noise.F_sd=2N"}, .rate = 500}));
            EXPECT_TRUE(std::is_sorted(train.begin(), train.end())) << name;
            for (const auto& s : train) ASSERT_TRUE(s.offset > 0 && s.offset <= 1) << name << ' ' << s.offset;
        }
}

TEST(Contract, AStateOfAnotherAfferentIsRefused) {
    std::vector<Spike> out;
    ResponseBlock response{out};
    auto state = afferent("sa1")->start();
    const std::vector<double> f(10);
    EXPECT_EQ(afferent("fa1")->respond(f, state, response).error().message,
              "a state of 'sa1b+lif-b/2, T = 0.0001 s' was given to 'fa1b+lif-b/2, T = 0.0001 s'");
}

TEST(Contract, SpikeTimesConvergeAsTheStepDecreases) {
    for (const auto& name : all_afferent_names()) {
        const bool vibration = name == "fa2" || name.starts_with("vibration"),
                   substeps = name.ends_with("izhikevich") || name.ends_with("adex");
        const auto at = [&](double rate) {
            const char* amplitude = name == "fa2" ? "sine.F_amp=10mN" : "sine.F_amp=0.3N";
            std::vector<std::string> settings = {"sine.f=200Hz", amplitude, "sine.duration=100ms"};
            if (substeps) settings.push_back(fmt::format("{}.substep={}us", name, std::min(1e6 / rate, 1000.0)));
            auto t = test::train(name, vibration ? "sine" : "press", {.settings = settings, .rate = rate});
            while (vibration && !t.empty() && t.back() > 0.095) t.pop_back();  // the end of the run decides if there is a last spike
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

TEST(Contract, TheForceBeforeTheFirstSampleEqualsTheFirstSample) {
    for (const auto& name : all_afferent_names()) {
        if (name.find("sa") != std::string::npos || name.starts_with("slowly-adapting")) {  // these respond to constant force, but not before the second sample
            const auto at_once = spikes(*afferent(name), std::vector<double>(2, 3.0)),
                       later = spikes(*afferent(name), std::vector<double>(2000, 3.0));
            EXPECT_TRUE(at_once.empty()) << name;
            EXPECT_FALSE(later.empty()) << name;
            continue;
        }
        EXPECT_TRUE(spikes(*afferent(name), std::vector<double>(10000, 3.0)).empty()) << name << " took the first sample for a step";
    }
}

}  // namespace
}  // namespace corpuscle
