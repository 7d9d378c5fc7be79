// The C interface: the same numbers as C++, and an error instead of a crash for every wrong call.

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "corpuscle.h"
#include "corpuscle.hpp"

namespace corpuscle {
namespace {

std::string last_error() { return corpuscle_error(); }

corpuscle_simulation simulation_of(const char* afferents) {
    corpuscle_simulation out = {};
    out.size = sizeof out, out.afferents = afferents;
    return out;
}

TEST(CInterface, RespondsAsCxxDoes) {
    std::vector<double> force;  // two channels, sample by sample
    for (int k = 0; k < 1000; ++k) force.push_back(std::min(k / 100.0, 2.0)), force.push_back(std::sin(k / 5.0));
    Force both{.rate = 1000, .channels = {"ch1", "ch2"}, .samples = {{}, {}}};
    for (std::size_t k = 0; k < force.size(); ++k) both.samples[k % 2].push_back(force[k]);
    const auto expected =
        respond(both, {.afferents = {"sa1", "fa1"}, .settings = {"sa1.f_B=25Hz"}, .copies = 3, .spreads = {"sa1.f_B=10%"}});

    const char *settings[] = {"sa1.f_B=25Hz"}, *spreads[] = {"sa1.f_B=10%"};
    auto simulation = simulation_of("sa1,fa1");
    simulation.settings = settings, simulation.setting_count = 1, simulation.spreads = spreads, simulation.spread_count = 1;
    simulation.copies = 3;
    auto* const response = corpuscle_respond(force.data(), 1000, 2, 1000, &simulation);
    ASSERT_TRUE(response) << last_error();
    const auto* const times = corpuscle_response_times(response);
    const auto* const indices = corpuscle_response_indices(response);
    const auto spikes = corpuscle_response_spikes(response);
    EXPECT_GT(spikes, 10U);
    EXPECT_EQ(std::vector(times, times + spikes), expected.times);
    EXPECT_EQ(std::vector(indices, indices + spikes), expected.indices);
    ASSERT_EQ(corpuscle_response_afferents(response), expected.afferents.size());
    for (std::size_t k = 0; k < expected.afferents.size(); ++k) {
        EXPECT_EQ(corpuscle_response_afferent_name(response, k), expected.afferents[k].name);
        EXPECT_EQ(corpuscle_response_afferent_type(response, k), expected.afferents[k].type);
        EXPECT_EQ(corpuscle_response_afferent_channel(response, k), expected.afferents[k].channel);
    }
    EXPECT_EQ(corpuscle_response_summary(response), expected.summary());
    EXPECT_EQ(corpuscle_response_duration(response), expected.duration);
    corpuscle_response_destroy(response);
}

TEST(CInterface, StimuliAndTouchesAreThoseOfTheCatalogue) {
    const char* settings[] = {"press.F_max=2N"};
    auto* const press = corpuscle_stimulus("press", settings, 1, 1e4, 0);
    ASSERT_TRUE(press) << last_error();
    const auto expected = stimulus("press", {"press.F_max=2N"}, 1e4);
    const auto* const samples = corpuscle_force_channel(press, 0);
    EXPECT_EQ(std::vector(samples, samples + corpuscle_force_samples(press)), expected.samples[0]);
    EXPECT_EQ(corpuscle_force_rate(press), 1e4);
    auto* const response = corpuscle_respond_force(press, nullptr);
    ASSERT_TRUE(response) << last_error();
    EXPECT_EQ(corpuscle_response_spikes(response), respond(expected).times.size());
    corpuscle_response_destroy(response);
    corpuscle_force_destroy(press);

    auto simulation = simulation_of(nullptr);
    simulation.population = "grid 4x4";
    auto* const stroke = corpuscle_respond_stimulus("stroke", 0, &simulation);
    ASSERT_TRUE(stroke) << last_error();
    EXPECT_EQ(corpuscle_response_spikes(stroke), respond_to("stroke", {.population = "grid 4x4"}).times.size());
    double x = -1, y = -1;
    EXPECT_EQ(corpuscle_response_afferent_position(stroke, 0, &x, &y), CORPUSCLE_OK);
    EXPECT_GE(std::min(x, y), 0);
    corpuscle_response_destroy(stroke);
}

TEST(CInterface, ErrorsHaveTheTextOfTheCommandLineAndACode) {
    auto simulation = simulation_of("sa9");
    EXPECT_EQ(corpuscle_respond_stimulus("press", 0, &simulation), nullptr);
    EXPECT_EQ(corpuscle_error_code(), CORPUSCLE_BAD_INPUT);
    EXPECT_NE(last_error().find("did you mean 'sa1'"), std::string::npos) << last_error();
    const double force[] = {0, NAN};
    EXPECT_EQ(corpuscle_respond(force, 2, 1, 1000, nullptr), nullptr);
    EXPECT_EQ(last_error(), "'ch1': the force of sample 1 is not a finite number");
    EXPECT_EQ(corpuscle_respond(force, 0, 1, 1000, nullptr), nullptr);
    EXPECT_EQ(last_error(), "the force has no samples");
    EXPECT_EQ(corpuscle_respond(force, 1, 1, -5, nullptr), nullptr);
    EXPECT_EQ(corpuscle_error_code(), CORPUSCLE_BAD_INPUT);
    const char* option = "units=mN";
    EXPECT_EQ(corpuscle_read("/dev/null", &option, 1), nullptr);
    EXPECT_NE(last_error().find("units"), std::string::npos) << last_error();
    const char* no_value = "abs";
    EXPECT_EQ(corpuscle_read("/dev/null", &no_value, 1), nullptr);
    EXPECT_EQ(last_error(), "'abs' is not an option with a value, such as unit=mN or abs=true");
}

TEST(CInterface, ADestroyedObjectIsAnErrorEvenIfAnotherTakesItsPlace) {
    std::vector<corpuscle_skin*> destroyed;
    for (int k = 0; k < 50; ++k) {
        destroyed.push_back(corpuscle_create("sa1", 1000, 1));
        corpuscle_destroy(destroyed.back());
    }
    auto* const live = corpuscle_create("sa1", 1000, 1);
    ASSERT_TRUE(live);
    const double frame = 1;
    for (auto* skin : destroyed) {
        EXPECT_NE(skin, live);
        EXPECT_EQ(corpuscle_push(skin, &frame, 1, nullptr, nullptr), CORPUSCLE_BAD_CALL);
        EXPECT_EQ(last_error(), "skin is not an object of this library, or has been destroyed");
        EXPECT_EQ(corpuscle_sites(skin), 0U);
        corpuscle_destroy(skin);  // must not destroy `live`
    }
    EXPECT_EQ(corpuscle_push(live, &frame, 1, nullptr, nullptr), CORPUSCLE_OK) << last_error();
    corpuscle_destroy(live);
}

TEST(CInterface, APointerThatIsNoObjectOfThisKindIsAnError) {
    auto* const force = corpuscle_stimulus("press", nullptr, 0, 1e4, 0);
    int other = 0;
    for (void* wrong :
         {static_cast<void*>(nullptr), static_cast<void*>(force), static_cast<void*>(&other), reinterpret_cast<void*>(~0UL)}) {
        auto* const response = static_cast<corpuscle_response*>(wrong);
        EXPECT_EQ(corpuscle_response_spikes(response), 0U);
        EXPECT_EQ(corpuscle_error_code(), CORPUSCLE_BAD_CALL);
        EXPECT_EQ(corpuscle_response_times(response), nullptr);
        EXPECT_EQ(corpuscle_response_summary(response), nullptr);
        EXPECT_TRUE(std::isnan(corpuscle_response_start(response)));
        EXPECT_EQ(corpuscle_response_afferent_position(response, 0, nullptr, nullptr), CORPUSCLE_BAD_CALL);
        corpuscle_response_destroy(response);
        auto* const skin = static_cast<corpuscle_skin*>(wrong);
        EXPECT_EQ(corpuscle_finish(skin, nullptr, nullptr), CORPUSCLE_BAD_CALL);
        EXPECT_EQ(corpuscle_save(skin, nullptr, 0), 0U);
    }
    EXPECT_EQ(corpuscle_force_channels(force), 1U);
    EXPECT_EQ(corpuscle_force_channel(force, 1), nullptr);
    EXPECT_EQ(last_error(), "there is no channel 1; the force has 1, which count from 0");
    corpuscle_force_destroy(force);
}

TEST(CInterface, TheSizeOfAStructureIsItsVersion) {
    struct {
        corpuscle_simulation known;
        double later = 0;
    } simulation = {simulation_of("sa1")};
    const auto responds = [&](std::size_t size) {
        simulation.known.size = size;
        auto* const response = corpuscle_respond_stimulus("press", 0, &simulation.known);
        corpuscle_response_destroy(response);
        return response != nullptr;
    };
    EXPECT_TRUE(responds(sizeof simulation.known)) << last_error();
    EXPECT_TRUE(responds(sizeof simulation)) << last_error();
    simulation.later = 1;
    EXPECT_FALSE(responds(sizeof simulation));
    EXPECT_NE(last_error().find("set them to 0, or use a later version"), std::string::npos) << last_error();
    EXPECT_FALSE(responds(0));
    EXPECT_NE(last_error().find("must be sizeof(corpuscle_simulation)"), std::string::npos) << last_error();
    simulation.known.flags = 8;
    EXPECT_FALSE(responds(sizeof simulation.known));
    EXPECT_EQ(corpuscle_error_code(), CORPUSCLE_BAD_CALL);
}

TEST(CInterface, TheProgressFunctionStopsARun) {
    auto simulation = simulation_of("sa1");
    int calls = 0;
    simulation.user = &calls;
    simulation.progress = [](void* user, double) { return ++*static_cast<int*>(user), 1; };
    EXPECT_EQ(corpuscle_respond_stimulus("press", 0, &simulation), nullptr);
    EXPECT_EQ(corpuscle_error_code(), CORPUSCLE_STOPPED);
    EXPECT_EQ(calls, 1);
    simulation.progress = [](void* user, double) { return ++*static_cast<int*>(user), 0; };
    auto* const response = corpuscle_respond_stimulus("press", 0, &simulation);
    EXPECT_TRUE(response) << last_error();
    EXPECT_GT(calls, 1);
    corpuscle_response_destroy(response);
}

TEST(CInterface, AnExceptionOfASinkStaysInside) {
    auto* const skin = corpuscle_create("sa1", 1000, 1);
    const double frame = 2;
    int code = CORPUSCLE_OK;
    for (int k = 0; k < 1000 && code == CORPUSCLE_OK; ++k)
        code = corpuscle_push(skin, &frame, 1, [](void*, const corpuscle_spike*) { throw 1; }, nullptr);
    EXPECT_EQ(code, CORPUSCLE_BAD_INPUT);
    EXPECT_EQ(last_error(), "a function of the caller threw an exception");
    corpuscle_destroy(skin);
}

TEST(CInterface, EachThreadHasItsOwnError) {
    EXPECT_EQ(corpuscle_create(nullptr, 1000, 1), nullptr);
    std::thread([] {
        EXPECT_EQ(last_error(), "");
        EXPECT_EQ(corpuscle_error_code(), CORPUSCLE_OK);
        EXPECT_EQ(corpuscle_create("sa1", 0, 1), nullptr);
    }).join();
    EXPECT_EQ(last_error(), "population is NULL");
}

TEST(CInterface, ThreadsMayCreateAndDestroyAtTheSameTime) {
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([] {
            for (int k = 0; k < 400; ++k) {
                auto* const force = corpuscle_stimulus("press", nullptr, 0, 100, 0);
                EXPECT_EQ(corpuscle_force_channels(force), 1U);
                corpuscle_force_destroy(force);
                EXPECT_EQ(corpuscle_force_channels(force), 0U);
            }
        });
    for (auto& t : threads) t.join();
}

TEST(CInterface, HasAVersion) {
    EXPECT_EQ(corpuscle_abi(), CORPUSCLE_ABI);
    EXPECT_EQ(std::string(corpuscle_version()).substr(0, 2), "0.");
}

}  // namespace
}  // namespace corpuscle
