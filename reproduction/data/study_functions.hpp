#pragma once
// The functions of the expressions in a study's data file. The list of their names is in study_functions.cpp.

#include <span>
#include <string_view>

#include "core/error.hpp"
#include "reproduction/data/study_value.hpp"

namespace corpuscle {

/// The value of a function of the list in study_functions.cpp. If that has none of this name for these arguments, it is a function of
/// netlist expressions (abs, max, sqrt ...), which is computed point by point if an argument is a curve or a list.
Result<StudyValue> call_study_function(std::string_view name, std::span<const StudyValue> arguments);

/// The value of a time window of the press stimulus (protraction, plateau ...) or of a constant (pi, gram_force ...); null if there is none
/// of this name.
const StudyValue* find_study_constant(std::string_view name);

/// A part of the result of a run or a trial, written run.kind[name]. The kinds:
///
///  - dc, ac, tran, noise: a curve of the first analysis of this kind, named as in .print; "y over x" is the curve y over the curve x
///  - op: a voltage or a current of the operating point; with several variants (.step, .mc) the list of all
///  - meas: the value of a .meas line
///  - tf: a derivative at the operating point, tf[i(vout) vin] from the line .tf i(vout) vin
///  - info: a value that .op prints for a device, info[m1 i_f]
///  - device, model: a value of a device or a model card of the netlist, device[m1 w], model[nch n]
///  - aspect: the aspect ratio of an array, W/L times columns over unit transistors in series
///  - has: 1 if there is a device of this name, otherwise 0
///  - sizes: 1 if all of these transistors have this size, sizes[mp1 mp2: 4x2 of 6/0.5] (columns, transistors in series, W and L in um)
///  - area: the sum of the gate areas of these transistors, um^2, area[mp1 mp2]
///  - widths: the widths of all transistors of a type, um, widths[pmos]
///  - probe: a recorded quantity of a trial over time
Result<StudyValue> select_result(const StudyValue& from, std::string_view kind, const std::string& name);
bool is_result_kind(std::string_view kind);

}  // namespace corpuscle
