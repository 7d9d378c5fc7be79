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

/// The instruction sets for which this program was compiled, from narrowest to widest.
std::span<const InstructionSet> compiled_instruction_sets();

/// Those of them that this machine supports, in the same order.
std::span<const InstructionSet> instruction_sets();

/// The set to use: the widest set that this machine supports, or the set that the environment variable CORPUSCLE_ISA names (scalar,
/// baseline, avx2, avx512). Results do not depend on the set. An unknown or unsupported name is an error.
Result<InstructionSet> instruction_set();

/// CORPUSCLE_KERNELS(Table, name) declares the tables of functions of a file that is compiled once for each instruction set (add_lanes in
/// cmake/lanes.cmake). The file defines `const Table name` in the namespace CORPUSCLE_ISA. name(set) returns the table of a set; scalar has
/// that of the baseline.
#define CORPUSCLE_KERNELS_OF_SET(Table, name, set) \
    namespace set {                                \
    extern const Table name;                       \
    }
#ifdef CORPUSCLE_AVX
#define CORPUSCLE_KERNELS(Table, name)                                    \
    CORPUSCLE_KERNELS_OF_SET(Table, name, baseline)                       \
    CORPUSCLE_KERNELS_OF_SET(Table, name, avx2)                           \
    CORPUSCLE_KERNELS_OF_SET(Table, name, avx512)                         \
    inline const Table& name(InstructionSet set) {                        \
        if (set == InstructionSet::avx512) return avx512::name;           \
        return set == InstructionSet::avx2 ? avx2::name : baseline::name; \
    }
#else
#define CORPUSCLE_KERNELS(Table, name)              \
    CORPUSCLE_KERNELS_OF_SET(Table, name, baseline) \
    inline const Table& name(InstructionSet) { return baseline::name; }
#endif

}  // namespace corpuscle
