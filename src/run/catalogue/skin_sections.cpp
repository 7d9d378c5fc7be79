// Populations with their classes, and indenters and touches with their parameters.

#include <fmt/format.h>
#include <algorithm>
#include <numeric>

#include "core/text/quantity.hpp"
#include "run/catalogue/catalogue_sections.hpp"
#include "skin/contact/contact.hpp"
#include "skin/contact/indenters.hpp"
#include "skin/innervation.hpp"

namespace corpuscle {
namespace {

/// The source of a property of a skin or class; "" if it is not documented.
std::string source_for(const std::vector<SourceNote>& sources, std::string_view property) {
    const auto found = std::find_if(sources.begin(), sources.end(), [&](const SourceNote& s) { return s.quantity == property; });
    return found == sources.end() ? "" : found->source;
}

/// The densities of a class: "tip 70, middle 33, palm 10 /cm2". "tip" stands for all regions whose name ends in ".tip". If such regions
/// differ in density, every region is listed with its complete name.
std::string densities(const SkinPlan& plan, const SkinClass& c) {
    std::vector<std::pair<std::string, double>> found;
    bool has_same_density = true;
    for (std::size_t r = 0; r < c.density.size(); ++r) {
        const auto& region = plan.sites.regions[r];
        const auto name = region.substr(region.rfind('.') + 1);
        const auto same = std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.first == name; });
        if (same == found.end())
            found.emplace_back(name, c.density[r]);
        else
            has_same_density = has_same_density && same->second == c.density[r];
    }
    if (!has_same_density) {
        found.clear();
        for (std::size_t r = 0; r < c.density.size(); ++r) found.emplace_back(plan.sites.regions[r], c.density[r]);
    }
    std::string out;
    for (const auto& [name, density] : found)
        out += fmt::format("{}{} {:.4g}", out.empty() ? "" : ", ", name, density * 1e-4);  // from 1/m^2
    return out + " /cm2";
}

/// Adds the properties of one class of a skin.
void add_class_notes(const SkinPlan& plan, std::uint32_t class_index, std::vector<CatalogNote>& out) {
    const auto& c = plan.classes[class_index];
    const auto by_region = afferents_by_region(plan, class_index);
    const auto count = std::accumulate(by_region.begin(), by_region.end(), std::uint64_t{0});
    out.push_back({c.name, fmt::format("{} afferents, {}: {}", count, c.afferent.composition(), densities(plan, c)),
                   source_for(c.sources, "density")});
    const auto length = [](double m) { return format_quantity(m, "m"); };
    if (c.depth > 0)
        out.push_back({"",
                       fmt::format("receptive field: stress at a depth of {}{}", length(c.depth),
                                   c.surround > 0 ? fmt::format(", less {:.3g} of that at three times the depth", c.surround) : ""),
                       source_for(c.sources, "depth")});
    else
        out.push_back({"", fmt::format("receptive field: Gaussian, sigma {}", length(c.sigma)), source_for(c.sources, "sigma")});
    if (c.hot_spots > 1)
        out.push_back({"",
                       fmt::format("{} hot spots, spread {} around the centre{}", c.hot_spots, length(c.hot_spot_spread),
                                   c.receptor_per_hot_spot ? ", each with a receptor" : ""),
                       source_for(c.sources, "hot_spots")});
    if (c.velocity > 0)
        out.push_back(
            {"",
             fmt::format("conduction velocity: {} +- {}", format_quantity(c.velocity, "m/s"), format_quantity(c.velocity_spread, "m/s")),
             source_for(c.sources, "velocity")});
    if (c.wave.speed > 0)
        out.push_back(
            {"",
             fmt::format("contact wave: {}, decay {}, radius {}, gain {:g}, changes above {}", format_quantity(c.wave.speed, "m/s"),
                         length(c.wave.decay), length(c.wave.radius), c.wave.gain, format_quantity(c.wave.corner, "Hz")),
             source_for(c.sources, "wave_speed")});
    std::string spread;
    for (const auto& s : c.distributions) spread += fmt::format("{}{} {}", spread.empty() ? "" : ", ", s.parameter, s.text());
    if (!spread.empty()) out.push_back({"", "spread: " + spread, source_for(c.sources, "spread")});
}

ListEntry entry_of_skin(const NamedSkin& named) {
    auto e = list_entry(named.name, "", named.description, fmt::format("skins/{}.toml", named.name));
    const auto plan = load_skin_plan(named.name);
    if (!plan) return e;  // a test checks that every built-in skin loads
    const auto& sites = plan->sites;
    e.notes.push_back({"sites", fmt::format("{}, {:.3g} mm2 each, in {} regions", sites.size(), sites.area * 1e6, sites.regions.size()),
                       source_for(plan->sources, "sites")});
    e.notes.push_back({"felt_area", fmt::format("{:.3g} cm2", plan->felt_area * 1e4), source_for(plan->sources, "felt_area")});
    for (std::uint32_t k = 0; k < plan->classes.size(); ++k) add_class_notes(*plan, k, e.notes);
    return e;
}

}  // namespace

std::vector<ListEntry> contact_entries() {
    std::vector<ListEntry> out;
    const auto rows = contact_parameters();
    for (const auto& i : indenters) {
        auto e = list_entry(i.name, "", i.description, i.source);
        for (const auto& row : rows)
            if (std::find(i.parameters.begin(), i.parameters.end(), row.name) != i.parameters.end())
                e.parameters.push_back({row, "contact"});
        out.push_back(std::move(e));
    }
    auto path = list_pattern("path", "", "position and movement of any indenter");
    for (const auto& row : rows)
        if (is_path_parameter(row.name)) path.parameters.push_back({row, "contact"});
    out.push_back(std::move(path));
    for (const auto& t : named_touches()) {
        auto e = list_entry(t.name, fmt::format("{}, {}", t.force, t.indenter), t.description, "choice");
        const auto add_note = [&](std::string_view subject, const std::vector<Setting>& settings) {
            std::string text;
            for (const auto& s : settings) text += fmt::format("{}{} = {:.4g}", text.empty() ? "" : ", ", s.name, s.value);
            e.notes.push_back({std::string(subject), text + " (SI)", ""});
        };
        add_note("contact", t.settings), add_note(t.force, t.force_settings);
        out.push_back(std::move(e));
    }
    return out;
}

std::vector<ListEntry> skin_entries() {
    std::vector<ListEntry> skins;
    for (const auto& s : named_skins()) skins.push_back(entry_of_skin(s));
    skins.push_back(list_pattern("grid 8x8", "",
                                 "a sensor array of this many rows and columns, 2 mm apart, with an SA-I and an FA-I afferent at each site",
                                 "choice"));
    skins.push_back(list_pattern("path/own.toml", "", "any population file", "doc/skin.md"));
    return skins;
}

}  // namespace corpuscle
