#pragma once
// An axis of a sweep: combines the text of the sweep file with the quantity that it varies.

#include <functional>
#include <limits>

#include "study/sweep/plan.hpp"
#include "study/sweep/text.hpp"

namespace corpuscle::sweeps {

/// A quantity of a subject that can vary.
struct Target {
    SweepColumn column;
    std::optional<double> nominal = {};  ///< value without a setting
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    std::function<Result<double>(const LocatedText&)> read = {};  ///< converts a text to a number
    /// returns an error if the subject rejects the value; null: low and high are the only check
    std::function<Result<void>(const std::string& value)> check = {};
    /// only labels such as "ss"; or labels such as "8x4" as well as numbers
    bool words_alone = false, words_too = false;
};

/// Number of samples and seed for the axes that are sampled; `dimension` counts those with Sobol points.
struct Drawing {
    std::uint64_t seed = 0;
    std::uint64_t draws = 1;
    std::size_t dimension = 0;
};

/// True if the axis is sampled rather than listed.
bool is_drawn(const SaidAxis&);
Result<SweepAxis> axis_of(const SaidAxis&, const Target&, Drawing&);

/// An integer from min to max.
Result<std::int64_t> whole_of(const LocatedText&, std::string_view name, double min, double max);

}  // namespace corpuscle::sweeps
