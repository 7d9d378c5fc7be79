#include "reproduction/claims/verdict_counts.hpp"

#include <fmt/format.h>

namespace corpuscle {

std::vector<KindCount> count_by_kind(std::span<const StudyResult> outcomes) {
    std::vector<KindCount> out;
    for (const auto& info : claim_kinds()) out.push_back({info.kind, {}, {}, {}});
    for (const auto& outcome : outcomes)
        for (const auto& c : outcome.claims) {
            if (!c.kind || *c.verdict() == 0) continue;
            auto& count = out[static_cast<std::size_t>(*c.kind)];
            (c.has_allowed_range() ? count.statements : c.is_derived ? count.derived : count.printed).add(c);
        }
    return out;
}

std::string prediction_sentence(std::span<const StudyResult> outcomes) {
    const auto counts = count_by_kind(outcomes);
    const auto& c = counts[static_cast<std::size_t>(ClaimKind::predicted)];
    const auto total = [](const VerdictCount& v) { return v.agreeing + v.deviating; };
    return fmt::format(
        "Of {} printed numbers that were predicted without a fit, {} agree and {} differ; of {} that an equation, a sentence or another "
        "model "
        "gives, {} agree; of {} statements, {} hold.",
        total(c.printed), c.printed.agreeing, c.printed.deviating, total(c.derived), c.derived.agreeing, total(c.statements),
        c.statements.agreeing);
}

}  // namespace corpuscle
