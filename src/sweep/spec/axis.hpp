#pragma once
// The axes of a sweep, and the values of each item. Points are all combinations of the listed values; those of the first axis change most
// slowly. Each point has the same number of samples, and the index of an item is point * samples + sample. Sample k is the same chip at
// every point.

#include <functional>
#include <limits>

#include "circuit/variant/netlist_variants.hpp"
#include "sweep/spec/sampling.hpp"
#include "sweep/spec/sweep.hpp"
#include "sweep/spec/sweep_text.hpp"

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

/// An item that is not a combination of the listed values: its values on all axes, and the number of its chip (no value: the nominal one).
struct SweepPoint {
    std::vector<double> values;
    std::optional<std::uint64_t> chip = {};
};

/// The axes of a sweep, and the values of each item.
struct SweepPlan {
    static constexpr double max_items = 1e12;  ///< of one sweep

    std::vector<SweepAxis> axes = {};
    circuit::ChipSpec chips{0, 0, false,
                            false};  ///< whether process, mismatch and noise are sampled; its seed is for all axes, its count is not used
    std::int64_t samples = 1;        ///< number of samples per point
    /// Gives the items instead of the combinations of the listed values; null: these combinations. Thread-safe.
    std::function<SweepPoint(std::int64_t item)> point = {};

    std::int64_t item_count() const;
    bool samples_chips() const { return chips.has_process || chips.has_mismatch || chips.has_noise; }
    /// A column for each axis; then, if the process is sampled, one for each of its four deviates.
    std::vector<SweepColumn> columns() const;
    /// The values of an item, in the order of columns().
    std::vector<double> values(std::int64_t item) const;
    /// Process, mismatch and noise of an item; no value if none is sampled.
    std::optional<circuit::ChipSample> chip_sample(std::int64_t item) const;
};

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
