#include "skin/plan/skin_plan.hpp"

#include <fmt/format.h>

#include "core/text/ascii_text.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {
namespace {

constexpr double grid_pitch = 2e-3;            // m; choice: between robot fingertip skins (1 to 2 mm) and palm skins
constexpr double grid_sigma = grid_pitch / 2;  // m; choice: an afferent responds mainly to its own sensor

/// Parses the two numbers of "8x8".
std::optional<std::pair<std::size_t, std::size_t>> rows_by_columns(std::string_view text) {
    const auto by = text.find_first_of("xX");
    if (by == std::string_view::npos) return {};
    const auto rows = parse_bare_number<std::size_t>(trimmed(text.substr(0, by))),
               columns = parse_bare_number<std::size_t>(trimmed(text.substr(by + 1)));
    return rows && columns ? std::optional(std::pair(*rows, *columns)) : std::nullopt;
}

/// A class of a named afferent (which must exist), with one afferent at each site.
SkinClass class_with_one_per_site(std::string_view afferent) {
    SkinClass c;
    c.name = afferent, c.afferent = *plan_afferent(afferent);
    c.per_site = 1, c.sigma = grid_sigma;
    return c;
}

}  // namespace

bool is_grid_name(std::string_view text) {
    text = trimmed(text);
    return lower(text.substr(0, 4)) == "grid" && (text.size() == 4 || text[4] == ' ' || text[4] == ':');
}

Result<SkinPlan> plan_grid(std::string_view text) {
    const auto size = rows_by_columns(trimmed(text).substr(std::min<std::size_t>(5, trimmed(text).size())));
    if (!size) return bad_usage(fmt::format("'{}' is not a grid; write rows and columns, such as 'grid 8x8'", text));
    const double count = static_cast<double>(size->first) * static_cast<double>(size->second);
    if (count <= static_cast<double>(max_sites))
        TRY(check_available_memory(fmt::format("grid {}x{}", size->first, size->second), count, 2 * count, 18 * count));
    auto sites = TRY(grid_sites(size->first, size->second, grid_pitch));
    SkinPlan plan;
    plan.name = fmt::format("grid {}x{}", size->first, size->second);
    plan.description = fmt::format("{} by {} sensors, 2 mm apart; an SA-I and an FA-I at each", size->first, size->second);
    plan.sites = std::move(sites);
    plan.classes = {class_with_one_per_site("sa1"), class_with_one_per_site("fa1")};
    return plan;
}

}  // namespace corpuscle
