// Many chips at once: each answers as it would beside others, on other lanes, and by itself.

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/embedded_netlists.hpp"
#include "circuit/netlist_overrides.hpp"
#include "signal/instruction_set.hpp"
#include "signal/stimuli.hpp"
#include "support/test_paths.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double batch_T = 1e-4;

std::shared_ptr<const CircuitAfferentFactory> design_of(const std::string& file, std::vector<NetlistOverride> knobs = {}) {
    const auto netlist = apply_overrides(file, knobs);
    if (!netlist) throw std::runtime_error(netlist.error().text());
    const auto design = CircuitAfferentFactory::create(*netlist);
    if (!design) throw std::runtime_error(design.error().text());
    return *design;
}

std::vector<double> pushed(std::size_t samples) {
    std::vector<double> force(samples, 0.0);
    for (std::size_t k = samples / 10; k < samples; ++k) force[k] = 1.5;
    return force;
}

using Answers = std::map<std::int64_t, ChipResponse>;

Answers answers_of(const std::vector<Chip>& chips, const std::shared_ptr<const CircuitAfferentFactory>& nominal, const BatchOptions& options = {}) {
    Answers out;
    std::size_t next = 0;
    const auto done = run_chips(
        nominal, [&]() -> std::optional<Chip> { return next < chips.size() ? std::optional(chips[next++]) : std::nullopt; },
        [&](const Chip& chip, ChipResponse&& answer) { EXPECT_TRUE(out.emplace(chip.id, std::move(answer)).second); }, options);
    EXPECT_TRUE(done);
    return out;
}

std::vector<Chip> drawn_chips(const std::shared_ptr<const CircuitAfferentFactory>& design, std::span<const double> force, int count) {
    const ChipSpec chips{static_cast<double>(count), 3};
    std::vector<Chip> out;
    for (int k = 0; k < count; ++k) out.push_back({k, design, chips.sample(static_cast<std::uint64_t>(k)), force, batch_T});
    return out;
}

void expect_same_bytes(const Answers& a, const Answers& b) {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [number, one] : a) {
        const auto& other = b.at(number);
        EXPECT_EQ(one.spikes, other.spikes) << number;
        EXPECT_EQ(one.probes, other.probes) << number;
        EXPECT_EQ(one.energy_use.supplies, other.energy_use.supplies) << number;
        EXPECT_EQ(one.stats.iterations, other.stats.iterations) << number;
        EXPECT_EQ(one.stats.rejected, other.stats.rejected) << number;
    }
}

/// As many spikes, at times no further apart than `allowed`.
void expect_near(const ChipResponse& one, const ChipResponse& other, double allowed) {
    ASSERT_EQ(one.spikes.size(), other.spikes.size());
    for (std::size_t k = 0; k < one.spikes.size(); ++k) EXPECT_NEAR(one.spikes[k], other.spikes[k], allowed);
}

TEST(Batch, AnswersDependOnNoNeighbourAndNoInstructionSet) {
    const auto spiker = design_of(test::project_root() + "/circuits/spiker.cir");
    const auto force = pushed(600);
    auto chips = drawn_chips(spiker, force, 11);
    const auto before = std::getenv("CORPUSCLE_ISA");
    const std::string kept = before ? before : "";
    const auto first = answers_of(chips, spiker, {.lanes = 8, .probe_every = 50});
    for (const auto& [number, answer] : first) EXPECT_GT(answer.spikes.size(), 1u) << number;
    std::reverse(chips.begin(), chips.end());
    for (const std::size_t lanes : {1, 4, 8})
        for (const auto set : instruction_sets()) {
            ::setenv("CORPUSCLE_ISA", std::string(name_of(set)).c_str(), 1);
            expect_same_bytes(first, answers_of(chips, spiker, {.lanes = lanes, .probe_every = 50}));
        }
    before ? ::setenv("CORPUSCLE_ISA", kept.c_str(), 1) : ::unsetenv("CORPUSCLE_ISA");
}

TEST(Batch, AChipOnItsLaneDoesAsByItself) {
    const auto spiker = design_of(test::project_root() + "/circuits/spiker.cir");
    const auto force = pushed(600);
    const BatchOptions options{.probe_every = 50};
    const auto chips = drawn_chips(spiker, force, 6);
    for (const auto& [number, answer] : answers_of(chips, spiker, options)) {
        const auto alone = run_chip_scalar(chips[static_cast<std::size_t>(number)], options);
        EXPECT_FALSE(answer.is_scalar);
        expect_near(answer, alone, 1e-5);
        ASSERT_EQ(answer.probes.size(), alone.probes.size());
        for (std::size_t p = 0; p < alone.probes.size(); ++p) {
            ASSERT_EQ(answer.probes[p].size(), alone.probes[p].size());
            for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(answer.probes[p][k], alone.probes[p][k], 1e-4);  // before it first spikes
        }
        EXPECT_NEAR(answer.energy_use.seconds, alone.energy_use.seconds, 6e-3);  // each to the end of its last step
        EXPECT_NEAR(answer.energy_use.supplies / answer.energy_use.seconds, alone.energy_use.supplies / alone.energy_use.seconds,
                    0.02 * alone.energy_use.supplies / alone.energy_use.seconds);
    }
}

TEST(Batch, ChipsMayDifferInTheirNumbers) {
    const auto nominal = design_of(test::project_root() + "/circuits/spiker.cir");
    const auto large = design_of(test::project_root() + "/circuits/spiker.cir", {{"cu", "3.6p", "cu"}});
    const auto warm = design_of(test::project_root() + "/circuits/spiker.cir", {{"temp", "60", "temp"}});
    const auto force = pushed(500), soft = std::vector<double>(700, 0.7);
    const std::vector<Chip> chips = {
        {0, nominal, {}, force, batch_T}, {1, large, {}, force, batch_T}, {2, warm, {}, force, batch_T}, {3, large, {}, soft, batch_T}};
    const auto answers = answers_of(chips, nominal);
    for (const auto& chip : chips) {
        const auto& answer = answers.at(chip.id);
        EXPECT_FALSE(answer.is_scalar) << chip.id;
        expect_near(answer, run_chip_scalar(chip, {}), 3e-5);
    }
    EXPECT_LT(answers.at(1).spikes.size(), answers.at(0).spikes.size());
}

TEST(Batch, AChipThatNoLaneCanHoldGoesByItself) {
    const auto nominal = design_of(test::project_root() + "/circuits/spiker.cir");
    const auto other = design_of(test::project_root() + "/circuits/sa1_macro.cir");
    const auto force = pushed(300);
    const std::vector<Chip> chips = {{0, nominal, {}, force, batch_T}, {1, other, {}, force, batch_T}, {2, nominal, {}, force, batch_T}};
    const auto answers = answers_of(chips, nominal);
    EXPECT_FALSE(answers.at(0).is_scalar);
    EXPECT_TRUE(answers.at(1).is_scalar);
    EXPECT_EQ(answers.at(1).spikes, run_chip_scalar(chips[1], {}).spikes);
    EXPECT_EQ(answers.at(0).spikes, answers.at(2).spikes);
}

TEST(Batch, AChipStopsAtItsCap) {
    const auto spiker = design_of(test::project_root() + "/circuits/spiker.cir");
    const auto force = pushed(600);
    const auto chips = drawn_chips(spiker, force, 3);
    const auto whole = answers_of(chips, spiker), cut = answers_of(chips, spiker, {.lanes = 4, .max_iterations = 600});
    for (const auto& [number, answer] : cut) {
        EXPECT_GT(whole.at(number).stats.iterations, 700);
        EXPECT_TRUE(answer.hit_iteration_limit);
        EXPECT_GT(answer.stats.iterations, 600);
        EXPECT_LT(answer.stats.iterations, 620);
        const auto& all = whole.at(number).spikes;
        ASSERT_LT(answer.spikes.size(), all.size());
        EXPECT_TRUE(std::equal(answer.spikes.begin(), answer.spikes.end(), all.begin()));
    }
}

TEST(Batch, StopsWhenItIsAskedTo) {
    const auto spiker = design_of(test::project_root() + "/circuits/spiker.cir");
    const auto force = pushed(600);
    int told = 0;
    const auto done = run_chips(
        spiker, [&]() -> std::optional<Chip> { return Chip{0, spiker, {}, force, batch_T}; }, [&](const Chip&, ChipResponse&&) { ++told; },
        {.should_stop = [&] { return true; }});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::interrupted);
    EXPECT_EQ(told, 0);
}

/// The chips of the thesis under the first 0.4 s of a press: as many spikes by either way, and at the same times.
TEST(Chips, OnLanesAndAlone) {
    for (const char* name : {"sa1-circuit", "fa1-circuit"}) {
        const auto design = design_of(name);
        const auto press = make_stimulus("press", {}, 1 / batch_T, 0);
        ASSERT_TRUE(press);
        Frames frames(1, 4000);
        ASSERT_TRUE((*press)->read(frames));
        const auto chips = drawn_chips(design, frames.force[0], 5);
        for (const auto& [number, answer] : answers_of(chips, design)) {
            EXPECT_FALSE(answer.is_scalar);
            expect_near(answer, run_chip_scalar(chips[static_cast<std::size_t>(number)], {}), 2e-4);
            EXPECT_GT(answer.spikes.size(), 0u) << name << " " << number;
        }
    }
}

}  // namespace
}  // namespace corpuscle::circuit
