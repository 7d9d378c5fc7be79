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
    /// Takes the values of the quantity from the axis with this index in the plan. `labels`: of the axis; empty if its values are numbers.
    std::function<void(std::size_t axis, const std::vector<std::string>& labels)> vary = {};
    /// labels_only: all values are labels such as "ss"; allows_labels: values are numbers or labels such as "8x4".
    bool labels_only = false, allows_labels = false;
};

/// True if the values of the axis are random samples, false if they are listed or a grid.
bool is_sampled(const ConfigNode&);
/// Combines the text of an axis with its quantity. `plan`: has seed and number of samples, and the axes that were read before.
Result<SweepAxis> axis_of(const ConfigNode&, const VariedQuantity&, const SweepPlan& plan);

/// Reads an integer from min to max. `name`: what the error message calls it.
Result<std::int64_t> parse_integer(const LocatedText&, std::string_view name, double min, double max);

}  // namespace corpuscle::sweeps
