#pragma once
// All analyses, by directive name. To add one, write its file in circuit/analysis/ and add its name to the two lists below.

#include "circuit/analysis/analysis_context.hpp"

namespace corpuscle::circuit {

extern const Analysis op_analysis, dc_analysis, ac_analysis, noise_analysis, tran_analysis, pz_analysis, tf_analysis, sens_analysis;

/// In the order in which help texts list them.
inline constexpr const Analysis* analyses[] = {&op_analysis,   &dc_analysis, &ac_analysis, &noise_analysis,
                                               &tran_analysis, &pz_analysis, &tf_analysis, &sens_analysis};

/// The analysis of this name; null if there is none.
inline const Analysis* find_analysis(std::string_view name) {
    const auto* const found = std::ranges::find(analyses, name, &Analysis::name);
    return found == std::end(analyses) ? nullptr : *found;
}

}  // namespace corpuscle::circuit
