// Interprets a population file: converts and checks the values of a SkinSpec, and makes a SkinPlan.

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/text/quantity.hpp"
#include "skin/plan/class_reading.hpp"
#include "skin/plan/regions.hpp"
#include "skin/plan/site_table.hpp"

namespace corpuscle {
namespace skins {
namespace {

constexpr double max_coordinate = 10, min_pitch = 10e-6, max_pitch = 0.1;  // m; min_pitch is also the smallest width of a shape

/// The reader of a file's numbers, with the file's unit of length.
Result<NumberReader> numbers_of(const SkinSpec& spec) {
    if (!spec.unit) return NumberReader{};
    const auto unit = parse_unit(spec.unit->text);
    if (!unit || !unit->has_same_dimension(*parse_unit("m")))
        return spec.unit->error_here(fmt::format("unit = '{}' is not a unit of length; write unit = \"mm\"", spec.unit->text));
    return NumberReader(unit->factor);
}

/// `name`: the key to which the position belongs, for messages.
Result<Position> position_of(const PositionSpec& spec, std::string_view name, const NumberReader& numbers) {
    Position out;
    for (const auto k : {0U, 1U}) {
        const auto value = TRY(numbers.number(spec[k], name, "m", -max_coordinate, max_coordinate));
        (k == 0 ? out.x : out.y) = value;
    }
    return out;
}

Result<SkinShape> shape_of(const ShapeSpec& spec, const NumberReader& numbers) {
    using Kind = SkinShape::Kind;
    const std::string_view kind = spec.kind.text;
    SkinShape out{kind == "strip"     ? Kind::strip
                  : kind == "capsule" ? Kind::capsule
                  : kind == "ellipse" ? Kind::ellipse
                                      : Kind::polygon,
                  {}};
    const bool has_centre_line = out.kind == Kind::strip || out.kind == Kind::capsule;
    for (const auto& p : spec.points) out.points.push_back(TRY(position_of(p, kind, numbers)));
    const auto error = [&](std::string_view why) { return spec.kind.error_here(fmt::format("a {} {}", kind, why)); };
    if (has_centre_line && out.points.size() != 2) return error("needs the two ends of its centre line: [[x, y], [x, y]]");
    if (out.kind == Kind::polygon && (out.points.size() < 3 || out.points.size() > 1000)) return error("needs 3 to 1000 corners");
    const bool is_ellipse = out.kind == Kind::ellipse;
    if (spec.height.has_value() != is_ellipse || (spec.angle && !is_ellipse))
        return error(is_ellipse ? "also needs a height" : "has neither height nor angle");
    if (out.kind == Kind::polygon) return spec.width.empty() ? Result<SkinShape>(out) : error("has no width");
    if (spec.width.empty() || spec.width.size() > (has_centre_line ? 2U : 1U))
        return error(has_centre_line ? "needs one width, or one for each end: width = [16, 14]" : "needs one width");
    const auto width = TRY(numbers.number(spec.width.front(), "width", "m", min_pitch, max_coordinate));
    // The second width of a strip or capsule, or the height of an ellipse.
    const auto other =
        numbers.number(is_ellipse ? *spec.height : spec.width.back(), is_ellipse ? "height" : "width", "m", min_pitch, max_coordinate);
    if (!other) return other.error();
    const auto angle = TRY(numbers.number(spec.angle, "angle (degrees)", "", -360, 360, 0));
    out.width = width, out.end_width = *other, out.turns = angle / 360;
    return out;
}

Result<Sites> sites_of_regions(const SkinSpec& spec, double pitch, const NumberReader& numbers) {
    std::vector<SkinRegion> regions;
    for (const auto& r : spec.regions) {
        if (r.name.text.empty()) return r.name.error_here("a region needs a name");
        for (const auto& other : regions)
            if (other.name == r.name.text) return r.name.error_here(fmt::format("there are two regions '{}'", r.name.text));
        auto& region = regions.emplace_back(SkinRegion{r.name.text, {}});
        if (r.shapes.empty()) return r.name.error_here(fmt::format("region '{}' has no shape", r.name.text));
        for (const auto& s : r.shapes) region.shapes.push_back(TRY(shape_of(s, numbers)));
    }
    auto sites = fill_regions(regions, pitch);
    if (!sites) return bad_input(sites.error().message, spec.sites->location);  // only called if the file has [sites]
    return sites;
}

Result<Sites> sites_of_list(const SitesSpec& spec, const NumberReader& numbers) {
    Sites out;
    std::set<std::string_view> names;
    if (spec.list.empty()) return bad_input("list = []: a skin needs sites", spec.location);
    for (const auto& s : spec.list) {
        const auto position = TRY(position_of({s.x, s.y}, s.name.text, numbers));
        if (s.name.text.empty() || !names.insert(s.name.text).second)
            return s.name.error_here(s.name.text.empty() ? "a site needs a name" : fmt::format("there are two sites '{}'", s.name.text));
        out.positions.push_back(position), out.names.push_back(s.name.text);
        const std::string region = s.region ? s.region->text : "skin";
        const auto found = std::find(out.regions.begin(), out.regions.end(), region);
        out.region.push_back(static_cast<std::uint32_t>(found - out.regions.begin()));
        if (found == out.regions.end()) out.regions.push_back(region);
    }
    return out;
}

Result<Sites> sites_of_grid(const SitesSpec& spec, double pitch, const NumberReader& numbers) {
    const auto rows = TRY(numbers.integer(spec.rows, "rows", 1, max_sites, 0));
    const auto columns = TRY(numbers.integer(spec.columns, "columns", 1, max_sites, 0));
    if (rows == 0 || columns == 0) return bad_input("a grid needs rows and columns", spec.location);
    auto grid = grid_sites(rows, columns, pitch);
    if (!grid) return bad_input(grid.error().message, spec.location);
    return grid;
}

/// The sites that [sites] describes, without the value of its key `area`. The file must have [sites].
Result<Sites> requested_sites(const SkinSpec& spec, std::span<const Channel> channels, const NumberReader& numbers) {
    const auto& s = *spec.sites;
    if (s.word) {
        if (s.word->text != "channels")
            return s.word->error_here(fmt::format("sites = '{}': the only word allowed is \"channels\"", s.word->text));
        if (channels.empty())
            return s.word->error_here(
                "the sites are the channels of a recording, so this population needs a recording with a layout that gives their positions");
        auto sites = channel_sites(channels);
        return sites ? sites : Result<Sites>(s.word->error_here(sites.error().message));
    }
    const bool is_grid = s.rows || s.columns, is_list = s.has_list || s.file, has_regions = !spec.regions.empty();
    if (is_grid + is_list + has_regions != 1)
        return bad_input("[sites] needs either rows and columns, or a list, or pitch and regions ([[region]])", s.location);
    if (is_list && s.pitch) return s.pitch->error_here("a list of sites has no pitch");
    if (s.file) return read_site_table((std::filesystem::path(spec.file).parent_path() / s.file->text).string());
    if (is_list) return sites_of_list(s, numbers);
    if (!s.pitch) return bad_input("pitch is missing: pitch = \"2 mm\"", s.location);
    const auto pitch = TRY(numbers.number(*s.pitch, "pitch", "m", min_pitch, max_pitch));
    return is_grid ? sites_of_grid(s, pitch, numbers) : sites_of_regions(spec, pitch, numbers);
}

/// The sites of a population file.
Result<Sites> sites_of(const SkinSpec& spec, std::span<const Channel> channels, const NumberReader& numbers) {
    if (!spec.sites) return bad_input("the sites are missing: [sites]", {spec.file});
    auto sites = requested_sites(spec, channels, numbers);
    if (!sites || !spec.sites->area) return sites;
    if (!spec.regions.empty()) return spec.sites->area->error_here("each site of a region represents pitch squared; remove area");
    const auto area = TRY(numbers.number(*spec.sites->area, "area", "m2", 1e-10, 1));
    sites->area = area;
    return sites;
}

Result<SkinPlan> plan_of(const SkinSpec& spec, std::span<const Channel> channels) {
    const auto numbers = TRY(numbers_of(spec));
    SkinPlan plan;
    plan.name = std::filesystem::path(spec.file).stem().string(), plan.description = spec.title ? spec.title->text : "";
    auto sites = TRY(sites_of(spec, channels, numbers));
    plan.sites = std::move(sites);
    const auto seed = TRY(numbers.integer(spec.seed, "seed", 0, UINT64_MAX, 1));
    plan.seed = seed;
    const auto felt_area = TRY(numbers.number(spec.felt_area, "felt_area", "m2", 1e-10, 1, 0));
    if (spec.felt_area && !(plan.sites.area > 0))
        return spec.felt_area->error_here("felt_area needs sites that represent an area of skin: regions, or area = \"4 mm2\" in [sites]");
    plan.felt_area = felt_area;
    if (!spec.nerve.empty()) {
        const auto nerve = TRY(position_of(spec.nerve, "nerve", numbers));
        plan.nerve = nerve;
    }
    auto classes = TRY(read_classes(spec, plan.sites, numbers));
    plan.classes = std::move(classes);
    plan.sources = read_sources(spec.source);
    return plan;
}

}  // namespace
}  // namespace skins

Result<SkinPlan> parse_skin_plan(std::string_view text, const std::string& file, std::span<const Channel> channels) {
    const auto spec = TRY(skins::parse_skin_spec(text, file));
    return skins::plan_of(spec, channels);
}

}  // namespace corpuscle
