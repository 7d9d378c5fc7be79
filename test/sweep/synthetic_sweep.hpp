#pragma once
// A synthetic sweep with known results. One measure is linear in the mismatch of three devices and in the process, one is noise, and one is
// sometimes missing. It has three temperatures, with the same chips at each.

#include <cmath>

#include "core/random.hpp"
#include "support/support.hpp"
#include "sweep/spec/mismatch_samples.hpp"
#include "sweep/store/sweep_results.hpp"

namespace corpuscle::test {

class SyntheticSweep final : public Sweep {
    std::int64_t chips_;  // at each temperature
    MismatchSamples mismatch_;

public:
    static constexpr double temps[] = {0, 27, 85};  ///< degrees Celsius
    static constexpr int devices = 40;
    /// The measure line (V) is 0.3 V_T(m7) + 0.2 I_S(m20) - 0.1 V_T(m3) + 0.1 process + 0.15 noise. V_T(m), I_S(m), process and noise are
    /// standard normal deviates. At 85 C it is 1 V higher.
    static constexpr double weight_m7 = 0.3, weight_m20 = 0.2, weight_m3 = -0.1, weight_process = 0.1, weight_noise = 0.15,
                            offset_at_85 = 1;

    explicit SyntheticSweep(std::int64_t chips) : chips_(chips) {
        mismatch_.seed = 5, mismatch_.chips = chips;
        mismatch_.subjects.push_back({"made", {}});
        for (std::uint32_t d = 0; d < devices; ++d)
            mismatch_.subjects[0].devices.push_back({"x1.m" + std::to_string(d), d, d % 2 == 1, 2e-6, 0.5e-6, 4, 2, 5e-3, 0.02});
        item_count = 3 * chips;
        axes = {{"temp", "C", "temperature"}, {"corner", "", "", {"tt", "ss"}}, {"process.vt_n", "", "drawn"}};
        measures = {{"line", "V", "a straight line of what is drawn", {}, -0.5, 0.5}, {"noise", "s", ""}, {"count", "", "", {}, 3.0, {}}};
        train_names = {"out"}, probe_names = {"vf"};
        for (int k = 0; k < 50; ++k) probe_times.push_back(0.02 * k);
        metadata = {{"title", "A made-up sweep"}, {"sweep", "[vary]\n"}, {mismatch_metadata_name, format_mismatch_samples(mismatch_)}};
    }
    const MismatchSamples& mismatch() const { return mismatch_; }
    std::vector<double> values(std::int64_t item) const override {
        return {temps[item / chips_], 0, normal(99, static_cast<std::uint32_t>(item % chips_), 1, 0)};
    }
    Result<void> run_items(const NextItem&, const OutcomeHandler&, const std::function<bool()>&) const override { return {}; }

    ItemOutcome outcome(std::int64_t item) const {
        const auto chip = mismatch_.chip(item);
        const auto deviates = [&](std::size_t d) { return deviates_of(mismatch_.subjects[0].devices[d], mismatch_.seed, {chip}); };
        const double temperature = values(item)[0], noise = normal(7, static_cast<std::uint32_t>(item), 2, 0);
        const double line = weight_m7 * deviates(7).V_T[0] + weight_m20 * deviates(20).I_S[0] + weight_m3 * deviates(3).V_T[0] +
                            weight_process * values(item)[2] + weight_noise * noise + (temperature == 85 ? offset_at_85 : 0);
        ItemOutcome out;
        out.item = item, out.steps = 100 + item % 7, out.iterations = 300 + item % 11;
        out.measures = {line, std::exp(normal(8, static_cast<std::uint32_t>(item), 3, 0)), 4 + static_cast<double>(item % 3)};
        if (item % 50 == 9)
            out.end = ItemEnd::iteration_limit, out.reason = "more than 1000 iterations by 0.4 s", out.measures[2] = std::nan("");
        if (item % 500 == 11)
            out.end = ItemEnd::diverged, out.reason = "did not converge at 0.3 s",
            out.measures = {std::nan(""), std::nan(""), std::nan("")};
        out.spikes.emplace_back();
        for (int k = 0; k < 5 + item % 3; ++k) out.spikes[0].push_back(0.1 * k + 0.02 + 0.004 * line);
        out.probes.emplace_back();
        for (const double t : probe_times) out.probes[0].push_back(static_cast<float>(std::sin(6 * t) + 0.1 * line));
        return out;
    }
};

/// Writes the outcomes of all items to a results file, and returns it opened.
inline SweepResults write_synthetic_results(const std::string& path, const SyntheticSweep& sweep) {
    auto results = value_or_throw(SweepResults::open(path, sweep));
    std::vector<ItemOutcome> all;
    for (std::int64_t item = 0; item < sweep.item_count; ++item) all.push_back(sweep.outcome(item));
    EXPECT_TRUE(results.add(sweep, std::move(all)) && results.checkpoint());
    return results;
}

}  // namespace corpuscle::test
