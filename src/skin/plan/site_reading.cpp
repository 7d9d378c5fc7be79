// Reads the sites of a population file: [sites] and [[region]].

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <set>

#include "core/text/ascii_text.hpp"
#include "skin/plan/population_values.hpp"

namespace corpuscle::skins {
namespace {

using KeyKind = ConfigKey::Kind;

constexpr double max_length = 10, min_pitch = 10e-6, max_pitch = 0.1;  // m; min_pitch is also the smallest width of a shape

constexpr auto sites_keys = std::to_array<ConfigKey>({"rows", "columns", "pitch", "area", ConfigKey("list", KeyKind::any)});
constexpr auto site_keys = std::to_array<ConfigKey>({"name", "x", "y", "region"});
constexpr auto region_keys = std::to_array<ConfigKey>({"name", ConfigKey("shapes", KeyKind::any)});
constexpr std::string_view shape_kinds[] = {"strip", "capsule", "ellipse", "polygon"};  // in the order of SkinShape::Kind
constexpr auto shape_keys =
    std::to_array<ConfigKey>({ConfigKey("strip", KeyKind::any), ConfigKey("capsule", KeyKind::any), ConfigKey("ellipse", KeyKind::any),
                              ConfigKey("polygon", KeyKind::any), ConfigKey("width", KeyKind::any), "height", "angle"});

/// The index in shape_kinds of the only key of the table that is one of them.
Result<std::size_t> shape_kind(const ConfigNode& shape) {
    std::optional<std::size_t> kind;
    for (std::size_t k = 0; k < std::size(shape_kinds); ++k) {
        const auto* points = shape.get(shape_kinds[k]);
        if (points && kind)
            return points->error_here(fmt::format("a shape must be a {} or a {}, not both", shape_kinds[*kind], shape_kinds[k]));
        if (points) kind = k;
    }
    return kind ? Result(*kind) : shape.error_here(fmt::format("a shape must be one of {}", joined(shape_kinds)));
}

/// The position of an ellipse, or the positions of another shape.
Result<std::vector<Position>> shape_points(const ConfigNode& points, std::string_view kind, const PopulationValues& values) {
    std::vector<Position> out;
    if (kind == "ellipse") {
        out.push_back(TRY(values.position(points, kind)));
        return out;
    }
    if (!points.is_list()) return points.error_here(fmt::format("{} needs positions: [[x, y], [x, y] ...]", kind));
    for (const auto& one : points.elements) out.push_back(TRY(values.position(one, kind)));
    return out;
}

/// The value of the key `width`, or both values of a list.
Result<std::vector<LocatedText>> widths_of(const ConfigNode& shape) {
    const auto* width = shape.get("width");
    if (!width) return std::vector<LocatedText>{};
    TRY(width->is_list() ? check_list(*width, "width") : check_scalar(*width, "width"));
    return width->is_list() ? std::vector<LocatedText>(width->elements.begin(), width->elements.end()) : std::vector<LocatedText>{*width};
}

/// One shape of a region: {strip = [[x, y], [x, y]], width = [a, b]}.
Result<SkinShape> read_shape(const ConfigNode& in, const PopulationValues& values) {
    using Kind = SkinShape::Kind;
    if (!in.is_table()) return in.error_here("a shape must be a table, such as {capsule = [[0, 0], [0, 20]], width = 16}");
    TRY(check_keys(in, shape_keys, "a shape: "));
    const auto kind = TRY(shape_kind(in));
    const auto name = shape_kinds[kind];
    SkinShape out{static_cast<Kind>(kind), {}};
    out.points = TRY(shape_points(*in.get(name), name, values));
    const auto widths = TRY(widths_of(in));
    const bool is_polygon = out.kind == Kind::polygon, is_ellipse = out.kind == Kind::ellipse, has_centre_line = !is_polygon && !is_ellipse;
    const auto error = [&](std::string_view why) { return in.error_here(fmt::format("a {} {}", name, why)); };
    if (has_centre_line && out.points.size() != 2) return error("needs the two ends of its centre line: [[x, y], [x, y]]");
    if (is_polygon && (out.points.size() < 3 || out.points.size() > 1000)) return error("needs 3 to 1000 corners");
    if (in.has("height") != is_ellipse || (in.has("angle") && !is_ellipse))
        return error(is_ellipse ? "also needs a height" : "has neither height nor angle");
    if (is_polygon) return widths.empty() ? Result<SkinShape>(out) : error("has no width");
    if (widths.empty() || widths.size() > (has_centre_line ? 2U : 1U))
        return error(has_centre_line ? "needs one width, or one for each end: width = [16, 14]" : "needs one width");
    out.width = TRY(values.number(widths.front(), "width", "m", min_pitch, max_length));
    out.end_width = TRY(is_ellipse ? values.number_of(in, "height", "m", min_pitch, max_length)
                                   : values.number(widths.back(), "width", "m", min_pitch, max_length));
    const auto* angle = in.get("angle");
    const double degrees = TRY(angle ? values.number(*angle, "angle", "deg", -360, 360) : 0);
    out.turns = degrees / 360;
    return out;
}

Result<SkinRegion> read_region(const ConfigNode& in, std::span<const SkinRegion> earlier, const PopulationValues& values) {
    TRY(check_keys(in, region_keys, "[[region]]: "));
    const auto name = TRY(required_text(in, "name", "[[region]]", "\"palm\""));
    const auto* shapes = in.get("shapes");
    if (!shapes || !shapes->is_list())
        return (shapes ? *shapes : in).error_here("[[region]]: shapes must be a list: shapes = [{capsule = ...}]");
    if (name.text.empty()) return name.error_here("a region needs a name");
    for (const auto& other : earlier)
        if (other.name == name.text) return name.error_here(fmt::format("there are two regions '{}'", name.text));
    if (shapes->elements.empty()) return name.error_here(fmt::format("region '{}' has no shape", name.text));
    SkinRegion out{name.text, {}};
    for (const auto& shape : shapes->elements) out.shapes.push_back(TRY(read_shape(shape, values)));
    return out;
}

/// Adds one site of [sites] list = [...]. `names`: of the sites so far.
Result<void> add_site(const ConfigNode& in, const PopulationValues& values, std::set<std::string>& names, Sites& out) {
    if (!in.is_table()) return in.error_here("a site must be a table, such as {name = \"tip\", x = 0, y = 2}");
    TRY(check_keys(in, site_keys, "a site: "));
    const auto name = TRY(required_text(in, "name", "a site", "\"tip\""));
    const auto x = TRY(required_text(in, "x", "a site", "0")), y = TRY(required_text(in, "y", "a site", "2"));
    const auto position = TRY(values.position(x, y, name.text));
    if (name.text.empty() || !names.insert(name.text).second)
        return name.error_here(name.text.empty() ? "a site needs a name" : fmt::format("there are two sites '{}'", name.text));
    const auto* region = in.get("region");
    out.add(position, name.text, region ? region->text : "skin");
    return {};
}

Result<Sites> sites_of_channels(const ConfigNode& word, std::span<const Channel> channels) {
    if (word.text != "channels") return word.error_here(fmt::format("sites = '{}': the only word allowed is \"channels\"", word.text));
    if (channels.empty())
        return word.error_here(
            "the sites are the channels of a recording, so this population needs a recording with a layout that gives their positions");
    return channel_sites(channels);
}

/// The sites of the table [sites], without the value of its key `area`. `file`: the name of the population file.
Result<Sites> requested_sites(const ConfigNode& in, std::span<const ConfigNode> regions, const std::string& file,
                              const PopulationValues& values) {
    const auto* list = in.get("list");
    const bool is_grid = in.has("rows") || in.has("columns");
    if (is_grid + (list != nullptr) + !regions.empty() != 1)
        return in.error_here("[sites] needs either rows and columns, or a list, or pitch and regions ([[region]])");
    if (list && in.has("pitch")) return in.get("pitch")->error_here("a list of sites has no pitch");
    if (list && list->is_scalar()) return read_site_table((std::filesystem::path(file).parent_path() / list->text).string());
    if (list && !list->is_list())
        return list->error_here("list must contain sites, list = [{name = \"tip\", x = 0, y = 2}], or be the name of a file with them");
    if (list && list->elements.empty()) return in.error_here("list = []: a skin needs sites");
    if (list) {
        Sites out;
        std::set<std::string> names;
        for (const auto& site : list->elements) TRY(add_site(site, values, names, out));
        return out;
    }
    if (!in.has("pitch")) return in.error_here("pitch is missing: pitch = \"2 mm\"");
    const auto pitch = TRY(values.number_of(in, "pitch", "m", min_pitch, max_pitch));
    if (is_grid) {
        const auto rows = TRY(values.integer(in, "rows", 1, max_sites, 0)), columns = TRY(values.integer(in, "columns", 1, max_sites, 0));
        return rows == 0 || columns == 0 ? Result<Sites>(bad_input("a grid needs rows and columns")) : grid_sites(rows, columns, pitch);
    }
    std::vector<SkinRegion> filled;
    for (const auto& region : regions) filled.push_back(TRY(read_region(region, filled, values)));
    return fill_regions(filled, pitch);
}

}  // namespace

Result<Sites> read_sites(const ConfigNode& top, std::span<const Channel> channels, const PopulationValues& values) {
    const auto* in = top.get("sites");
    if (!in) return bad_input("the sites are missing: [sites]", {top.location.file});
    if (!in->is_scalar() && !in->is_table())
        return in->error_here("sites must be a table, [sites] on a line of its own, or sites = \"channels\"");
    if (in->is_table()) TRY(check_keys(*in, sites_keys, "[sites]: "));
    const auto regions = top.elements_of("region");
    auto sites = in->is_scalar() ? sites_of_channels(*in, channels) : requested_sites(*in, regions, top.location.file, values);
    if (!sites) return sites.error().location.file.empty() ? in->error_here(sites.error().message) : sites.error();
    const auto* area = in->get("area");
    if (!area) return sites;
    if (!regions.empty()) return area->error_here("each site of a region represents pitch squared; remove area");
    sites->area = TRY(values.number(*area, "area", "m2", 1e-10, 1));
    return sites;
}

}  // namespace corpuscle::skins
