#pragma once
// An axis of a sweep: combines the text of the sweep file with the quantity that it varies.

#include <functional>
#include <limits>

#include "study/sweep/sweep_plan.hpp"
#include "study/sweep/sweep_text.hpp"

namespace corpuscle::sweeps {

/// A quantity of a subject that can vary.
struct VariedQuantity {
    SweepColumn column;
    std::optional<double> nominal = {};  ///< value without a setting
    double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
    std::function<Result<double>(const LocatedText&)> parse = {};  ///< converts a text to a number
    /// returns an error if the subject rejects the value; null: min and max are the only check
    std::function<Result<void>(const std::string& value)> check = {};
    /// labels_only: values are labels such as "ss"; allows_labels: values are numbers or labels such as "8x4"
    bool labels_only = false, allows_labels = false;
};

/// Seed and number of samples of the sampled axes. `dimension`: number of axes with Sobol points so far.
struct SamplingSpec {
    std::uint64_t seed = 0;
    std::uint64_t samples = 1;
    std::size_t dimension = 0;
};

/// True if the axis is sampled rather than listed.
bool is_sampled(const AxisSpec&);
/// Combines the text of an axis with its quantity. An axis with Sobol points increments `dimension`.
Result<SweepAxis> axis_of(const AxisSpec&, const VariedQuantity&, SamplingSpec&);

/// An integer from min to max.
Result<std::int64_t> parse_integer(const LocatedText&, std::string_view name, double min, double max);

}  // namespace corpuscle::sweeps
