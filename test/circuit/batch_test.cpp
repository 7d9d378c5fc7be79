// Batched simulation of chips: each response is independent of the other chips and the lane, and equals that of a scalar run.

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "core/number/instruction_set.hpp"
#include "core/stimulus/stimuli.hpp"
#include "support/support.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double batch_T = 1e-4;

std::shared_ptr<const CircuitAfferentFactory> design_of(const std::string& file, const std::vector<std::string>& settings = {}) {
    std::vector<ParameterOverride> overrides;
    for (const auto& text : settings) overrides.push_back(test::value_or_throw(parse_netlist_override(file, text)));
    return test::value_or_throw(CircuitAfferentFactory::create(test::applied_or_throw(apply_overrides(file, overrides))));
}

/// 0 N, then 1.5 N after a tenth of the samples.
std::vector<double> force_step(std::size_t samples) {
    std::vector<double> force(samples, 0.0);
    for (std::size_t k = samples / 10; k < samples; ++k) force[k] = 1.5;
    return force;
}

using Responses = std::map<std::int64_t, ChipResponse>;

Responses responses_of(const std::vector<Chip>& chips, const std::shared_ptr<const CircuitAfferentFactory>& nominal,
                       const BatchOptions& options = {}) {
    Responses out;
    std::size_t next = 0;
    const auto done = run_chips(
        nominal, [&]() -> std::optional<Chip> { return next < chips.size() ? std::optional(chips[next++]) : std::nullopt; },
        [&](const Chip& chip, ChipResponse&& response) { EXPECT_TRUE(out.emplace(chip.id, std::move(response)).second); }, options);
    EXPECT_TRUE(done);
    return out;
}

std::vector<Chip> sampled_chips(const std::shared_ptr<const CircuitAfferentFactory>& design, std::span<const double> force, int count) {
    const ChipSpec chips{static_cast<double>(count), 3};
    std::vector<Chip> out;
    for (int k = 0; k < count; ++k) out.push_back({k, design, chips.sample(static_cast<std::uint64_t>(k)), force, batch_T});
    return out;
}

void expect_same_bytes(const Responses& a, const Responses& b) {
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

/// Expects equal numbers of spikes, and spike times that differ by at most `allowed` (s).
void expect_near(const ChipResponse& one, const ChipResponse& other, double allowed) {
    ASSERT_EQ(one.spikes.size(), other.spikes.size());
    for (std::size_t k = 0; k < one.spikes.size(); ++k) EXPECT_NEAR(one.spikes[k], other.spikes[k], allowed);
}

/// Selects an instruction set by the environment variable, until it is destroyed.
class InstructionSetVariable {
    std::optional<std::string> before_;

public:
    explicit InstructionSetVariable(InstructionSet set) {
        if (const char* before = std::getenv("CORPUSCLE_ISA")) before_ = before;
        ::setenv("CORPUSCLE_ISA", std::string(name_of(set)).c_str(), 1);
    }
    InstructionSetVariable(const InstructionSetVariable&) = delete;
    ~InstructionSetVariable() { before_ ? ::setenv("CORPUSCLE_ISA", before_->c_str(), 1) : ::unsetenv("CORPUSCLE_ISA"); }
};

TEST(Batch, ResponsesDoNotDependOnOtherChipsOrTheInstructionSet) {
    const auto spiker = design_of(test::source_root() + "/circuits/spiker.cir");
    const auto force = force_step(600);
    auto chips = sampled_chips(spiker, force, 11);
    const auto first = responses_of(chips, spiker, {.lanes = 8, .probe_every = 50});
    for (const auto& [number, response] : first) EXPECT_GT(response.spikes.size(), 1u) << number;
    std::reverse(chips.begin(), chips.end());
    for (const std::size_t lanes : {1, 4, 8})
        for (const auto set : instruction_sets()) {
            const InstructionSetVariable variable(set);
            expect_same_bytes(first, responses_of(chips, spiker, {.lanes = lanes, .probe_every = 50}));
        }
}

TEST(Batch, ABatchedChipRespondsLikeAScalarOne) {
    const auto spiker = design_of(test::source_root() + "/circuits/spiker.cir");
    const auto force = force_step(600);
    const BatchOptions options{.probe_every = 50};
    const auto chips = sampled_chips(spiker, force, 6);
    for (const auto& [number, response] : responses_of(chips, spiker, options)) {
        const auto scalar = run_chip_scalar(chips[static_cast<std::size_t>(number)], options);
        EXPECT_FALSE(response.is_scalar);
        expect_near(response, scalar, 1e-5);
        ASSERT_EQ(response.probes.size(), scalar.probes.size());
        for (std::size_t p = 0; p < scalar.probes.size(); ++p) {
            ASSERT_EQ(response.probes[p].size(), scalar.probes[p].size());
            for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(response.probes[p][k], scalar.probes[p][k], 1e-4);  // before the first spike
        }
        // the runs end at different times, each at the end of its last step
        EXPECT_NEAR(response.energy_use.seconds, scalar.energy_use.seconds, 6e-3);
        EXPECT_NEAR(response.energy_use.supplies / response.energy_use.seconds, scalar.energy_use.supplies / scalar.energy_use.seconds,
                    0.02 * scalar.energy_use.supplies / scalar.energy_use.seconds);
    }
}

TEST(Batch, NoiseOfAChipDoesNotDependOnOtherChipsOrTheInstructionSet) {
    const auto spiker = design_of(test::source_root() + "/circuits/spiker.cir", {"noisefmax=2k"});
    const auto force = force_step(600);
    const ChipSpec only_noise{.count = 0, .seed = 3, .has_process = false, .has_mismatch = false};
    std::vector<Chip> chips;
    for (int k = 0; k < 9; ++k) chips.push_back({k, spiker, only_noise.sample(static_cast<std::uint64_t>(k)), force, batch_T});
    const auto first = responses_of(chips, spiker, {.lanes = 8, .probe_every = 50});
    EXPECT_NE(first.at(0).spikes, first.at(1).spikes);
    const auto without = run_chip_scalar({0, design_of(test::source_root() + "/circuits/spiker.cir"), {}, force, batch_T}, {});
    for (const auto& [number, response] : first) {
        EXPECT_FALSE(response.is_scalar);
        expect_near(response, run_chip_scalar(chips[static_cast<std::size_t>(number)], {}), 5e-5);
        expect_near(response, without, 3e-3);
    }
    std::reverse(chips.begin(), chips.end());
    for (const std::size_t lanes : {1, 4})
        for (const auto set : instruction_sets()) {
            const InstructionSetVariable variable(set);
            expect_same_bytes(first, responses_of(chips, spiker, {.lanes = lanes, .probe_every = 50}));
        }
}

TEST(Batch, ChipsMayDifferInTheirParameters) {
    const auto nominal = design_of(test::source_root() + "/circuits/spiker.cir");
    const auto large = design_of(test::source_root() + "/circuits/spiker.cir", {"cu=3.6p"});
    const auto warm = design_of(test::source_root() + "/circuits/spiker.cir", {"temp=60"});
    const auto force = force_step(500), soft = std::vector<double>(700, 0.7);
    const std::vector<Chip> chips = {
        {0, nominal, {}, force, batch_T}, {1, large, {}, force, batch_T}, {2, warm, {}, force, batch_T}, {3, large, {}, soft, batch_T}};
    const auto responses = responses_of(chips, nominal);
    for (const auto& chip : chips) {
        const auto& response = responses.at(chip.id);
        EXPECT_FALSE(response.is_scalar) << chip.id;
        expect_near(response, run_chip_scalar(chip, {}), 3e-5);
    }
    EXPECT_LT(responses.at(1).spikes.size(), responses.at(0).spikes.size());
}

TEST(Batch, AChipThatCannotBeBatchedRunsScalar) {
    const auto nominal = design_of(test::source_root() + "/circuits/spiker.cir");
    const auto other = design_of(test::source_root() + "/circuits/sa1_macro.cir");
    const auto force = force_step(300);
    const std::vector<Chip> chips = {{0, nominal, {}, force, batch_T}, {1, other, {}, force, batch_T}, {2, nominal, {}, force, batch_T}};
    const auto responses = responses_of(chips, nominal);
    EXPECT_FALSE(responses.at(0).is_scalar);
    EXPECT_TRUE(responses.at(1).is_scalar);
    EXPECT_EQ(responses.at(1).spikes, run_chip_scalar(chips[1], {}).spikes);
    EXPECT_EQ(responses.at(0).spikes, responses.at(2).spikes);
}

TEST(Batch, AChipStopsAtItsIterationLimit) {
    const auto spiker = design_of(test::source_root() + "/circuits/spiker.cir");
    const auto force = force_step(600);
    const auto chips = sampled_chips(spiker, force, 3);
    const auto complete = responses_of(chips, spiker), limited = responses_of(chips, spiker, {.lanes = 4, .max_iterations = 600});
    for (const auto& [number, response] : limited) {
        EXPECT_GT(complete.at(number).stats.iterations, 700);
        EXPECT_TRUE(response.hit_iteration_limit);
        EXPECT_GT(response.stats.iterations, 600);
        EXPECT_LT(response.stats.iterations, 620);
        const auto& all = complete.at(number).spikes;
        ASSERT_LT(response.spikes.size(), all.size());
        EXPECT_TRUE(std::equal(response.spikes.begin(), response.spikes.end(), all.begin()));
    }
}

TEST(Batch, AChipWithoutForceHasAnErrorAndTheOthersRun) {
    const auto spiker = design_of(test::source_root() + "/circuits/spiker.cir");
    const auto force = force_step(600);
    for (const std::size_t lanes : {1, 8}) {
        const auto responses = responses_of({{0, spiker, {}, {}, batch_T}, {1, spiker, {}, force, batch_T}}, spiker, {.lanes = lanes});
        ASSERT_TRUE(responses.at(0).error);
        EXPECT_EQ(responses.at(0).error->message, "the force has no samples");
        EXPECT_GT(responses.at(1).spikes.size(), 1u);
    }
}

TEST(Batch, StopsOnRequest) {
    const auto spiker = design_of(test::source_root() + "/circuits/spiker.cir");
    const auto force = force_step(600);
    int count = 0;
    const auto done = run_chips(
        spiker, [&]() -> std::optional<Chip> { return Chip{0, spiker, {}, force, batch_T}; }, [&](const Chip&, ChipResponse&&) { ++count; },
        {.should_stop = [&] { return true; }});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::interrupted);
    EXPECT_EQ(count, 0);
}

/// The chips of the thesis under the first 0.4 s of a press.
TEST(Chips, RespondTheSameBatchedAndScalar) {
    for (const char* name : {"sa1-circuit", "fa1-circuit"}) {
        const auto design = design_of(name);
        const auto press = make_stimulus("press", 1 / batch_T, 0);
        ASSERT_TRUE(press);
        Frames frames(1, 4000);
        ASSERT_TRUE((*press)->read(frames));
        const auto chips = sampled_chips(design, frames.force[0], 5);
        for (const auto& [number, response] : responses_of(chips, design)) {
            EXPECT_FALSE(response.is_scalar);
            expect_near(response, run_chip_scalar(chips[static_cast<std::size_t>(number)], {}), 2e-4);
            EXPECT_GT(response.spikes.size(), 0u) << name << " " << number;
        }
    }
}

}  // namespace
}  // namespace corpuscle::circuit
