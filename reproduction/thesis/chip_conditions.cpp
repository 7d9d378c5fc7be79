#include "reproduction/thesis/chip_conditions.hpp"

#include <fmt/format.h>
#include <array>
#include <mutex>
#include <optional>

#include "circuit/batch/chip_batch.hpp"
#include "circuit/variant/netlist_overrides.hpp"
#include "core/thread_pool.hpp"
#include "reproduction/claims/trial.hpp"

namespace corpuscle {
namespace {

using circuit::Chip;
using circuit::ChipResponse;
using circuit::CircuitAfferentFactory;
using Design = std::shared_ptr<const CircuitAfferentFactory>;

/// The chip with the settings of a condition.
Result<Design> design_of(const std::string& chip, const ChipCondition& condition) {
    std::vector<ParameterOverride> overrides;
    for (const auto& text : {fmt::format("corner={}", condition.corner), fmt::format("supply={}", condition.supply),
                             fmt::format("temp={}", condition.celsius), fmt::format("hv_membrane={:d}", condition.high_threshold)})
        overrides.push_back(TRY(circuit::parse_netlist_override(chip, text)));
    const auto netlist = TRY(circuit::apply_overrides(chip, overrides));
    TRY(check_all_used(netlist.unused, std::array{std::string_view(chip)}));
    return CircuitAfferentFactory::create(netlist.result);
}

ConditionResponse response_of(const ChipCondition& condition, const CircuitAfferentFactory& design, ChipResponse&& response) {
    ConditionResponse out{condition, std::move(response.spikes), {}, response.error ? response.error->text() : ""};
    for (std::size_t k = 0; k < response.range_violations.size(); ++k)
        if (response.range_violations[k].samples > 0) out.range_warnings.push_back(design.operating_ranges[k].message);
    return out;
}

/// Hands out the chips of all conditions, each to one thread, and collects their responses.
class ConditionQueue {
    const std::vector<ChipCondition>& conditions_;
    const std::vector<Design>& designs_;
    const TrialForce& force_;
    const std::function<bool(std::size_t)>& progress_;
    std::mutex mutex_;  // protects the members below
    std::size_t next_ = 0, finished_ = 0;
    bool stopped_ = false;
    std::vector<ConditionResponse> responses_;

public:
    ConditionQueue(const std::vector<ChipCondition>& conditions, const std::vector<Design>& designs, const TrialForce& force,
                   const std::function<bool(std::size_t)>& progress)
        : conditions_(conditions), designs_(designs), force_(force), progress_(progress), responses_(conditions.size()) {}

    std::optional<Chip> next() {
        const std::lock_guard lock(mutex_);
        if (stopped_ || next_ == conditions_.size()) return {};
        const auto k = next_++;
        return Chip{static_cast<std::int64_t>(k), designs_[k], {}, force_.force, force_.clock.T()};
    }
    void take(const Chip& chip, ChipResponse&& response) {
        const auto k = static_cast<std::size_t>(chip.id);
        const std::lock_guard lock(mutex_);
        responses_[k] = response_of(conditions_[k], *designs_[k], std::move(response));
        stopped_ = stopped_ || !progress_(++finished_);
    }
    /// The responses, in the order of the conditions.
    Result<std::vector<ConditionResponse>> result() {
        if (stopped_) return Error{ErrorCode::interrupted, "interrupted"};
        return std::move(responses_);
    }
};

}  // namespace

Result<std::vector<ConditionResponse>> run_conditions(const std::string& chip, const std::vector<ChipCondition>& conditions,
                                                      const std::function<bool(std::size_t)>& progress) {
    if (conditions.empty()) return std::vector<ConditionResponse>();
    const auto force = TRY(trial_force({chip}));
    std::vector<Design> designs;
    for (const auto& condition : conditions) designs.push_back(TRY(design_of(chip, condition)));
    ConditionQueue queue(conditions, designs, force, progress);
    std::mutex mutex;
    std::optional<Error> failed;
    ThreadPool pool;
    pool.for_each(pool.threads(), [&](std::size_t, unsigned) {
        // designs[0] stands for all designs, which have the same devices.
        const auto done = circuit::run_chips(
            designs[0], [&] { return queue.next(); }, [&](const Chip& at, ChipResponse&& response) { queue.take(at, std::move(response)); },
            {});
        const std::lock_guard lock(mutex);
        if (!done) failed = done.error();
    });
    return failed ? *failed : queue.result();
}

}  // namespace corpuscle
