#include "corpuscle/model_export.hpp"

#include <fmt/format.h>

#include "api/result.hpp"
#include "core/text/ascii_text.hpp"
#include "run/export/targets.hpp"

namespace corpuscle {

std::vector<std::string> export_target_names() {
    std::vector<std::string> names;
    for (const auto* target : export_targets) names.emplace_back(target->name);
    return names;
}

ModelText export_model(const std::string& subject, const std::string& target, const std::vector<std::string>& settings,
                       const ExportKit& kit) {
    const auto* found = find_export_target(target);
    if (!found) {
        const auto names = export_target_names();
        throw InputError(
            fmt::format("unknown target '{}' (there are {})", target, joined(std::vector<std::string_view>(names.begin(), names.end()))));
    }
    const ExportRequest request{.subject = subject,
                                .settings = api::value_or_throw(parse_overrides(settings)),
                                .kit = {kit.card, kit.map, kit.nch, kit.pch, kit.hv_nch, kit.hv_pch},
                                .out = kit.deck};
    auto model = api::value_or_throw(write_model(*found, request));
    ModelText out{std::move(model.text), {}, found->is_text};
    for (const auto& warning : model.warnings) out.warnings.push_back(warning.text());
    return out;
}

}  // namespace corpuscle
