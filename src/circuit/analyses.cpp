// The list of all analyses. To add one, write its file in circuit/analysis/ and add its name to the two lists below.

#include "circuit/analyses.hpp"

#include <algorithm>

namespace corpuscle::circuit {

extern const Analysis dc_analysis, noise_analysis, pz_analysis, tf_analysis, sens_analysis;

namespace {

constexpr const Analysis* all_analyses[] = {&op_analysis,   &dc_analysis, &ac_analysis, &noise_analysis,
                                            &tran_analysis, &pz_analysis, &tf_analysis, &sens_analysis};

}  // namespace

constinit const std::span<const Analysis* const> analyses = all_analyses;

const Analysis* find_analysis(std::string_view name) {
    const auto found = std::ranges::find(all_analyses, name, &Analysis::name);
    return found == std::end(all_analyses) ? nullptr : *found;
}

}  // namespace corpuscle::circuit
