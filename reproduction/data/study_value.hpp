#pragma once
// The values of the expressions in a study's data file: numbers, curves, lists, and the results of runs and trials.

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "measure/measure_base.hpp"
#include "reproduction/claims/study_netlist.hpp"
#include "reproduction/claims/trial.hpp"

namespace corpuscle {

using StudyList = std::vector<double>;        ///< spike times, or one value for each chip
using StudyRun = std::vector<NetlistResult>;  ///< the results of all variants of a netlist
struct StudyTrial {
    TrialForce force;
    TrialResult result;  ///< empty if the trial has no afferent
};

using StudyValue = std::variant<double, StudyCurve, StudyList, TimeWindow, std::string, std::shared_ptr<const StudyRun>,
                                std::shared_ptr<const StudyTrial>>;
using StudyValues = std::map<std::string, StudyValue, std::less<>>;

/// The kind of a value: the letter of the signatures in study_functions.cpp, and its name in messages.
struct StudyValueKind {
    char letter;
    const char* name;
};
inline constexpr StudyValueKind study_value_kinds[] = {  // in the order of StudyValue
    {'n', "a number"}, {'c', "a curve"}, {'l', "a list"}, {'w', "a time window"}, {'t', "a text"}, {'r', "a run"}, {'s', "a trial"}};
inline const StudyValueKind& kind_of(const StudyValue& value) { return study_value_kinds[value.index()]; }

}  // namespace corpuscle
