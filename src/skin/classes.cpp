#include "skin/classes.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace corpuscle::skins {
namespace {

constexpr double most_dense = 1e10;             // units a m2: a million in 1 cm2
constexpr double widest = 0.1;                  // m, of a hot spot and of how far they lie
constexpr double slowest = 0.1, fastest = 200;  // m/s

/// Wishes of a file for an afferent, by the name it is asked for; each with its place.
std::vector<Wish> wishes_for(std::string_view afferent, std::span<const SaidSetting> said) {
    std::vector<Wish> out;
    for (const auto& s : said) {
        const auto dot = s.name.rfind('.');  // "adc.bits" is a part's own; "f_B" the afferent's
        if (dot == std::string::npos)
            out.push_back({std::string(afferent), s.name, s.value.text});
        else
            out.push_back({s.name.substr(0, dot), s.name.substr(dot + 1), s.value.text});
    }
    return out;
}

/// An error about wishes as an error in a file: of the first setting that alone brings it about.
template <class F>
Error in_file(std::span<const SaidSetting> said, const Error& all, F&& fails_with) {
    for (std::size_t k = 0; k < said.size(); ++k)
        if (fails_with(said.subspan(k, 1))) return said[k].value.wrong(all.sentence);
    return said.empty() ? all : said.front().value.wrong(all.sentence);
}

Result<AfferentPlan> afferent_of(const SaidClass& said) {
    if (!said.afferent) return bad_input("[[class]]: afferent is missing: afferent = \"sa1\"", said.place);
    const auto& text = said.afferent->text;
    if (const auto known = plan_afferent(text, {}); !known) return said.afferent->wrong(known.error().sentence);
    const auto wishes = wishes_for(text, said.set);
    auto plan = plan_afferent(text, wishes);
    if (!plan) return in_file(said.set, plan.error(), [&](auto some) { return !plan_afferent(text, wishes_for(text, some)); });
    for (std::size_t k = 0; k < wishes.size(); ++k)
        if (!wishes[k].used) return said.set[k].value.wrong(fmt::format("nothing in {} is called '{}'", text, said.set[k].name));
    return plan;
}

Result<std::vector<Spread>> spreads_of(const SaidClass& said, const AfferentPlan& plan) {
    const auto& text = said.afferent->text;
    const auto wishes = wishes_for(text, said.spread);
    auto spreads = spreads_for(plan, text, wishes);
    if (!spreads) {
        auto wrong = in_file(said.spread, spreads.error(), [&](auto some) { return !spreads_for(plan, text, wishes_for(text, some)); });
        if (wrong.sentence.starts_with("--spread ")) wrong.sentence.erase(0, 9);  // there is no such word in a file
        return wrong;
    }
    for (std::size_t k = 0; k < wishes.size(); ++k)
        if (!wishes[k].used) return said.spread[k].value.wrong(fmt::format("nothing in {} is called '{}'", text, said.spread[k].name));
    return spreads;
}

/// Whether a density's key means a region: its name, or the part of it behind a dot.
bool means(std::string_view key, std::string_view region) {
    return region == key || (region.size() > key.size() && region.ends_with(key) && region[region.size() - key.size() - 1] == '.');
}

Result<std::vector<double>> densities_of(const SaidClass& said, const Sites& sites, const SaidNumbers& numbers) {
    const auto density = [&](const Said& s) { return numbers.number(s, "density", "1/m2", 0, most_dense); };
    if (said.even_density) {
        const auto all = density(*said.even_density);
        return all ? std::vector<double>(sites.regions.size(), *all) : Result<std::vector<double>>(all.error());
    }
    std::vector<double> out(sites.regions.size(), -1);
    std::vector<char> exact(sites.regions.size(), 0);
    for (const auto& s : said.density) {
        const auto value = density(s.value);
        if (!value) return value.error();
        bool meant = false;
        for (std::size_t r = 0; r < out.size(); ++r) {
            if (!means(s.name, sites.regions[r])) continue;
            meant = true;
            if (const bool is = sites.regions[r] == s.name; is || !exact[r]) out[r] = *value, exact[r] = is;
        }
        if (meant) continue;
        const std::vector<std::string_view> names(sites.regions.begin(), sites.regions.end());
        return s.value.wrong(
            fmt::format("density: there is no region '{}'{} (there are {})", s.name, did_you_mean(s.name, names), fmt::join(names, ", ")));
    }
    for (std::size_t r = 0; r < out.size(); ++r)
        if (out[r] < 0)
            return bad_input(
                fmt::format("density: none is given for region '{0}'; write {0} = \"0 /cm2\" if it has none", sites.regions[r]),
                said.density.front().value.place);
    return out;
}

/// How many units there are, and where.
Result<void> read_numbers(const SaidClass& said, const Sites& sites, const SaidNumbers& numbers, SkinClass& out) {
    const bool dense = said.even_density || !said.density.empty();
    if (dense == said.per_site.has_value())
        return bad_input(fmt::format("[[class]] {}: either density = \"70 /cm2\" or per_site = 1 is wanted", out.name), said.place);
    if (dense && !(sites.area > 0))
        return bad_input(fmt::format("[[class]] {}: a density wants sites that stand for an area of skin: regions, or area = \"4 mm2\" in "
                                     "[sites]; of sensors say per_site = 1",
                                     out.name),
                         said.place);
    const auto per_site = numbers.whole(said.per_site, "per_site", 1, 1000, 0);
    if (!per_site) return per_site.error();
    out.per_site = static_cast<std::uint32_t>(*per_site);
    if (!dense) return {};
    auto density = densities_of(said, sites, numbers);
    if (!density) return density.error();
    out.density = std::move(*density);
    return {};
}

Result<void> read_field(const SaidClass& said, const SaidNumbers& numbers, SkinClass& out) {
    struct One {
        const MaybeSaid& said;
        std::string_view name, unit;
        double low, high;
        double& to;
    };
    const One all[] = {{said.sigma, "sigma", "m", 0, widest, out.sigma},
                       {said.hot_spot_spread, "hot_spot_spread", "m", 0, widest, out.hot_spot_spread},
                       {said.velocity, "velocity", "m/s", slowest, fastest, out.velocity},
                       {said.velocity_spread, "velocity_spread", "m/s", 0, fastest, out.velocity_spread}};
    for (const auto& one : all) {
        const auto value = numbers.number(one.said, one.name, one.unit, one.low, one.high, 0);
        if (!value) return value.error();
        one.to = *value;
    }
    const auto spots = numbers.whole(said.hot_spots, "hot_spots", 1, 100, 1);
    if (!spots) return spots.error();
    out.hot_spots = static_cast<std::uint32_t>(*spots);
    if (out.hot_spots > 1 && !(out.sigma > 0 && out.hot_spot_spread > 0))
        return said.hot_spots->wrong("several hot spots want a sigma and a hot_spot_spread");
    if (said.velocity_spread && !said.velocity) return said.velocity_spread->wrong("velocity_spread wants a velocity");
    return {};
}

Result<SkinClass> class_of(const SaidClass& said, const Sites& sites, const SaidNumbers& numbers) {
    SkinClass out;
    auto plan = afferent_of(said);
    if (!plan) return plan.error();
    out.name = said.name ? said.name->text : plan->name;
    if (out.name.empty() || out.name.find_first_of("# \t,\n\r\"") != std::string::npos)
        return (said.name ? *said.name : *said.afferent)
            .wrong(fmt::format("'{}' cannot name a class: no blank, comma, # or quote", out.name));
    auto spreads = spreads_of(said, *plan);
    if (!spreads) return spreads.error();
    plan->name = out.name;  // random numbers and outputs go by it: two classes may be of the same afferent
    for (auto& s : *spreads) s.afferent = out.name;
    out.afferent = std::move(*plan), out.spreads = std::move(*spreads), out.sources = sources_of(said.source);
    if (auto ok = read_numbers(said, sites, numbers, out); !ok) return ok.error();
    if (auto ok = read_field(said, numbers, out); !ok) return ok.error();
    return out;
}

}  // namespace

std::vector<Sourced> sources_of(std::span<const SaidSetting> said) {
    std::vector<Sourced> out;
    for (const auto& s : said) out.push_back({s.name, s.value.text});
    return out;
}

Result<std::vector<SkinClass>> classes_of(const SkinText& said, const Sites& sites, const SaidNumbers& numbers) {
    if (said.classes.empty()) return bad_input("a skin without afferents: [[class]]", {said.file});
    std::vector<SkinClass> out;
    for (const auto& c : said.classes) {
        auto one = class_of(c, sites, numbers);
        if (!one) return one.error();
        if (std::any_of(out.begin(), out.end(), [&](const SkinClass& other) { return other.name == one->name; }))
            return (c.name ? *c.name : *c.afferent).wrong(fmt::format("there are two classes '{}'; give one another name", one->name));
        out.push_back(std::move(*one));
    }
    return out;
}

}  // namespace corpuscle::skins
