#include "core/number/instruction_set.hpp"

#include <fmt/format.h>
#include <cstdlib>

namespace corpuscle {

std::string_view name_of(InstructionSet set) {
    constexpr std::string_view names[] = {"scalar", "baseline", "avx2", "avx512"};  // in the order of the enumerators
    return names[static_cast<int>(set)];
}

std::span<const InstructionSet> compiled_instruction_sets() {
    static constexpr InstructionSet all[] = {InstructionSet::scalar, InstructionSet::baseline,
#ifdef CORPUSCLE_AVX
                                             InstructionSet::avx2, InstructionSet::avx512
#endif
    };
    return all;
}

std::span<const InstructionSet> instruction_sets() {
    // Each set contains those before it, so the supported ones are the first.
    static const auto all = [] {
        std::size_t count = 2;
#ifdef CORPUSCLE_AVX
        count += __builtin_cpu_supports("x86-64-v4") ? 2 : __builtin_cpu_supports("x86-64-v3") ? 1 : 0;
#endif
        return compiled_instruction_sets().first(count);
    }();
    return all;
}

Result<InstructionSet> instruction_set() {
    const auto sets = instruction_sets();
    const char* requested = std::getenv("CORPUSCLE_ISA");
    if (!requested || !*requested) return sets.back();
    std::string supported;
    for (const auto set : sets) {
        if (name_of(set) == requested) return set;
        supported += fmt::format("{}{}", supported.empty() ? "" : ", ", name_of(set));
    }
    return bad_usage(fmt::format("CORPUSCLE_ISA={}: this machine supports {}", requested, supported));
}

}  // namespace corpuscle
