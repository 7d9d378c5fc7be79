#pragma once
// Expressions in a study's data file, such as "100 * abs(I / expected - 1).between(20, 400).max".

#include <functional>

#include "reproduction/data/study_value.hpp"

namespace corpuscle {

/// Returns the value of a name of the data file.
using StudyLookup = std::function<Result<StudyValue>(const std::string& name)>;

/// The value of an expression. It has the numbers, operators, functions and constants of netlist expressions. In addition, values can be
/// curves and lists, on which operators and functions act point by point. [1, 2] is a list, a.f(b) is the same as f(a, b), and
/// run.dc[i(vx)] is a part of a result (select_result). `location` is that of the text, for errors.
Result<StudyValue> evaluate_study_expression(std::string_view text, const SourceLocation& location, const StudyLookup&);

/// Replaces each {expression:format} in a text by its value; the format is that of fmt, by default all digits. {{ and }} are
/// braces.
Result<std::string> fill_study_text(std::string_view text, const SourceLocation& location, const StudyLookup&);

}  // namespace corpuscle
