#include "reproduction/data/study_functions.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "circuit/expression/expression_operations.hpp"
#include "core/parameter.hpp"
#include "measure/train_distance.hpp"
#include "reproduction/claims/claim.hpp"
#include "reproduction/claims/histogram.hpp"
#include "reproduction/claims/sample_statistics.hpp"
#include "reproduction/data/curve_functions.hpp"
#include "reproduction/thesis/force_sensor.hpp"
#include "reproduction/thesis/press.hpp"
#include "reproduction/thesis/spike_timing_error.hpp"

namespace corpuscle {
namespace {

/// The arguments of a function, whose kinds its signature has checked.
struct FunctionArguments {
    std::span<const StudyValue> values;
    double number(std::size_t k) const { return std::get<double>(values[k]); }
    const StudyCurve& curve(std::size_t k) const { return std::get<StudyCurve>(values[k]); }
    const StudyList& list(std::size_t k) const { return std::get<StudyList>(values[k]); }
    const TimeWindow& window(std::size_t k) const { return std::get<TimeWindow>(values[k]); }
    const StudyTrial& trial(std::size_t k) const { return *std::get<std::shared_ptr<const StudyTrial>>(values[k]); }
};

struct StudyFunction {
    std::string_view name, signature;  ///< signature: the letter of each argument's kind (study_value_kinds)
    StudyValue (*value)(const FunctionArguments&);
};
using Inputs = const FunctionArguments&;

template <class M>
double measured(Inputs a) {
    return measure<M>(a.list(0), a.window(1));
}

/// The timing error of the train in argument 1 with respect to the train in argument 0.
SpikeTimingError timing_error(Inputs a) {
    const auto error = spike_timing_error(a.list(0), a.list(1));
    return error ? *error : SpikeTimingError{Claim::none, Claim::none, Claim::none, Claim::none};
}

constexpr StudyFunction study_functions[] = {
    // curves
    {"at", "cc", [](Inputs a) -> StudyValue { return composed(a.curve(0), a.curve(1)); }},
    {"at", "cn", [](Inputs a) -> StudyValue { return a.curve(0).at(a.number(1)); }},
    {"above", "cn", [](Inputs a) -> StudyValue { return above(a.curve(0), a.number(1)); }},
    {"between", "cnn", [](Inputs a) -> StudyValue { return a.curve(0).between(a.number(1), a.number(2)); }},
    {"between", "cw", [](Inputs a) -> StudyValue { return a.curve(0).between(a.window(1).from, a.window(1).to); }},
    {"charge", "cw", [](Inputs a) -> StudyValue { return charge(a.curve(0), a.window(1)); }},
    {"crossing", "cn", [](Inputs a) -> StudyValue { return a.curve(0).crossing(a.number(1)); }},
    {"crossing", "cnn", [](Inputs a) -> StudyValue { return a.curve(0).crossing(a.number(1), a.number(2)); }},
    {"curve", "ll", [](Inputs a) -> StudyValue { return StudyCurve{a.list(0), a.list(1)}; }},
    {"decades", "nnn", [](Inputs a) -> StudyValue { return decades(a.number(0), a.number(1), a.number(2)); }},
    {"falling_part", "c", [](Inputs a) -> StudyValue { return falling_part(a.curve(0)); }},
    {"first", "c", [](Inputs a) -> StudyValue { return a.curve(0).empty() ? Claim::none : a.curve(0).y.front(); }},
    {"last", "c", [](Inputs a) -> StudyValue { return a.curve(0).empty() ? Claim::none : a.curve(0).y.back(); }},
    {"first_x_below", "cn", [](Inputs a) -> StudyValue { return first_x_below(a.curve(0), a.number(1)); }},
    {"is_falling", "c", [](Inputs a) -> StudyValue { return is_falling(a.curve(0)); }},
    {"is_rising", "c", [](Inputs a) -> StudyValue { return is_rising(a.curve(0)); }},
    {"flat_range", "cn", [](Inputs a) -> StudyValue { return flat_range(a.curve(0), a.number(1)); }},
    {"integral_above", "cn", [](Inputs a) -> StudyValue { return integral_above(a.curve(0), a.number(1)); }},
    {"largest", "c", [](Inputs a) -> StudyValue { return largest(a.curve(0)); }},
    {"largest_step", "c", [](Inputs a) -> StudyValue { return largest_step(a.curve(0)); }},
    {"last_x_below", "cn", [](Inputs a) -> StudyValue { return last_x_below(a.curve(0), a.number(1)); }},
    {"last_crossing", "cnn", [](Inputs a) -> StudyValue { return last_crossing(a.curve(0), a.number(1), a.number(2)); }},
    {"line_deviation", "c", [](Inputs a) -> StudyValue { return a.curve(0).fit_line().max_deviation; }},
    {"line_intercept", "c", [](Inputs a) -> StudyValue { return a.curve(0).fit_line().intercept; }},
    {"line_slope", "c", [](Inputs a) -> StudyValue { return a.curve(0).fit_line().slope; }},
    {"longest_time_above", "cn", [](Inputs a) -> StudyValue { return longest_time_above(a.curve(0), a.number(1)); }},
    {"max", "c", [](Inputs a) -> StudyValue { return a.curve(0).max(); }},
    {"min", "c", [](Inputs a) -> StudyValue { return a.curve(0).min(); }},
    {"min_jump_ratio", "cln", [](Inputs a) -> StudyValue { return min_jump_ratio(a.curve(0), a.list(1), a.number(2)); }},
    {"moved", "cn", [](Inputs a) -> StudyValue { return moved_along_x(a.curve(0), a.number(1)); }},
    {"moved", "cnn", [](Inputs a) -> StudyValue { return moved(a.curve(0), a.number(1), a.number(2)); }},
    {"over", "cc", [](Inputs a) -> StudyValue { return over(a.curve(0), a.curve(1)); }},
    {"range_above", "cn", [](Inputs a) -> StudyValue { return range_above(a.curve(0), a.number(1)); }},
    {"resampled", "cn", [](Inputs a) -> StudyValue { return a.curve(0).resampled(a.number(1)); }},
    {"resets", "c", [](Inputs a) -> StudyValue { return count_resets(a.curve(0)); }},
    {"rising_part", "c", [](Inputs a) -> StudyValue { return rising_part(a.curve(0)); }},
    {"scaled", "cnn", [](Inputs a) -> StudyValue { return a.curve(0).scaled(a.number(1), a.number(2)); }},
    {"slope", "c", [](Inputs a) -> StudyValue { return a.curve(0).slope(); }},
    {"steps", "nnn", [](Inputs a) -> StudyValue { return steps(a.number(0), a.number(1), a.number(2)); }},
    {"swapped", "c", [](Inputs a) -> StudyValue { return StudyCurve{a.curve(0).y, a.curve(0).x}; }},
    {"x", "c", [](Inputs a) -> StudyValue { return StudyCurve{a.curve(0).x, a.curve(0).x}; }},  // y = x
    {"x_of_max", "c", [](Inputs a) -> StudyValue { return a.curve(0).x_of_max(); }},
    // lists
    {"cv_percent", "l", [](Inputs a) -> StudyValue { return sample_statistics(a.list(0)).cv_percent(); }},
    {"deviation", "l", [](Inputs a) -> StudyValue { return sample_statistics(a.list(0)).standard_deviation; }},
    {"first", "l", [](Inputs a) -> StudyValue { return a.list(0).empty() ? Claim::none : a.list(0).front(); }},
    {"histogram", "l", [](Inputs a) -> StudyValue { return histogram_of(a.list(0)); }},
    {"last", "l", [](Inputs a) -> StudyValue { return a.list(0).empty() ? Claim::none : a.list(0).back(); }},
    {"mean", "l", [](Inputs a) -> StudyValue { return sample_statistics(a.list(0)).mean; }},
    {"size", "l", [](Inputs a) -> StudyValue { return static_cast<double>(a.list(0).size()); }},
    {"max", "l",
     [](Inputs a) -> StudyValue { return a.list(0).empty() ? Claim::none : *std::max_element(a.list(0).begin(), a.list(0).end()); }},
    {"min", "l",
     [](Inputs a) -> StudyValue { return a.list(0).empty() ? Claim::none : *std::min_element(a.list(0).begin(), a.list(0).end()); }},
    {"element", "ln", [](Inputs a) -> StudyValue { return element(a.list(0), a.number(1)); }},
    // spike trains
    {"before", "ln", [](Inputs a) -> StudyValue { return before(a.list(0), a.number(1)); }},
    {"intervals", "l", [](Inputs a) -> StudyValue { return intervals(a.list(0)); }},
    {"count", "lw", [](Inputs a) -> StudyValue { return press::spike_count(a.list(0), a.window(1)); }},
    {"first_rate", "lw", [](Inputs a) -> StudyValue { return measured<FirstRate>(a); }},
    {"frequency_at_end", "l", [](Inputs a) -> StudyValue { return press::frequency_at_end(a.list(0)); }},
    {"frequency_at_start", "l", [](Inputs a) -> StudyValue { return press::frequency_at_start(a.list(0)); }},
    {"latency", "lw", [](Inputs a) -> StudyValue { return measured<Latency>(a); }},
    {"last_rate", "lw", [](Inputs a) -> StudyValue { return measured<LastRate>(a); }},
    {"mean_rate", "lw", [](Inputs a) -> StudyValue { return measured<MeanRate>(a); }},
    {"median_delay", "ll", [](Inputs a) -> StudyValue { return timing_error(a).median; }},
    {"peak_rate", "lw", [](Inputs a) -> StudyValue { return measured<PeakRate>(a); }},
    {"phase_counts", "l", [](Inputs a) -> StudyValue { return press::phase_counts(a.list(0)); }},
    {"rms_error", "ll", [](Inputs a) -> StudyValue { return timing_error(a).rms; }},
    {"unmatched", "ll", [](Inputs a) -> StudyValue { return timing_error(a).unmatched; }},
    {"van_rossum", "lln", [](Inputs a) -> StudyValue { return std::sqrt(van_rossum_squared(a.list(0), a.list(1), a.number(2))); }},
    // time windows and trials
    {"force", "s", [](Inputs a) -> StudyValue { return a.trial(0).force.curve(); }},
    {"from", "w", [](Inputs a) -> StudyValue { return a.window(0).from; }},
    {"spikes", "s", [](Inputs a) -> StudyValue { return a.trial(0).result.spikes; }},
    {"to", "w", [](Inputs a) -> StudyValue { return a.window(0).to; }},
    {"window", "nn", [](Inputs a) -> StudyValue { return TimeWindow{a.number(0), a.number(1)}; }},
    // logarithms and exponentials of the C library; netlist expressions compute theirs with other rounding errors
    {"exp", "n", [](Inputs a) -> StudyValue { return std::exp(a.number(0)); }},
    {"log", "n", [](Inputs a) -> StudyValue { return std::log(a.number(0)); }},
    {"log10", "n", [](Inputs a) -> StudyValue { return std::log10(a.number(0)); }},
    // the thesis's force sensor: conductance, S, and its slope, S/gf, over the force, gf
    {"conductance", "n", [](Inputs a) -> StudyValue { return sensor_conductance(a.number(0)); }},
    {"conductance_slope", "n", [](Inputs a) -> StudyValue { return sensor_slope(a.number(0)); }},
};

/// The operator or function of expressions with this name and number of operands; null if there is none.
const circuit::Operation* find_operation(std::string_view name, std::size_t arguments) {
    return circuit::find_operation(name == "pwr" ? "^" : name, static_cast<int>(arguments));
}

/// The numbers of an argument at the k-th point of a curve or list with `count` points, which is at `x` if it is a curve.
double number_at(const StudyValue& argument, std::size_t k, std::size_t count, const double* x) {
    if (const auto* number = std::get_if<double>(&argument)) return *number;
    if (const auto* list = std::get_if<StudyList>(&argument)) return list->size() == count ? (*list)[k] : Claim::none;
    const auto& curve = std::get<StudyCurve>(argument);
    const bool has_same_x = curve.x.size() == count && (x == nullptr || curve.x[k] == *x);
    return has_same_x ? curve.y[k] : x ? curve.at(*x) : Claim::none;
}

bool is_numeric(const StudyValue& value) { return std::string_view("ncl").find(kind_of(value).letter) != std::string_view::npos; }

/// Calls `point(numbers)` with the numbers of all arguments at each point of the first curve or list; once if all are numbers.
StudyValue map_points(std::span<const StudyValue> arguments, const std::function<double(std::span<const double>)>& point) {
    std::vector<double> numbers(arguments.size());
    const auto value_at = [&](std::size_t k, std::size_t count, const double* x) {
        for (std::size_t a = 0; a < arguments.size(); ++a) numbers[a] = number_at(arguments[a], k, count, x);
        return point(numbers);
    };
    for (const auto& argument : arguments) {
        if (const auto* curve = std::get_if<StudyCurve>(&argument)) {
            StudyCurve out{curve->x, {}};
            for (std::size_t k = 0; k < out.x.size(); ++k) out.y.push_back(value_at(k, out.x.size(), &out.x[k]));
            return out;
        }
        if (const auto* list = std::get_if<StudyList>(&argument)) {
            StudyList out;
            for (std::size_t k = 0; k < list->size(); ++k) out.push_back(value_at(k, list->size(), nullptr));
            return out;
        }
    }
    return value_at(0, 1, nullptr);
}

Error no_such_function(std::string_view name, std::span<const StudyValue> arguments) {
    std::vector<std::string_view> names;
    for (const auto& f : study_functions) names.push_back(f.name);
    for (const auto& operation : circuit::all_operations()) names.push_back(operation.name);
    std::vector<std::string_view> kinds;
    for (const auto& argument : arguments) kinds.push_back(kind_of(argument).name);
    const bool is_known = std::find(names.begin(), names.end(), name) != names.end();
    return bad_input(is_known ? fmt::format("{}() does not take {}", name, fmt::join(kinds, ", "))
                              : fmt::format("there is no function '{}'{}", name, did_you_mean(name, names)));
}

}  // namespace

Result<StudyValue> call_study_function(std::string_view name, std::span<const StudyValue> arguments) {
    std::string signature;
    for (const auto& argument : arguments) signature += kind_of(argument).letter;
    for (const auto& f : study_functions)
        if (f.name == name && f.signature == signature) return f.value({arguments});
    if (!std::all_of(arguments.begin(), arguments.end(), is_numeric)) return no_such_function(name, arguments);
    for (const auto& f : study_functions)  // a function of one number, for each point of a curve
        if (f.name == name && f.signature == "n" && arguments.size() == 1)
            return map_points(arguments,
                              [&](std::span<const double> x) { return std::get<double>(f.value({std::array<StudyValue, 1>{x[0]}})); });
    const auto* operation = find_operation(name, arguments.size());
    if (!operation) return no_such_function(name, arguments);
    return map_points(
        arguments, [&](std::span<const double> x) { return operation->value({x[0], x.size() > 1 ? x[1] : 0, x.size() > 2 ? x[2] : 0}); });
}

const StudyValue* find_study_constant(std::string_view name) {
    static const StudyValues constants = {{"rest", press::rest},
                                          {"protraction", press::protraction},
                                          {"plateau", press::plateau},
                                          {"plateau_end", press::plateau_end},
                                          {"retraction", press::retraction},
                                          {"after", press::after},
                                          {"always", TimeWindow{}},
                                          {"gram_force", gram_force},
                                          {"none", Claim::none},
                                          {"pi", M_PI}};
    const auto found = constants.find(name);
    return found == constants.end() ? nullptr : &found->second;
}

}  // namespace corpuscle
