#include "page/pressed_skin.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "skin/contact/indenters.hpp"
#include "skin/plan/skin_outline.hpp"

namespace corpuscle::page {
namespace {

constexpr std::size_t max_page_sites = 1 << 16, max_page_afferents = 1 << 16;
constexpr std::size_t max_pressed_samples = 32;  // simulated at once; bounds the memory for the force at all sites

/// The parameters of position and movement, which are the page's.
bool is_of_movement(std::string_view name) {
    return name == "x" || name == "y" || name == "x1" || name == "y1" || name == "t_start" || name == "t_move";
}

/// "radius=5mm" as an override with the target "contact".
Result<std::vector<ParameterOverride>> contact_overrides(std::span<const std::string> set) {
    std::vector<ParameterOverride> out;
    for (const auto& setting : set) {
        auto parsed = TRY(parse_override("contact." + setting));
        parsed.typed = setting;
        if (is_of_movement(parsed.parameter))
            return bad_input(fmt::format("{}: the position of the contact is that of each request `advance`", setting));
        out.push_back(std::move(parsed));
    }
    return out;
}

Result<std::unique_ptr<Contact>> make_page_contact(const std::string& indenter, std::span<const std::string> set, const Sites& sites,
                                                   const Clock& clock) {
    const auto overrides = TRY(contact_overrides(set));
    auto made = TRY(make_contact(indenter, overrides, sites, clock));
    const std::string_view targets[] = {"contact"};
    TRY(check_all_used(made.unused, targets));
    return std::move(made.result);
}

void add_positions(MessageWriter& answer, const std::string& prefix, const std::vector<Position>& positions) {
    std::vector<float> x, y;
    for (const auto& p : positions) x.push_back(static_cast<float>(p.x)), y.push_back(static_cast<float>(p.y));
    answer.add(prefix + "x", std::span<const float>(x)), answer.add(prefix + "y", std::span<const float>(y));
}

void add_polygons(MessageWriter& answer, const std::string& prefix, const std::vector<Polygon>& polygons) {
    for (std::size_t k = 0; k < polygons.size(); ++k) {
        std::vector<float> xy;
        for (const auto& p : polygons[k]) xy.push_back(static_cast<float>(p.x)), xy.push_back(static_cast<float>(p.y));
        answer.add(prefix + std::to_string(k), std::span<const float>(xy));
    }
}

/// The outline of the skin, and those of its regions.
void add_outline(MessageWriter& answer, const Sites& sites) {
    const auto outline = skin_outline(sites);
    add_polygons(answer, "outline.", outline.skin);
    std::vector<Polygon> borders;
    for (const auto& region : outline.regions) borders.insert(borders.end(), region.begin(), region.end());
    add_polygons(answer, "border.", borders);
}

/// The afferents' positions, classes and regions.
void add_afferents(MessageWriter& answer, std::span<const SkinAfferent> afferents) {
    std::vector<Position> positions;
    std::vector<std::uint8_t> classes;
    std::vector<std::uint32_t> regions;
    for (const auto& a : afferents)
        positions.push_back(a.position), classes.push_back(static_cast<std::uint8_t>(a.class_index)), regions.push_back(a.region);
    add_positions(answer, "", positions);
    answer.add("class", std::span<const std::uint8_t>(classes)), answer.add("region", std::span<const std::uint32_t>(regions));
}

}  // namespace

Result<SkinRequest> read_skin_request(ObjectReader& object) {
    SkinRequest out;
    out.population = TRY(object.text("population"));
    out.set = TRY(object.texts("set"));
    out.indenter = TRY(object.text("indenter", "sphere"));
    out.contact = TRY(object.texts("contact"));
    TRY(object.check_all_read());
    return out;
}

Result<PressedSkin> PressedSkin::make(const SkinRequest& request, const SimulationOptions& options, const Clock& clock) {
    auto plan = TRY(load_built_in_skin_plan(request.population));  // a page must not read files of the machine on which the engine runs
    if (plan.sites.size() > max_page_sites)
        return bad_input(fmt::format("{} has {} sites; the page presses at most {}", plan.name, plan.sites.size(), max_page_sites));
    auto applied = TRY(apply_overrides(std::move(plan), TRY(parse_overrides(request.set))));
    TRY(check_all_used(applied.unused, override_targets(applied.result)));
    PressedSkin out;
    if (auto note = treat_as_skin(applied.result); !note.empty()) out.warnings_.push_back(std::move(note));
    auto innervation = TRY(innervate(std::move(applied.result)));
    if (innervation->afferents.size() > max_page_afferents || innervation->plan.classes.size() > 255)
        return bad_input(fmt::format("{} has {} afferents; the page simulates at most {}", request.population,
                                     innervation->afferents.size(), max_page_afferents));
    const auto set = TRY(instruction_set());
    out.population_ = request.population;
    out.skin_ = TRY(Skin::make(innervation, options, set));
    TRY(out.change_contact(request.indenter, request.contact, clock));
    const auto middle = TRY(read_contact_params(indenters[0], {}, innervation->plan.sites)).result;
    out.middle_ = {middle.x, middle.y, 0};
    return out;
}

void PressedSkin::describe(MessageWriter& answer, std::size_t first_unit) const {
    const auto& plan = innervation().plan;
    Json out = {{"population", population_}, {"description", plan.description}, {"classes", Json::array()}};
    for (std::size_t c = 0; c < plan.classes.size(); ++c) {
        const auto begin = innervation().class_begin[c], end = innervation().class_begin[c + 1];
        out["classes"].push_back({{"name", plan.classes[c].name},
                                  {"afferent", plan.classes[c].afferent_name},
                                  {"first", first_unit + begin},
                                  {"count", end - begin}});
    }
    const auto& at = plan.sites.positions;
    const auto [left, right] = std::minmax_element(at.begin(), at.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    const auto [low, high] = std::minmax_element(at.begin(), at.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
    out["regions"] = plan.sites.regions, out["site_side"] = std::sqrt(plan.sites.area);
    out["left"] = left->x, out["right"] = right->x, out["low"] = low->y, out["high"] = high->y;
    out["x"] = middle_.x, out["y"] = middle_.y;
    out["contact"] = contact_->description();
    out["contact_parameters"] = contact_parameters();
    answer.head["skin"] = std::move(out);
    add_afferents(answer, innervation().afferents);
    add_positions(answer, "site_", at);
    answer.add("site_region", std::span<const std::uint32_t>(plan.sites.region));
    add_outline(answer, plan.sites);
}

Json PressedSkin::contact_parameters() const {
    std::vector<std::pair<std::string, double>> values;
    for (const auto& entry : contact_->metadata())
        if (auto name = entry.name.substr(entry.name.find('.') + 1); !is_of_movement(name))
            values.emplace_back(std::move(name), entry.value);
    // The metadata leave these out if they are 0. The speed is that of ridges through a patch that rests.
    for (const std::string_view name : {"tilt", "azimuth", "speed"})
        if (std::none_of(values.begin(), values.end(), [&](const auto& value) { return value.first == name; }) &&
            (name != "speed" || indenter_ == "grating"))
            values.emplace_back(name, 0);
    auto out = Json::array();
    for (const auto& [name, value] : values) out.push_back({{"name", name}, {"value", value}});
    return out;
}

Result<void> PressedSkin::change_contact(const std::string& indenter, std::span<const std::string> set, const Clock& clock) {
    contact_ = TRY(make_page_contact(indenter, set, innervation().plan.sites, clock));
    indenter_ = indenter;
    return {};
}

Result<void> PressedSkin::press(const ContactForce& all, const std::atomic<bool>& is_stopped, std::uint32_t first_unit,
                                std::vector<Spike>& spikes) {
    ThreadPool pool(1);
    const auto first_spike = spikes.size();
    const auto parts = (all.force.size() + max_pressed_samples - 1) / max_pressed_samples;
    const auto samples =
        parts > 0 ? (all.force.size() + parts - 1) / parts : 0;  // equal parts, because a single sample costs as much as ten
    for (std::size_t at = 0; at < all.force.size(); at += samples) {
        if (is_stopped) return stopped_error();
        const auto count = std::min(samples, all.force.size() - at);
        const auto part = [&](std::span<const double> values) { return values.empty() ? values : values.subspan(at, count); };
        const auto sites = TRY(contact_->press(
            {part(all.force), all.first + static_cast<std::int64_t>(at), part(all.shear_x), part(all.shear_y), part(all.x), part(all.y)}));
        TRY(skin_->respond(sites, count, spikes, pool));
        samples_ += static_cast<std::int64_t>(count);
    }
    for (auto k = first_spike; k < spikes.size(); ++k) spikes[k].afferent_index += first_unit;
    return {};
}

}  // namespace corpuscle::page
