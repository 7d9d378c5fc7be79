#pragma once
// Which of the instruction sets that lanes are compiled for this machine has.

#include <span>
#include <string_view>

#include "signal/error.hpp"

namespace corpuscle {

enum class InstructionSet {
    scalar,    ///< no lanes: one afferent at a time
    baseline,  ///< what every processor of this kind has
    avx2,      ///< x86-64-v3
    avx512,    ///< x86-64-v4
};

std::string_view name_of(InstructionSet);

/// Those this machine can run, the least first.
std::span<const InstructionSet> instruction_sets();

/// The best this machine has; or what the environment's CORPUSCLE_ISA names (scalar, baseline, avx2, avx512), which changes no
/// answer. Refuses a word that is none of these, and a set this machine lacks.
Result<InstructionSet> instruction_set();

}  // namespace corpuscle
