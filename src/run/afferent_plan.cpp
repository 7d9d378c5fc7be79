#include "run/afferent_plan.hpp"

#include <fmt/format.h>

#include "circuit/afferent/netlist_plan.hpp"
#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

/// The error for an unknown name: `error`, which suggests catalogue afferents, or a suggestion of an embedded netlist if its name is the
/// most similar.
Error unknown_afferent(std::string_view text, Error error) {
    std::vector<std::string_view> names;
    for (const auto& a : named_afferents()) names.push_back(a.name);
    for (const auto& c : circuit::embedded_netlists) names.push_back(c.name);
    const auto lowercase = lower(text);
    const auto hint = did_you_mean(lowercase, names);
    for (const auto& c : circuit::embedded_netlists)
        if (text.find('+') == std::string_view::npos && hint.find(fmt::format("'{}'", c.name)) != std::string::npos)
            error.message = fmt::format("unknown afferent '{}'{} ('corpuscle list' shows them all)", text, hint);
    return error;
}

}  // namespace

Result<std::shared_ptr<const AfferentSpec>> read_afferent_spec(std::string_view text) {
    if (nir::names_graph(text)) return std::shared_ptr<const AfferentSpec>(std::make_shared<nir::GraphSpec>(text));
    if (names_netlist(text)) return std::shared_ptr<const AfferentSpec>(std::make_shared<circuit::NetlistSpec>(text));
    auto spec = read_model_spec(text);
    return spec ? std::move(spec) : unknown_afferent(text, spec.error());
}

Result<PlannedAfferent> plan_any_afferent(std::string_view text, std::span<const ParameterOverride> overrides,
                                          std::span<const std::string> probes) {
    return TRY(read_afferent_spec(text))->plan(overrides, probes);
}

}  // namespace corpuscle
