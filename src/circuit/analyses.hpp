#pragma once
// All analyses, by directive name. Their list is in analyses.cpp.

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {

extern const Analysis op_analysis, ac_analysis, tran_analysis;  // those that other files name

/// In the order in which help texts list them.
extern const std::span<const Analysis* const> analyses;

/// The analysis of this name; null if there is none.
const Analysis* find_analysis(std::string_view name);

}  // namespace corpuscle::circuit
