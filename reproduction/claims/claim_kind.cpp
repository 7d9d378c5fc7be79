#include "reproduction/claims/claim_kind.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <vector>

#include "core/parameter.hpp"

namespace corpuscle {
namespace {

constexpr ClaimKindInfo kinds[] = {
    {ClaimKind::predicted, "predicted", "computed and not fitted; the thesis, or the paper that is cited, prints or says it"},
    {ClaimKind::fitted, "fitted", "the process card, or the calibration of the afferents, was fitted to it or to the same data"},
    {ClaimKind::input, "input", "the source prints it, and we put it in"},
    {ClaimKind::identity, "identity",
     "follows from the equations of which the model is made, or repeats another row: it checks our program, not the source"},
    {ClaimKind::arithmetic, "arithmetic", "follows from printed numbers alone, without a simulation"},
    {ClaimKind::misprint, "misprint", "a misprint, or another reading of the text, run on purpose to show its effect"},
    {ClaimKind::ours, "ours", "without a printed counterpart: a bound or an expectation of ours"},
};

}  // namespace

std::span<const ClaimKindInfo> claim_kinds() { return kinds; }

const ClaimKindInfo& info_of(ClaimKind kind) { return kinds[static_cast<std::size_t>(kind)]; }

Result<ClaimKind> find_claim_kind(std::string_view name) {
    const auto found = std::find_if(std::begin(kinds), std::end(kinds), [&](const auto& k) { return k.name == name; });
    if (found != std::end(kinds)) return found->kind;
    std::vector<std::string_view> names;
    for (const auto& k : kinds) names.push_back(k.name);
    return bad_input(fmt::format("unknown kind of claim '{}'{} (known: {})", name, did_you_mean(name, names), fmt::join(names, ", ")));
}

}  // namespace corpuscle
