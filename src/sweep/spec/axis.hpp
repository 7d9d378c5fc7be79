#pragma once
// An axis of a sweep: combines the text of the sweep file with the quantity that it varies.

#include <functional>
#include <limits>

#include "sweep/spec/sweep_plan.hpp"
#include "sweep/spec/sweep_text.hpp"

namespace corpuscle::sweeps {

/// A quantity that can vary, such as a parameter. The subject of a sweep is the afferent or netlist that is simulated.
struct VariedQuantity {
    SweepColumn column;
    std::optional<double> nominal = {};  ///< value if it does not vary; no value: the subject has no default for it
    /// Range that the subject allows.
    double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
    std::function<Result<double>(const LocatedText&)> parse = {};  ///< converts a text such as "2 N" to a number in the unit of `column`
    /// Returns an error if the subject rejects the value. Null: min and max are the only check.
    std::function<Result<void>(const std::string& value)> check = {};
    /// labels_only: all values are labels such as "ss"; allows_labels: values are numbers or labels such as "8x4".
    bool labels_only = false, allows_labels = false;
};

/// Seed and number of samples of the sampled axes.
struct SamplingSpec {
    std::uint64_t seed = 0;
    std::uint64_t samples = 1;
    std::size_t dimension = 0;  ///< Sobol dimension of the next axis with Sobol points: the number of such axes read so far
};

/// True if the values of the axis are random samples, false if they are listed or a grid.
bool is_sampled(const ConfigNode&);
/// Combines the text of an axis with its quantity. An axis with Sobol points increments the `dimension` of the sampling.
Result<SweepAxis> axis_of(const ConfigNode&, const VariedQuantity&, SamplingSpec&);

/// Reads an integer from min to max. `name`: what the error message calls it.
Result<std::int64_t> parse_integer(const LocatedText&, std::string_view name, double min, double max);

}  // namespace corpuscle::sweeps
