// Reads the classes of afferents of a population file: [[class]].

#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "skin/plan/population_values.hpp"

#include "core/text/ascii_text.hpp"

namespace corpuscle::skins {
namespace {

using KeyKind = ConfigKey::Kind;

constexpr double max_density = 1e10;                      // afferents per m2: a million in 1 cm2
constexpr double max_width = 0.1;                         // m; largest sigma, depth and hot_spot_spread
constexpr double min_depth = 10e-6;                       // m
constexpr double min_velocity = 0.1, max_velocity = 200;  // m/s

constexpr auto class_keys = std::to_array<ConfigKey>({"name",
                                                      "afferent",
                                                      ConfigKey("set", KeyKind::settings),
                                                      ConfigKey("spread", KeyKind::settings),
                                                      ConfigKey("density", KeyKind::text_or_settings),
                                                      "per_site",
                                                      "sigma",
                                                      "depth",
                                                      "surround",
                                                      "hot_spots",
                                                      "hot_spot_spread",
                                                      "receptors",
                                                      "velocity",
                                                      "velocity_spread",
                                                      "direction_gain",
                                                      "direction",
                                                      "direction_spread",
                                                      "wave_speed",
                                                      "wave_decay",
                                                      "wave_radius",
                                                      "wave_gain",
                                                      "wave_corner",
                                                      ConfigKey("source", KeyKind::settings)});
constexpr auto class_sources = std::to_array<ConfigKey>({"afferent",        "set",
                                                         "spread",          "density",
                                                         "per_site",        "sigma",
                                                         "depth",           "surround",
                                                         "hot_spots",       "hot_spot_spread",
                                                         "receptors",       "velocity",
                                                         "velocity_spread", "direction_gain",
                                                         "direction",       "direction_spread",
                                                         "wave_speed",      "wave_decay",
                                                         "wave_radius",     "wave_gain",
                                                         "wave_corner"});

/// The settings in the table `name` of a class (`set` or `spread`), as overrides whose target is the text by which the file requests the
/// afferent.
std::vector<ParameterOverride> overrides_of(const ConfigNode& in, std::string_view name) {
    std::vector<ParameterOverride> out;
    for (const auto& s : in.settings(name)) out.push_back(located_override(s, in.get("afferent")->text));
    return out;
}

/// The plan of a class's afferent, with the values of the key `set` applied.
Result<AfferentPlan> afferent_of(const ConfigNode& in) {
    const auto* text = in.get("afferent");
    if (!text) return in.error_here("[[class]]: afferent is missing: afferent = \"sa1\"");
    auto spec = read_model_spec(text->text);
    if (!spec && (text->text.find("-circuit") != std::string::npos || text->text.find_first_of("./") != std::string::npos))
        return text->error_here(fmt::format("afferent = '{}': a skin has afferents of equations, not netlists", text->text.substr(0, 64)));
    const auto afferent = TRY(text->located(std::move(spec)));
    auto planned = TRY(afferent->plan(overrides_of(in, "set"), {}));
    TRY(check_all_used(planned.unused, std::array{std::string_view(text->text)}));
    return std::move(planned.result);
}

/// True if `key` of a density table refers to a region: by its full name ("index.tip"), or by the part after a dot ("tip").
bool matches_region(std::string_view key, std::string_view region) {
    return region == key || (region.size() > key.size() && region.ends_with(key) && region[region.size() - key.size() - 1] == '.');
}

/// The density in each region, afferents per m2, from the key `density` of a class: a number, or a table of numbers. A key with the full
/// name of a region has priority over one with a part of it.
Result<std::vector<double>> read_densities(const ConfigNode& in, const Sites& sites, const PopulationValues& values) {
    const auto& density = *in.get("density");
    const auto number = [&](const LocatedText& s) { return values.number(s, "density", "1/m2", 0, max_density); };
    if (!density.is_table()) {
        const double all = TRY(number(density));
        return std::vector<double>(sites.regions.size(), all);
    }
    std::vector<double> out(sites.regions.size(), -1);  // -1: not given yet
    std::vector<char> exact(sites.regions.size(), 0);   // 1: given by a key with the region's full name
    const auto all = in.settings("density");
    for (const auto& s : all) {
        const auto value = TRY(number(s.value));
        bool matched = false;
        for (std::size_t r = 0; r < out.size(); ++r) {
            if (!matches_region(s.name, sites.regions[r])) continue;
            matched = true;
            if (const bool is_same = sites.regions[r] == s.name; is_same || !exact[r]) out[r] = value, exact[r] = is_same;
        }
        if (matched) continue;
        const std::vector<std::string_view> names(sites.regions.begin(), sites.regions.end());
        return s.value.error_here(
            fmt::format("density: there is no region '{}'{} (there are {})", s.name, did_you_mean(s.name, names), joined(names)));
    }
    for (std::size_t r = 0; r < out.size(); ++r)
        if (out[r] < 0)
            return all.front().value.error_here(
                fmt::format("density: none is given for region '{0}'; write {0} = \"0 /cm2\" if it has no afferents", sites.regions[r]));
    return out;
}

/// Reads the number of afferents of a class: densities, or a number for each site.
Result<void> read_numbers(const ConfigNode& in, const Sites& sites, const PopulationValues& values, SkinClass& out) {
    const auto* density = in.get("density");
    const bool has_density = density && !(density->is_table() && density->entries.empty());
    if (has_density == in.has("per_site"))
        return in.error_here(fmt::format("[[class]] {}: needs either density = \"70 /cm2\" or per_site = 1", out.name));
    if (has_density && !(sites.area > 0))
        return in.error_here(
            fmt::format("[[class]] {}: a density needs sites with an area of skin. Give regions, or area = \"4 mm2\" in "
                        "[sites]. For sensors use per_site = 1",
                        out.name));
    out.per_site = static_cast<std::uint32_t>(TRY(values.integer(in, "per_site", 1, 1000, 0)));
    if (has_density) out.density = TRY(read_densities(in, sites, values));
    return {};
}

/// Reads whether the hot spots of an afferent share a receptor.
Result<void> read_receptors(const ConfigNode& in, SkinClass& out) {
    const auto* receptors = in.get("receptors");
    if (!receptors || receptors->text == "one") return {};
    if (receptors->text != "per hot spot")
        return receptors->error_here(fmt::format("receptors = '{}': write \"one\" or \"per hot spot\"", receptors->text));
    if (out.hot_spots < 2) return receptors->error_here("receptors = \"per hot spot\" needs several hot spots, such as hot_spots = 4");
    out.receptor_per_hot_spot = true;
    return {};
}

/// Reads the shape of receptive fields.
Result<void> read_fields(const ConfigNode& in, const PopulationValues& values, SkinClass& out) {
    out.sigma = TRY(values.number_of(in, "sigma", "m", 0, max_width));
    out.depth = TRY(values.number_of(in, "depth", "m", min_depth, max_width));
    out.surround = TRY(values.number_of(in, "surround", "", 0, 1));
    if (in.has("depth") && in.has("sigma"))
        return in.get("depth")->error_here("a receptive field has either a depth or a sigma; remove one of them");
    if (in.has("surround") && !in.has("depth")) return in.get("surround")->error_here("surround needs a depth, such as depth = \"0.6 mm\"");
    out.hot_spot_spread = TRY(values.number_of(in, "hot_spot_spread", "m", 0, max_width));
    out.hot_spots = static_cast<std::uint32_t>(TRY(values.integer(in, "hot_spots", 1, 100, 1)));
    if (out.hot_spots > 1 && !((out.sigma > 0 || out.depth > 0) && out.hot_spot_spread > 0))
        return in.get("hot_spots")->error_here("several hot spots need a depth or a sigma, and a hot_spot_spread");
    if (out.hot_spots == 1 && out.hot_spot_spread > 0)
        return in.get("hot_spot_spread")->error_here("hot_spot_spread needs several hot_spots, such as hot_spots = 4");
    return read_receptors(in, out);
}

/// Reads the conduction velocity.
Result<void> read_velocity(const ConfigNode& in, const PopulationValues& values, SkinClass& out) {
    out.velocity = TRY(values.number_of(in, "velocity", "m/s", min_velocity, max_velocity));
    out.velocity_spread = TRY(values.number_of(in, "velocity_spread", "m/s", 0, max_velocity));
    if (in.has("velocity_spread") && !in.has("velocity")) return in.get("velocity_spread")->error_here("velocity_spread needs a velocity");
    return {};
}

/// The node that gives a class its name.
const ConfigNode& name_of(const ConfigNode& in) { return in.has("name") ? *in.get("name") : *in.get("afferent"); }

Result<SkinClass> read_class(const ConfigNode& in, const Sites& sites, const PopulationValues& values) {
    TRY(check_keys(in, class_keys, "[[class]]: "));
    SkinClass out;
    out.afferent = TRY(afferent_of(in));
    out.afferent_name = out.afferent.name;
    out.name = in.has("name") ? in.get("name")->text : out.afferent.name;
    if (out.name.empty() || out.name.find_first_of("# \t,\n\r\"") != std::string::npos)
        return name_of(in).error_here(
            fmt::format("'{}' is not a valid class name: it must not contain blanks, commas, # or quotes", out.name));
    auto spread = TRY(distributions_for(out.afferent, overrides_of(in, "spread")));
    TRY(check_all_used(spread.unused, std::array{std::string_view(in.get("afferent")->text)}));
    out.distributions = std::move(spread.result);
    out.afferent.name = out.name;  // two classes may use the same afferent, but need different random streams and names in outputs
    for (auto& d : out.distributions) d.afferent = out.name;
    out.sources = TRY(read_sources(in, class_sources));
    TRY(read_numbers(in, sites, values, out));
    TRY(read_fields(in, values, out));
    TRY(read_velocity(in, values, out));
    out.direction = TRY(read_direction_tuning(in, values));
    out.wave = TRY(read_wave(in, values));
    return out;
}

}  // namespace

Result<std::vector<SkinClass>> read_classes(const ConfigNode& top, const Sites& sites, const PopulationValues& values) {
    const auto classes = top.elements_of("class");
    if (classes.empty()) return bad_input("a skin needs afferents: [[class]]", {top.location.file});
    std::vector<SkinClass> out;
    for (const auto& c : classes) {
        auto read = TRY(read_class(c, sites, values));
        if (std::any_of(out.begin(), out.end(), [&](const SkinClass& other) { return other.name == read.name; }))
            return name_of(c).error_here(fmt::format("there are two classes '{}'; rename one of them", read.name));
        out.push_back(std::move(read));
    }
    return out;
}

}  // namespace corpuscle::skins
