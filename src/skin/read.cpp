// What a population file means.

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <set>

#include "signal/quantity.hpp"
#include "skin/classes.hpp"
#include "skin/outline.hpp"
#include "skin/site_table.hpp"

namespace corpuscle {
namespace skins {
namespace {

constexpr double largest_place = 10, least_pitch = 10e-6, largest_pitch = 0.1;  // m

/// Numbers of a file with what all lengths in it are in.
Result<SaidNumbers> numbers_of(const SkinText& said) {
    if (!said.unit) return SaidNumbers{};
    const auto unit = parse_unit(said.unit->text);
    if (!unit || !unit->same_kind(*parse_unit("m")))
        return said.unit->wrong(fmt::format("unit = '{}' is no length; write unit = \"mm\"", said.unit->text));
    return SaidNumbers(unit->factor);
}

Result<Position> place_of(const Pair& said, std::string_view name, const SaidNumbers& numbers) {
    Position out;
    for (const auto k : {0U, 1U}) {
        const auto value = numbers.number(said[k], name, "m", -largest_place, largest_place);
        if (!value) return value.error();
        (k == 0 ? out.x : out.y) = *value;
    }
    return out;
}

Result<SkinShape> shape_of(const SaidShape& said, const SaidNumbers& numbers) {
    using Kind = SkinShape::Kind;
    const std::string_view kind = said.kind.text;
    SkinShape out{kind == "strip"     ? Kind::strip
                  : kind == "capsule" ? Kind::capsule
                  : kind == "ellipse" ? Kind::ellipse
                                      : Kind::polygon,
                  {}};
    const bool line = out.kind == Kind::strip || out.kind == Kind::capsule;
    for (const auto& p : said.points) {
        const auto place = place_of(p, kind, numbers);
        if (!place) return place.error();
        out.points.push_back(*place);
    }
    const auto refuse = [&](std::string_view why) { return said.kind.wrong(fmt::format("a {} {}", kind, why)); };
    if (line && out.points.size() != 2) return refuse("wants the two ends of its middle line: [[x, y], [x, y]]");
    if (out.kind == Kind::polygon && (out.points.size() < 3 || out.points.size() > 1000)) return refuse("wants 3 to 1000 corners");
    const bool ellipse = out.kind == Kind::ellipse;
    if (said.height.has_value() != ellipse || (said.angle && !ellipse))
        return refuse(ellipse ? "wants a height, too" : "has neither height nor angle");
    if (out.kind == Kind::polygon) return said.width.empty() ? Result<SkinShape>(out) : refuse("has no width");
    if (said.width.empty() || said.width.size() > (line ? 2U : 1U))
        return refuse(line ? "wants a width, or two, at either end: width = [16, 14]" : "wants one width");
    const auto width = numbers.number(said.width.front(), "width", "m", least_pitch, largest_place);
    if (!width) return width.error();
    const auto other =
        numbers.number(ellipse ? *said.height : said.width.back(), ellipse ? "height" : "width", "m", least_pitch, largest_place);
    if (!other) return other.error();
    const auto angle = numbers.number(said.angle, "angle (degrees)", "", -360, 360, 0);
    if (!angle) return angle.error();
    out.width = *width, out.other = *other, out.turns = *angle / 360;
    return out;
}

Result<Sites> sites_of_regions(const SkinText& said, double pitch, const SaidNumbers& numbers) {
    std::vector<SkinRegion> regions;
    for (const auto& r : said.regions) {
        if (r.name.text.empty()) return r.name.wrong("a region needs a name");
        for (const auto& other : regions)
            if (other.name == r.name.text) return r.name.wrong(fmt::format("there are two regions '{}'", r.name.text));
        auto& region = regions.emplace_back(SkinRegion{r.name.text, {}});
        if (r.shapes.empty()) return r.name.wrong(fmt::format("region '{}' has no shape", r.name.text));
        for (const auto& s : r.shapes) {
            auto shape = shape_of(s, numbers);
            if (!shape) return shape.error();
            region.shapes.push_back(std::move(*shape));
        }
    }
    auto sites = outline_sites(regions, pitch);
    if (!sites) return bad_input(sites.error().sentence, said.sites->place);
    return sites;
}

Result<Sites> sites_of_list(const SaidSites& said, const SaidNumbers& numbers) {
    Sites out;
    std::set<std::string_view> names;
    if (said.list.empty()) return bad_input("list = []: a skin needs sites", said.place);
    for (const auto& s : said.list) {
        const auto place = place_of({s.x, s.y}, s.name.text, numbers);
        if (!place) return place.error();
        if (s.name.text.empty() || !names.insert(s.name.text).second)
            return s.name.wrong(s.name.text.empty() ? "a site needs a name" : fmt::format("there are two sites '{}'", s.name.text));
        out.at.push_back(*place), out.names.push_back(s.name.text);
        const std::string region = s.region ? s.region->text : "skin";
        const auto found = std::find(out.regions.begin(), out.regions.end(), region);
        out.region.push_back(static_cast<std::uint32_t>(found - out.regions.begin()));
        if (found == out.regions.end()) out.regions.push_back(region);
    }
    return out;
}

Result<Sites> sites_of_grid(const SaidSites& said, double pitch, const SaidNumbers& numbers) {
    const auto rows = numbers.whole(said.rows, "rows", 1, most_sites, 0),
               columns = numbers.whole(said.columns, "columns", 1, most_sites, 0);
    if (!rows) return rows.error();
    if (!columns) return columns.error();
    if (*rows == 0 || *columns == 0) return bad_input("a grid wants rows and columns", said.place);
    auto grid = grid_sites(*rows, *columns, pitch);
    if (!grid) return bad_input(grid.error().sentence, said.place);
    return grid;
}

/// What [sites] asks for, before its area.
Result<Sites> sites_asked(const SkinText& said, std::span<const Channel> channels, const SaidNumbers& numbers) {
    const auto& s = *said.sites;
    if (s.word) {
        if (s.word->text != "channels")
            return s.word->wrong(fmt::format("sites = '{}'; a word is known for it: \"channels\"", s.word->text));
        if (channels.empty())
            return s.word->wrong("its sites are a recording's channels: it wants a recording, with a layout that says where they sit");
        auto sites = channel_sites(channels);
        return sites ? sites : Result<Sites>(s.word->wrong(sites.error().sentence));
    }
    const bool grid = s.rows || s.columns, list = s.listed || s.file, outline = !said.regions.empty();
    if (grid + list + outline != 1)
        return bad_input("[sites] wants one of these: rows and columns; a list; pitch and regions ([[region]])", s.place);
    if (list && s.pitch) return s.pitch->wrong("a list of sites has no pitch");
    if (s.file) return read_site_table((std::filesystem::path(said.file).parent_path() / s.file->text).string());
    if (list) return sites_of_list(s, numbers);
    if (!s.pitch) return bad_input("pitch is missing: pitch = \"2 mm\"", s.place);
    const auto pitch = numbers.number(*s.pitch, "pitch", "m", least_pitch, largest_pitch);
    if (!pitch) return pitch.error();
    return grid ? sites_of_grid(s, *pitch, numbers) : sites_of_regions(said, *pitch, numbers);
}

Result<Sites> sites_of(const SkinText& said, std::span<const Channel> channels, const SaidNumbers& numbers) {
    if (!said.sites) return bad_input("nothing says where force is felt: [sites]", {said.file});
    auto sites = sites_asked(said, channels, numbers);
    if (!sites || !said.sites->area) return sites;
    if (!said.regions.empty()) return said.sites->area->wrong("sites of regions stand for pitch squared each; take area away");
    const auto area = numbers.number(*said.sites->area, "area", "m2", 1e-10, 1);
    if (!area) return area.error();
    sites->area = *area;
    return sites;
}

Result<SkinPlan> plan_of(const SkinText& said, std::span<const Channel> channels) {
    const auto numbers = numbers_of(said);
    if (!numbers) return numbers.error();
    SkinPlan plan;
    plan.name = std::filesystem::path(said.file).stem().string(), plan.sentence = said.title ? said.title->text : "";
    auto sites = sites_of(said, channels, *numbers);
    if (!sites) return sites.error();
    plan.sites = std::move(*sites);
    const auto seed = numbers->whole(said.seed, "seed", 0, UINT64_MAX, 1);
    if (!seed) return seed.error();
    plan.seed = *seed;
    const auto felt = numbers->number(said.felt_area, "felt_area", "m2", 1e-10, 1, 0);
    if (!felt) return felt.error();
    if (said.felt_area && !(plan.sites.area > 0))
        return said.felt_area->wrong("felt_area wants sites that stand for an area of skin: regions, or area = \"4 mm2\" in [sites]");
    plan.felt_area = *felt;
    if (!said.nerve.empty()) {
        const auto nerve = place_of(said.nerve, "nerve", *numbers);
        if (!nerve) return nerve.error();
        plan.nerve = *nerve;
    }
    auto classes = classes_of(said, plan.sites, *numbers);
    if (!classes) return classes.error();
    plan.classes = std::move(*classes);
    plan.sources = sources_of(said.source);
    return plan;
}

}  // namespace
}  // namespace skins

Result<SkinPlan> read_skin_plan(std::string_view text, const std::string& file, std::span<const Channel> channels) {
    const auto said = skins::read_skin_text(text, file);
    if (!said) return said.error();
    return skins::plan_of(*said, channels);
}

}  // namespace corpuscle
