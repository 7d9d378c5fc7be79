#pragma once
// How many claims agree with their sources and how many do not, by kind.

#include <span>
#include <string>
#include <vector>

#include "reproduction/claims/study.hpp"

namespace corpuscle {

/// Number of claims that agree with the published value or the allowed range, and of claims that deviate from it.
struct VerdictCount {
    int agreeing = 0, deviating = 0;
    void add(const Claim& c) { c.needs_explanation() ? ++deviating : ++agreeing; }
};

/// The claims of one kind that have a verdict.
struct KindCount {
    ClaimKind kind{};
    VerdictCount printed;     ///< numbers that the source states
    VerdictCount derived;     ///< numbers that an equation, a sentence or the model gives
    VerdictCount statements;  ///< allowed ranges and statements
};

/// One count for each kind, in the order of claim_kinds().
std::vector<KindCount> count_by_kind(std::span<const StudyResult>);

/// The headline: how many of the printed and derived numbers and statements that were predicted agree.
std::string prediction_sentence(std::span<const StudyResult>);

}  // namespace corpuscle
