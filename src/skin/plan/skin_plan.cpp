// Reads a population file and makes a SkinPlan.

#include <array>
#include <filesystem>

#include "skin/plan/population_values.hpp"

namespace corpuscle {
namespace skins {
namespace {

using KeyKind = ConfigKey::Kind;

constexpr auto skin_keys =
    std::to_array<ConfigKey>({"title", "unit", "seed", "felt_area", ConfigKey("nerve", KeyKind::any), ConfigKey("sites", KeyKind::any),
                              ConfigKey("region", KeyKind::tables, "each region"),
                              ConfigKey("class", KeyKind::tables, "each class of afferents"), ConfigKey("source", KeyKind::settings)});
constexpr auto skin_sources = std::to_array<ConfigKey>({"sites", "felt_area", "nerve"});

Result<SkinPlan> read_plan(const ConfigNode& top, std::span<const Channel> channels) {
    TRY(check_keys(top, skin_keys, ""));
    const auto values = TRY(PopulationValues::of(top));
    SkinPlan plan;
    plan.name = std::filesystem::path(top.location.file).stem().string();
    if (const auto* title = top.get("title")) plan.description = title->text;
    plan.sites = TRY(read_sites(top, channels, values));
    plan.seed = TRY(values.integer(top, "seed", 0, UINT64_MAX, 1));
    if (const auto* felt_area = top.get("felt_area")) {
        plan.felt_area = TRY(values.number(*felt_area, "felt_area", "m2", 1e-10, 1));
        if (!(plan.sites.area > 0))
            return felt_area->error_here("felt_area needs sites that represent an area of skin: regions, or area = \"4 mm2\" in [sites]");
    }
    if (const auto* nerve = top.get("nerve")) plan.nerve = TRY(values.position(*nerve, "nerve"));
    plan.classes = TRY(read_classes(top, plan.sites, values));
    plan.sources = TRY(read_sources(top, skin_sources));
    return plan;
}

}  // namespace
}  // namespace skins

Result<SkinPlan> parse_skin_plan(std::string_view text, const std::string& file, std::span<const Channel> channels) {
    return skins::read_plan(TRY(parse_toml(text, file)), channels);
}

}  // namespace corpuscle
