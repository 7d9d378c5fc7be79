#pragma once
// The search for a minimum from many starting points. Its result does not depend on the number of threads.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/thread_pool.hpp"

namespace corpuscle {

/// The cost of a point in a stage, see FitProblem::stages(). Called from several threads at once.
using CostFunction = std::function<double(std::span<const double> point, std::size_t stage)>;

/// The cost of a point that is not allowed. Larger than any other.
inline constexpr double forbidden_cost = 1e30;

struct SearchOptions {
    std::size_t points = 256;       ///< random points, of which the best are starts
    std::size_t starts = 8;         ///< local searches, of which one begins at the given start
    std::size_t evaluations = 400;  ///< most evaluations of a local search in one stage
    std::size_t stages = 1;
    std::uint64_t seed = 1;  ///< of the random points
    /// Called after each local step with the completed fraction, 0 to 1, by one thread at a time. If it returns false, the search ends with
    /// the best point so far.
    std::function<bool(double)> should_continue = [](double) { return true; };
};

struct SearchResult {
    std::vector<double> point;        ///< the best point
    double cost = forbidden_cost;     ///< in the last stage
    std::vector<double> local_costs;  ///< in the last stage, of each local search
    std::size_t evaluations = 0;
    bool is_interrupted = false;
};

/// Searches the unit cube for the minimum of a cost: random points, then from the best of them and from `start` local searches (Sbplx,
/// Rowan 1990, of NLopt), stage by stage.
SearchResult search_minimum(const CostFunction&, std::span<const double> start, ThreadPool&, const SearchOptions&);

}  // namespace corpuscle
