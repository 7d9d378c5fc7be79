#pragma once
// An axis of a sweep file: what it says, and whom it means, made one.

#include <functional>
#include <limits>

#include "study/sweep/plan.hpp"
#include "study/sweep/text.hpp"

namespace corpuscle::sweeps {

/// Something of a subject that can vary.
struct Target {
    SweepColumn column;
    std::optional<double> nominal = {};  ///< what it is if nothing is said
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    std::function<Result<double>(const Said&)> read = {};              ///< a text as a number
    std::function<Result<void>(const std::string& value)> check = {};  ///< whether the subject takes it; null: low and high say it
    bool words_alone = false, words_too = false;                       ///< "ss"; "8x4"
};

/// How many units and which seed, of the axes that are drawn; `dimension` counts those with Sobol's points.
struct Drawing {
    std::uint64_t seed = 0;
    std::uint64_t draws = 1;
    std::size_t dimension = 0;
};

/// Whether it is drawn rather than listed.
bool is_drawn(const SaidAxis&);
Result<SweepAxis> axis_of(const SaidAxis&, const Target&, Drawing&);

/// A whole number from least to most.
Result<std::int64_t> whole_of(const Said&, std::string_view what, double least, double most);

}  // namespace corpuscle::sweeps
