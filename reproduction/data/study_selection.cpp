// run.kind[name]: parts of the results of runs and trials.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/parameter.hpp"
#include "reproduction/data/circuit_selection.hpp"
#include "reproduction/data/study_functions.hpp"

namespace corpuscle {
namespace {

Error no_such_name(std::string_view kind, const std::string& name, const std::vector<std::string>& known) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    return bad_input(fmt::format("{} has no '{}'{}", kind, name,
                                 known.empty() ? fmt::format("; add a line .{} to the run's directives", kind)
                                               : did_you_mean(name, names) + fmt::format(" (there are {})", fmt::join(names, ", "))));
}

/// The names of the curves of an analysis.
std::vector<std::string> curve_names(const NetlistResult& result, std::string_view analysis) {
    std::vector<std::string> out;
    for (const auto& a : result.outcome.analyses)
        if (a.directive->name == analysis && !a.result.plots.empty())
            for (const auto& curve : a.result.plots[0].curves) out.push_back(curve.name);
    return out;
}

Result<StudyValue> analysis_curve(const NetlistResult& result, std::string_view analysis, const std::string& name) {
    const auto over = name.find(" over ");
    auto curve =
        over == std::string::npos ? result.curve(analysis, name) : result.curve(analysis, name.substr(0, over), name.substr(over + 6));
    if (curve.empty()) return no_such_name(analysis, name, curve_names(result, analysis));
    return StudyValue(std::move(curve));
}

Result<StudyValue> operating_points(const StudyRun& run, const std::string& name) {
    StudyList out;
    for (const auto& variant : run) out.push_back(variant.operating_point(name));
    if (std::isnan(out.front())) return no_such_name("op", name, curve_names(run.front(), "op"));
    if (out.size() == 1) return StudyValue(out.front());
    return StudyValue(std::move(out));
}

Result<StudyValue> measurement(const NetlistResult& result, const std::string& name) {
    std::vector<std::string> known;
    for (const auto& [number_name, value] : result.outcome.numbers) known.push_back(number_name);
    for (const auto& a : result.outcome.analyses)
        for (const auto& [number_name, value] : a.result.numbers) known.push_back(number_name);
    const auto has = [&](std::string_view n) { return std::find(known.begin(), known.end(), n) != known.end(); };
    // Without spikes there is no first_spike, and with less than two no mean_interval.
    if (has("spikes") && (name == "first_spike" || name == "mean_interval")) return StudyValue(result.number(name));
    if (!has(name)) return no_such_name("meas", name, known);
    return StudyValue(result.number(name));
}

/// A derivative of .tf, "i(vout) vin", or a value that .op prints for a device, "m1 i_f".
template <class Read>
Result<StudyValue> pair_value(const NetlistResult& result, const char* directive, const std::string& name, Read read) {
    const auto blank = std::min(name.find(' '), name.size());
    const double value = (result.*read)(name.substr(0, blank), name.substr(std::min(blank + 1, name.size())));
    if (std::isnan(value)) return no_such_name(directive, name, {});
    return StudyValue(value);
}

struct CircuitSelection {
    std::string_view kind;
    Result<StudyValue> (*value)(const circuit::Circuit&, const std::string& name);
};
constexpr CircuitSelection circuit_selections[] = {{"device", device_value}, {"model", model_value}, {"aspect", aspect_ratio},
                                                   {"has", has_device},      {"sizes", has_sizes},   {"area", gate_area},
                                                   {"widths", widths}};
constexpr std::string_view analysis_kinds[] = {"dc", "ac", "tran", "noise"}, other_kinds[] = {"op", "meas", "tf", "info", "probe"};

bool is_one_of(std::span<const std::string_view> kinds, std::string_view kind) {
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

Result<StudyValue> select_of_run(const StudyRun& run, std::string_view kind, const std::string& name) {
    const auto& first = run.front();
    for (const auto& selection : circuit_selections)
        if (selection.kind == kind) return selection.value(*first.circuit, name);
    if (kind == "op") return operating_points(run, name);
    if (kind == "meas") return measurement(first, name);
    if (kind == "tf") return pair_value(first, "tf", name, &NetlistResult::derivative);
    if (kind == "info") return pair_value(first, "op", name, &NetlistResult::operating_info);
    return analysis_curve(first, kind, name);
}

}  // namespace

bool is_result_kind(std::string_view kind) {
    return is_one_of(analysis_kinds, kind) || is_one_of(other_kinds, kind) ||
           std::any_of(std::begin(circuit_selections), std::end(circuit_selections), [&](const auto& s) { return s.kind == kind; });
}

Result<StudyValue> select_result(const StudyValue& from, std::string_view kind, const std::string& name) {
    if (!is_result_kind(kind)) return bad_input(fmt::format("there is no '{}[...]'; write dc, ac, tran, op, meas ... [name]", kind));
    if (const auto* run = std::get_if<std::shared_ptr<const StudyRun>>(&from); run && kind != "probe")
        return select_of_run(**run, kind, name);
    if (const auto* trial = std::get_if<std::shared_ptr<const StudyTrial>>(&from); trial && kind == "probe") {
        const auto found = (*trial)->result.probes.find(name);
        if (found == (*trial)->result.probes.end())
            return bad_input(fmt::format("the trial has no probe '{0}'; add probes = [\"{0}\"]", name));
        return StudyValue(found->second);
    }
    return bad_input(fmt::format("{} has no '{}'", kind_of(from).name, kind));
}

}  // namespace corpuscle
