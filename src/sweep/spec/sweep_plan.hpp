#pragma once
// The values of each item of a sweep. Points are all combinations of the listed values; those of the first axis change most slowly. Each
// point has the same number of samples, and the index of an item is point * samples + sample. Sample k is the same chip at every point.

#include <optional>

#include "circuit/variant/netlist_variants.hpp"
#include "sweep/spec/sampling.hpp"
#include "sweep/spec/sweep.hpp"

namespace corpuscle::sweeps {

/// One quantity that varies.
struct SweepAxis {
    SweepColumn column;
    std::vector<double> values = {};                  ///< listed values; of labels: their indexes; empty for a sampled axis
    std::optional<UniformNumbers> numbers = {};       ///< of a sampled axis; the following members, too
    bool is_normal = false, is_logarithmic = false;   ///< distribution: normal, uniform in the logarithm, or (both false) uniform
    double first = 0, second = 0;                     ///< normal: mean and standard deviation; otherwise: smallest and largest value
    double min_probability = 0, max_probability = 1;  ///< normal: cumulative probabilities at which it is truncated

    /// The value of a sampled axis for the sample with this index.
    double sample(std::uint64_t index) const;
};

/// The axes of a sweep, and the values of each item.
struct SweepPlan {
    static constexpr double max_items = 1e12;  ///< of one sweep

    std::vector<SweepAxis> axes = {};
    circuit::ChipSpec chips{0, 0, false,
                            false};  ///< whether process and mismatch are sampled; its seed is for all axes, its count is not used
    std::int64_t samples = 1;        ///< number of samples per point

    std::int64_t item_count() const;
    bool samples_chips() const { return chips.has_process || chips.has_mismatch; }
    /// A column for each axis; then, if the process is sampled, one for each of its four deviates.
    std::vector<SweepColumn> columns() const;
    /// The values of an item, in the order of columns().
    std::vector<double> values(std::int64_t item) const;
    /// Process and mismatch of an item; no value if neither is sampled.
    std::optional<circuit::ChipSample> chip_sample(std::int64_t item) const;
};

}  // namespace corpuscle::sweeps
