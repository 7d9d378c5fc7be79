#pragma once
// The instruction sets that SIMD lanes are compiled for, and which of them this machine supports.

#include <span>
#include <string_view>

#include "signal/error.hpp"

namespace corpuscle {

enum class InstructionSet {
    scalar,    ///< no lanes: one afferent at a time
    baseline,  ///< supported by every processor of this architecture
    avx2,      ///< x86-64-v3
    avx512,    ///< x86-64-v4
};

std::string_view name_of(InstructionSet);

/// The instruction sets that this machine supports, from narrowest to widest.
std::span<const InstructionSet> instruction_sets();

/// The widest set that this machine supports, or the set that the environment variable CORPUSCLE_ISA names (scalar, baseline, avx2,
/// avx512). Results do not depend on the set. An unknown or unsupported name is an error.
Result<InstructionSet> instruction_set();

}  // namespace corpuscle
