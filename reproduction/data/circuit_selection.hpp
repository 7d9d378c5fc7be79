#pragma once
// Values of the transistors and model cards of a netlist, for select_result().

#include "core/error.hpp"
#include "reproduction/data/study_value.hpp"

namespace corpuscle {

/// A value of a device or of a model card: "m1 w", "nch n". In a device m and stack are 1 if the netlist does not give them.
Result<StudyValue> device_value(const circuit::Circuit&, const std::string& name);
Result<StudyValue> model_value(const circuit::Circuit&, const std::string& name);
/// The aspect ratio of an array: W/L times columns over unit transistors in series.
Result<StudyValue> aspect_ratio(const circuit::Circuit&, const std::string& device);
/// 1 if there is a device of this name, otherwise 0.
Result<StudyValue> has_device(const circuit::Circuit&, const std::string& name);
/// "mp1 mp2: 4x2 of 6/0.5": 1 if each of these transistors has 4 columns of 2 in series, 6 um wide and 0.5 um long; otherwise 0.
Result<StudyValue> has_sizes(const circuit::Circuit&, const std::string& devices_and_size);
/// The sum of the gate areas of transistors, um^2: "mp1 mp2".
Result<StudyValue> gate_area(const circuit::Circuit&, const std::string& devices);
/// The widths of all transistors of a type, nmos or pmos, um.
Result<StudyValue> widths(const circuit::Circuit&, const std::string& type);

}  // namespace corpuscle
