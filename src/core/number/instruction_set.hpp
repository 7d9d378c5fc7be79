#pragma once
// The instruction sets for which the SIMD code is compiled, and those of them that this machine supports.

#include <span>
#include <string_view>

#include "core/error.hpp"

namespace corpuscle {

enum class InstructionSet {
    scalar,    ///< no SIMD: one afferent at a time
    baseline,  ///< the SIMD instructions that every processor of this architecture supports
    avx2,      ///< x86-64-v3
    avx512,    ///< x86-64-v4
};

std::string_view name_of(InstructionSet);

/// The instruction sets that this machine supports, from narrowest to widest.
std::span<const InstructionSet> instruction_sets();

/// The set to use: the widest set that this machine supports, or the set that the environment variable CORPUSCLE_ISA names (scalar,
/// baseline, avx2, avx512). Results do not depend on the set. An unknown or unsupported name is an error.
Result<InstructionSet> instruction_set();

}  // namespace corpuscle
