#pragma once
// The values of each item of a sweep. Points are all combinations of the listed values, the first axis slowest. Each point has the same
// number of samples: item = point * samples + sample. The same sample is the same chip at every point.

#include <optional>

#include "circuit/netlist_variants.hpp"
#include "study/sweep/sampling.hpp"
#include "study/sweep/sweep.hpp"

namespace corpuscle::sweeps {

/// One quantity that varies and has a value.
struct SweepAxis {
    SweepColumn column;
    std::vector<double> values = {};             ///< listed values, labels as their indexes; empty if sampled
    std::optional<UniformNumbers> numbers = {};  ///< for a sampled axis
    bool is_normal = false, is_logarithmic = false;
    double first = 0, second = 0;                     ///< normal: mean and standard deviation; otherwise from and to
    double min_probability = 0, max_probability = 1;  ///< for a truncated normal distribution: range of its cumulative probability

    /// The value of a sampled axis for this sample.
    double sample(std::uint64_t index) const;
};

class SweepPlan {
    std::vector<SweepAxis> axes_;
    std::vector<SweepColumn> columns_;
    circuit::ChipSpec chips_;
    std::int64_t samples_ = 1, points_ = 1;

public:
    static constexpr double max_items = 1e12;

    SweepPlan() = default;
    /// `chips`: the seed, and whether process and mismatch are sampled.
    SweepPlan(std::vector<SweepAxis> axes, const circuit::ChipSpec& chips, std::int64_t samples);

    const std::vector<SweepAxis>& axes() const { return axes_; }
    /// One for each axis; then, if the process is sampled, its four deviates.
    const std::vector<SweepColumn>& columns() const { return columns_; }
    const circuit::ChipSpec& chips() const { return chips_; }
    std::int64_t samples() const { return samples_; }
    std::int64_t item_count() const { return points_ * samples_; }
    bool samples_chips() const { return chips_.has_process || chips_.has_mismatch; }

    /// In the order of the columns.
    std::vector<double> values(std::int64_t item) const;
    std::optional<circuit::ChipSample> chip_sample(std::int64_t item) const;
};

}  // namespace corpuscle::sweeps
