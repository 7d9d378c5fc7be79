#pragma once
// The kinds of claims. They keep apart what the thesis foretells of a simulation, and what was put in, fitted or follows by itself.

#include <optional>
#include <span>
#include <string_view>

#include "core/error.hpp"

namespace corpuscle {

/// In the order of their tables: predictions first.
enum class ClaimKind { predicted, fitted, input, identity, arithmetic, misprint, ours };

struct ClaimKindInfo {
    ClaimKind kind;
    std::string_view name, meaning;
};

/// All kinds, in the order of ClaimKind.
std::span<const ClaimKindInfo> claim_kinds();
/// The name and meaning of a kind.
const ClaimKindInfo& info_of(ClaimKind);
/// The kind of this name, as study files write it; an unknown name is an error.
Result<ClaimKind> find_claim_kind(std::string_view name);

}  // namespace corpuscle
