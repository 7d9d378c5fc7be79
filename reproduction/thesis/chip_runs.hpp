#pragma once
// Many chips of the same devices, simulated side by side on SIMD lanes and threads.

#include <functional>
#include <vector>

#include "circuit/batch/chip_batch.hpp"

namespace corpuscle {

/// Simulates chips, and returns their responses in the same order. Their `id` is ignored. `progress`: called now and then with the number
/// of finished chips; must return false to stop, which is an error of code `interrupted`. A chip that does not converge says so in its
/// response.
Result<std::vector<circuit::ChipResponse>> run_all_chips(std::vector<circuit::Chip>, const std::function<bool(std::size_t)>& progress);

}  // namespace corpuscle
