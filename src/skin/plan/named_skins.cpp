// Finds populations by name (grids, the built-in populations, and files), and changes their plans as the user requests.

#include <fmt/format.h>
#include <filesystem>

#include "core/text/ascii_text.hpp"
#include "core/text/config_file.hpp"
#include "core/text/embedded_files.hpp"
#include "core/text/input_files.hpp"
#include "skin/contact/skin_cells.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

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
    c.name = afferent, c.afferent_name = afferent, c.afferent = *plan_afferent(afferent);
    c.per_site = 1, c.sigma = grid_sigma;
    return c;
}

/// True if a text begins as the name of a grid, "grid ..." or "grid:...", in upper or lower case.
bool is_grid_name(std::string_view text) {
    text = trimmed(text);
    return lower(text.substr(0, 4)) == "grid" && (text.size() == 4 || text[4] == ' ' || text[4] == ':');
}

/// The plan of a grid such as "grid 8x8" (8 rows by 8 columns).
Result<SkinPlan> plan_grid(std::string_view text) {
    const auto size = rows_by_columns(trimmed(text).substr(std::min<std::size_t>(5, trimmed(text).size())));
    if (!size) return bad_usage(fmt::format("'{}' is not a grid; write rows and columns, such as 'grid 8x8'", text));
    const double count = static_cast<double>(size->first) * static_cast<double>(size->second);
    if (count <= static_cast<double>(max_sites))
        TRY(check_available_memory(fmt::format("grid {}x{}", size->first, size->second), count, 2 * count, 18 * count));
    SkinPlan plan;
    plan.name = fmt::format("grid {}x{}", size->first, size->second);
    plan.description = fmt::format("{} by {} sensors, 2 mm apart; an SA-I and an FA-I at each", size->first, size->second);
    plan.sites = TRY(grid_sites(size->first, size->second, grid_pitch));
    plan.classes = {class_with_one_per_site("sa1"), class_with_one_per_site("fa1")};
    return plan;
}

constexpr std::size_t max_file_size = std::size_t{64} << 20;  // bytes

std::string embedded_path(std::string_view name) { return fmt::format("skins/{}.toml", name); }

/// `more`: what else a population may be.
Error unknown_skin(std::string_view name, std::string_view more) {
    std::vector<std::string_view> names = {"grid 8x8"};
    for (const auto& s : named_skins()) names.push_back(s.name);
    return bad_usage(fmt::format("there is no population '{}'{} (there are {}, {})", name, did_you_mean(name, names),
                                 joined(std::span(names).subspan(1)), more));
}

/// A grid or an embedded population; nothing if there is none of this name.
std::optional<Result<SkinPlan>> built_in_skin_plan(std::string_view name, std::span<const Channel> channels) {
    if (is_grid_name(name)) return plan_grid(name);
    const auto path = embedded_path(lower(name));
    if (const auto text = embedded_text(path)) return parse_skin_plan(*text, path, channels);
    return {};
}

/// The built-in populations, which are embedded in the program as files.
std::vector<NamedSkin> embedded_skins() {
    std::vector<NamedSkin> out;
    for (const auto file : embedded_files()) {
        if (!file.starts_with("skins/")) continue;
        const auto population = parse_toml(*embedded_text(std::string(file)), std::string(file));
        const auto* title = population ? population->get("title") : nullptr;
        out.push_back({fs::path(file).stem().string(), title ? title->text : ""});
    }
    return out;
}

}  // namespace

std::span<const NamedSkin> named_skins() {
    static const auto all = embedded_skins();
    return all;
}

Result<SkinPlan> load_built_in_skin_plan(std::string_view name) {
    name = trimmed(name);
    if (auto plan = built_in_skin_plan(name, {})) return std::move(*plan);
    return unknown_skin(name, "and grid ROWSxCOLUMNS");
}

Result<SkinPlan> load_skin_plan(std::string_view name, std::span<const Channel> channels) {
    name = trimmed(name);
    if (auto plan = built_in_skin_plan(name, channels)) return std::move(*plan);
    const fs::path path(name);
    std::error_code status;
    if (fs::exists(path, status) && !fs::is_directory(path, status)) {
        const auto text = read_entire_input(path.string(), max_file_size, "population file");
        return text ? parse_skin_plan(*text, path.string(), channels) : Result<SkinPlan>(text.error());
    }
    if (path.extension() == ".toml") return bad_input("cannot be read: there is no such file", {path.string()});
    return unknown_skin(name, "grid ROWSxCOLUMNS, and files: own.toml");
}

namespace {

/// True if one of these afferents has a parameter of this name.
bool has_parameter(const AfferentPlan& plan, std::string_view name) {
    const auto all = parameter_infos(plan);
    return std::any_of(all.begin(), all.end(), [name](const ParameterInfo& p) { return p.name == name; });
}

/// True if overrides with this target are for the class: it is its name, or its afferent ("sa1-nerve", "RA") and no class has that name.
bool is_for(const SkinPlan& plan, const SkinClass& c, std::string_view target) {
    const auto is_named = [target](const SkinClass& one) { return one.name == target; };
    if (std::any_of(plan.classes.begin(), plan.classes.end(), is_named)) return is_named(c);
    const auto afferent = plan_afferent(target);
    return afferent && afferent->name == c.afferent_name;
}

/// Refuses an override of a class that has the name of another afferent ("sa1", but it is a sa1-nerve) if its parameter is also one of that
/// afferent: the same number would mean something else.
Result<void> check_meaning(const SkinPlan& plan, const SkinClass& c, const ParameterOverride& given) {
    if (given.target != c.name || c.afferent_name.empty() || c.afferent_name == c.name) return {};
    const auto namesake = plan_afferent(c.name);
    if (!namesake || !has_parameter(*namesake, given.parameter)) return {};
    const auto remedy = has_parameter(c.afferent, given.parameter)
                            ? fmt::format("its {1} is set by {0}.{1}, and ", c.afferent_name, given.parameter)
                            : std::string();
    return bad_usage(
        fmt::format("{}: the class {} of {} is the afferent {}; {}the thesis's {} is in a population file with afferent = \"{}\" "
                    "(doc/skin.md)",
                    given.typed, c.name, plan.name, c.afferent_name, remedy, c.name, c.name));
}

/// The settings of a class; `unused` receives the overrides that are not for it.
Result<std::vector<Setting>> class_settings(const SkinPlan& plan, const SkinClass& c, std::span<const ParameterOverride> overrides,
                                            std::vector<ParameterOverride>& unused) {
    auto [own, others] = select_overrides(overrides, [&](std::string_view target) { return is_for(plan, c, target); });
    keep_unused(unused, others);
    const auto rows = parameter_infos(c.afferent);
    std::vector<Setting> settings;
    for (const auto& given : own) {
        TRY(check_meaning(plan, c, given));
        settings.push_back(TRY(setting_of(given, rows)));
    }
    return settings;
}

}  // namespace

Result<Applied<SkinPlan>> apply_overrides(SkinPlan plan, std::span<const ParameterOverride> overrides) {
    std::vector<ParameterOverride> unused(overrides.begin(), overrides.end());
    for (auto& c : plan.classes) {
        set_values(c.afferent, TRY(class_settings(plan, c, overrides, unused)));
        TRY(check_plan(c.afferent));
    }
    return Applied<SkinPlan>{std::move(plan), std::move(unused)};
}

std::vector<std::string_view> override_targets(const SkinPlan& plan, std::vector<std::string_view> others) {
    for (const auto& c : plan.classes) others.push_back(c.name);
    return others;
}

std::string treat_as_skin(SkinPlan& plan) {
    if (plan.felt_area > 0 || plan.sites.size() < 2) return "";
    const bool has_area = plan.sites.area > 0;
    const auto advice = fmt::format(
        "an afferent responds to the force on {:.3g} cm2 of it, as in hand; felt_area in a population file "
        "changes this (doc/skin.md)",
        1e4 * default_felt_area);
    if (has_area) {
        plan.felt_area = default_felt_area;
        return fmt::format("{} has no felt_area; {}", plan.name, advice);
    }
    const SkinCells cells(plan.sites);
    if (!cells.is_lattice()) return "";
    plan.sites.area = cells.side() * cells.side(), plan.felt_area = default_felt_area;
    return fmt::format("the force on {} is spread over its sites, so each site represents {:.3g} mm2 of skin; {}", plan.name,
                       1e6 * plan.sites.area, advice);
}

}  // namespace corpuscle
