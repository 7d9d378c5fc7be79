#include "skin/plan/class_reading.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/located_override.hpp"

namespace corpuscle::skins {
namespace {

constexpr double max_density = 1e10;                      // afferents per m2: a million in 1 cm2
constexpr double max_width = 0.1;                         // m; largest sigma and hot_spot_spread
constexpr double min_velocity = 0.1, max_velocity = 200;  // m/s

/// Converts the settings of a class (`set` or `spread`) to overrides whose target is `afferent`, the text by which the file requests the
/// afferent.
std::vector<ParameterOverride> overrides_for(std::string_view afferent, std::span<const LocatedSetting> spec) {
    std::vector<ParameterOverride> out;
    for (const auto& s : spec) out.push_back(located_override(s, afferent));
    return out;
}

/// The plan of a class's afferent, with the values of the key `set` applied.
Result<AfferentPlan> afferent_of(const ClassSpec& spec) {
    if (!spec.afferent) return bad_input("[[class]]: afferent is missing: afferent = \"sa1\"", spec.location);
    const auto& text = spec.afferent->text;
    const auto afferent = read_model_spec(text);
    if (!afferent) return spec.afferent->error_here(afferent.error().message);
    auto planned = TRY((*afferent)->plan(overrides_for(text, spec.set), {}));
    TRY(check_all_used(planned.unused, std::array{std::string_view(text)}));
    return std::move(planned.result);
}

/// The distributions of parameters that the key `spread` of a class defines.
Result<std::vector<ParameterDistribution>> distributions_of(const ClassSpec& spec, const AfferentPlan& plan) {
    const auto& text = spec.afferent->text;
    auto applied = TRY(distributions_for(plan, overrides_for(text, spec.spread)));
    TRY(check_all_used(applied.unused, std::array{std::string_view(text)}));
    return std::move(applied.result);
}

/// True if `key` of a density table refers to a region: by its full name ("index.tip"), or by the part after a dot ("tip").
bool matches_region(std::string_view key, std::string_view region) {
    return region == key || (region.size() > key.size() && region.ends_with(key) && region[region.size() - key.size() - 1] == '.');
}

/// The density in each region, afferents per m2. A key with the full name of a region has priority over one with a part of it.
Result<std::vector<double>> densities_of(const ClassSpec& spec, const Sites& sites, const NumberReader& numbers) {
    const auto density = [&](const LocatedText& s) { return numbers.number(s, "density", "1/m2", 0, max_density); };
    if (spec.uniform_density) {
        const auto all = density(*spec.uniform_density);
        return all ? std::vector<double>(sites.regions.size(), *all) : Result<std::vector<double>>(all.error());
    }
    std::vector<double> out(sites.regions.size(), -1);  // -1: not given yet
    std::vector<char> exact(sites.regions.size(), 0);   // 1: given by a key with the region's full name
    for (const auto& s : spec.density) {
        const auto value = TRY(density(s.value));
        bool matched = false;
        for (std::size_t r = 0; r < out.size(); ++r) {
            if (!matches_region(s.name, sites.regions[r])) continue;
            matched = true;
            if (const bool is_same = sites.regions[r] == s.name; is_same || !exact[r]) out[r] = value, exact[r] = is_same;
        }
        if (matched) continue;
        const std::vector<std::string_view> names(sites.regions.begin(), sites.regions.end());
        return s.value.error_here(
            fmt::format("density: there is no region '{}'{} (there are {})", s.name, did_you_mean(s.name, names), fmt::join(names, ", ")));
    }
    for (std::size_t r = 0; r < out.size(); ++r)
        if (out[r] < 0)
            return bad_input(
                fmt::format("density: none is given for region '{0}'; write {0} = \"0 /cm2\" if it has no afferents", sites.regions[r]),
                spec.density.front().value.location);
    return out;
}

/// Reads the number of afferents of a class: densities, or a number for each site.
Result<void> read_numbers(const ClassSpec& spec, const Sites& sites, const NumberReader& numbers, SkinClass& out) {
    const bool has_density = spec.uniform_density || !spec.density.empty();
    if (has_density == spec.per_site.has_value())
        return bad_input(fmt::format("[[class]] {}: needs either density = \"70 /cm2\" or per_site = 1", out.name), spec.location);
    if (has_density && !(sites.area > 0))
        return bad_input(fmt::format("[[class]] {}: a density needs sites with an area of skin. Give regions, or area = \"4 mm2\" in "
                                     "[sites]. For sensors use per_site = 1",
                                     out.name),
                         spec.location);
    const auto per_site = TRY(numbers.integer(spec.per_site, "per_site", 1, 1000, 0));
    out.per_site = static_cast<std::uint32_t>(per_site);
    if (!has_density) return {};
    auto density = TRY(densities_of(spec, sites, numbers));
    out.density = std::move(density);
    return {};
}

/// Reads the shape of receptive fields, and the conduction velocity.
Result<void> read_fields_and_velocity(const ClassSpec& spec, const NumberReader& numbers, SkinClass& out) {
    struct FieldSetting {
        const OptionalLocatedText& spec;
        std::string_view name, unit;
        double low, high;
        double& target;
    };
    const FieldSetting all[] = {{spec.sigma, "sigma", "m", 0, max_width, out.sigma},
                                {spec.hot_spot_spread, "hot_spot_spread", "m", 0, max_width, out.hot_spot_spread},
                                {spec.velocity, "velocity", "m/s", min_velocity, max_velocity, out.velocity},
                                {spec.velocity_spread, "velocity_spread", "m/s", 0, max_velocity, out.velocity_spread}};
    for (const auto& setting : all)
        setting.target = TRY(numbers.number(setting.spec, setting.name, setting.unit, setting.low, setting.high, 0));
    const auto spots = TRY(numbers.integer(spec.hot_spots, "hot_spots", 1, 100, 1));
    out.hot_spots = static_cast<std::uint32_t>(spots);
    if (out.hot_spots > 1 && !(out.sigma > 0 && out.hot_spot_spread > 0))
        return spec.hot_spots->error_here("several hot spots need a sigma and a hot_spot_spread");
    if (spec.velocity_spread && !spec.velocity) return spec.velocity_spread->error_here("velocity_spread needs a velocity");
    return {};
}

Result<SkinClass> class_of(const ClassSpec& spec, const Sites& sites, const NumberReader& numbers) {
    SkinClass out;
    auto plan = TRY(afferent_of(spec));
    out.name = spec.name ? spec.name->text : plan.name;
    if (out.name.empty() || out.name.find_first_of("# \t,\n\r\"") != std::string::npos)
        return (spec.name ? *spec.name : *spec.afferent)
            .error_here(fmt::format("'{}' is not a valid class name: it must not contain blanks, commas, # or quotes", out.name));
    auto distributions = TRY(distributions_of(spec, plan));
    plan.name = out.name;  // two classes may use the same afferent, but need different random streams and names in outputs
    for (auto& d : distributions) d.afferent = out.name;
    out.afferent = std::move(plan), out.distributions = std::move(distributions), out.sources = read_sources(spec.source);
    TRY(read_numbers(spec, sites, numbers, out));
    TRY(read_fields_and_velocity(spec, numbers, out));
    return out;
}

}  // namespace

std::vector<SourceNote> read_sources(std::span<const LocatedSetting> spec) {
    std::vector<SourceNote> out;
    for (const auto& s : spec) out.push_back({s.name, s.value.text});
    return out;
}

Result<std::vector<SkinClass>> read_classes(const SkinSpec& spec, const Sites& sites, const NumberReader& numbers) {
    if (spec.classes.empty()) return bad_input("a skin needs afferents: [[class]]", {spec.file});
    std::vector<SkinClass> out;
    for (const auto& c : spec.classes) {
        auto read = TRY(class_of(c, sites, numbers));
        if (std::any_of(out.begin(), out.end(), [&](const SkinClass& other) { return other.name == read.name; }))
            return (c.name ? *c.name : *c.afferent).error_here(fmt::format("there are two classes '{}'; rename one of them", read.name));
        out.push_back(std::move(read));
    }
    return out;
}

}  // namespace corpuscle::skins
