#include "circuit/batch/chips.hpp"

namespace corpuscle::circuit {

Result<void> run_chips(const std::shared_ptr<const CircuitDesign>&, const std::function<std::optional<Chip>()>& next,
                       const std::function<void(const Chip&, ChipAnswer&&)>& told, const BatchOptions& options) {
    while (const auto chip = next()) {
        auto answer = run_chip_alone(*chip, options);
        if (answer.error && answer.error->code == Code::interrupted) return *answer.error;
        told(*chip, std::move(answer));
    }
    return {};
}

}  // namespace corpuscle::circuit
