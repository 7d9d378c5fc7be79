#pragma once
// A table of published numbers to which an afferent is fitted, as a CSV file: one row for each number.

#include "core/parameter_override.hpp"
#include "fit/targets/target_measures.hpp"

namespace corpuscle {

/// One number that the afferent should have.
struct TargetRow {
    std::string stimulus;                                  ///< "ramp-hold", "press+noise"
    std::vector<ParameterOverride> settings;               ///< of the stimulus
    std::string settings_text;                             ///< as in the file
    std::string measure_text;                              ///< as in the file: "mean_rate@plateau"
    const TargetMeasure* measure = nullptr;                ///< never null
    std::string phase;                                     ///< "": the whole stimulus, unless there is a window
    std::optional<std::pair<double, double>> window = {};  ///< s, from the start of the stimulus
    double value = 0, low = 0, high = 0;                   ///< target and its range, in the unit of the measure
    double weight = 1;
    bool is_test = false;  ///< column set: test
    std::string source;
    SourceLocation location, measure_location;
};

/// Reads a table. Its columns, by their names, are:
///
/// - stimulus: as for `corpuscle respond`; settings: of the stimulus, "F_max=4N; t_up=100ms", may be empty
/// - measure: a name of target_measures(), in a phase ("mean_rate@plateau") or a window ("mean_rate@0.4s..0.6s") or in the whole stimulus
/// - value, low, high: numbers with or without a unit; low and high, which may be missing, are a 95 % range, by default 20 % around value
/// - weight (1), set (train or test), source: optional
///
/// Other columns are errors.
Result<std::vector<TargetRow>> read_targets(const std::string& path);

}  // namespace corpuscle
