#pragma once
// A sweep whose work items take almost no time and have known results, for tests of the results database and of the runners.

#include <chrono>
#include <cmath>
#include <thread>

#include "sweep/spec/sweep.hpp"

namespace corpuscle::test {

/// Every 97th item reaches the iteration limit, and the item after it diverges. The second measure is missing in every fifth item.
class PlainSweep : public Sweep {
    double seconds_per_item_;  // run time of a work item, s

public:
    explicit PlainSweep(std::int64_t items, std::string netlist = "a\nb\nc\n", double seconds = 0) : seconds_per_item_(seconds) {
        item_count = items;
        axes = {{"gain", "", "factor of the force"}, {"kind", "", "parity of the item", {"even", "odd"}}};
        measures = {{"rate", "Hz", "rate of spikes"},
                    {"Rate", "Hz", "a name that differs only in case"},
                    {"why", "", "named like a column of every sweep", {}, 0.25, 0.75}};
        train_names = {"sa1", "fa1"}, probe_names = {"v(u)"};
        probe_times = {0, 0.1, 0.2, 0.3};
        metadata = {{"title", "plain"}, {"netlist circuits/sa1.cir", std::move(netlist)}};
    }
    std::vector<double> values(std::int64_t item) const override {
        return {0.5 + static_cast<double>(item) / 7, static_cast<double>(item % 2)};
    }

    virtual ItemOutcome outcome(std::int64_t item) const {
        ItemOutcome o{item};
        const auto x = static_cast<double>(item % 1000) / 1000;
        if (item % 97 == 5) o.end = ItemEnd::iteration_limit, o.reason = "more than 1000 iterations";
        if (item % 97 == 6) return o.end = ItemEnd::diverged, o.reason = "no rest", o;
        o.measures = {100 * x, item % 5 == 0 ? std::nan("") : -x, x * x};
        o.spikes.resize(2);
        for (std::int64_t k = 0; k < item % 4; ++k) o.spikes[0].push_back(x + 0.1 * static_cast<double>(k));
        if (item % 3 == 0) o.spikes[1] = {1 / (1 + x)};
        if (item % 10 == 0) o.probes = {{0, 1, static_cast<float>(x), 3}};
        o.steps = item, o.iterations = 3 * item, o.ran_alone = item % 50 == 0;
        return o;
    }

    Result<void> run_items(const NextItem& next, const OutcomeHandler& handle_outcome, const std::function<bool()>& stop) const override {
        for (auto item = next(); item; item = next()) {
            if (stop()) return {};
            if (seconds_per_item_ > 0) std::this_thread::sleep_for(std::chrono::duration<double>(seconds_per_item_));
            handle_outcome(outcome(*item));
        }
        return {};
    }
};

}  // namespace corpuscle::test
