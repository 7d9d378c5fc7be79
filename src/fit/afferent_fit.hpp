#pragma once
// Fits parameters of an afferent to data, and judges how well the data determine them.

#include "fit/fit_problem.hpp"
#include "fit/free_parameter.hpp"
#include "fit/search.hpp"

namespace corpuscle {

struct FittedParameter {
    FreeParameter parameter;
    double value = 0;
    std::optional<double> low = {}, high = {};  ///< the 95 % interval; no value: the data do not determine the parameter
    bool is_at_bound = false;                   ///< the best value is at an end of the bounds
};

/// A change of parameters that hardly changes the fit: of one parameter without influence, or of several that trade against each other.
struct ParameterTrade {
    std::vector<std::pair<std::string, double>>
        factors;              ///< name, and the factor of its value; of a parameter without logarithm the new value
    double score_change = 0;  ///< of the score of the fitted data, as simulated
};

struct FitResult {
    AfferentPlan plan;  ///< with the fitted values
    std::vector<FittedParameter> parameters;
    std::vector<ParameterTrade> trades;
    double start_score = 0, score = 0;      ///< of the fitted data, before and after
    std::optional<double> test_score = {};  ///< of the held-out data; no value: nothing is held out
    std::vector<FitRow> rows;
    std::size_t evaluations = 0;
    std::size_t agreeing_starts = 0, starts = 0;  ///< local searches that ended with a score close to the best, and all of them
    bool is_interrupted = false;
    std::vector<std::string> warnings;
};

/// Fits the parameters. If the search is interrupted, the result is the best point so far, without intervals.
Result<FitResult> fit(const FitProblem&, const AfferentPlan&, std::span<const FreeParameter>, ThreadPool&, SearchOptions);

}  // namespace corpuscle
