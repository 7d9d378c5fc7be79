#include "core/number/instruction_set.hpp"

#include <fmt/format.h>
#include <cstdlib>
#include <vector>

namespace corpuscle {

std::string_view name_of(InstructionSet set) {
    constexpr std::string_view names[] = {"scalar", "baseline", "avx2", "avx512"};  // in the order of the enumerators
    return names[static_cast<int>(set)];
}

std::span<const InstructionSet> instruction_sets() {
    static const auto all = [] {
        std::vector<InstructionSet> sets = {InstructionSet::scalar, InstructionSet::baseline};
#ifdef __x86_64__
        if (__builtin_cpu_supports("x86-64-v3")) sets.push_back(InstructionSet::avx2);
        if (__builtin_cpu_supports("x86-64-v4")) sets.push_back(InstructionSet::avx512);
#endif
        return sets;
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
