// Reads the TOML of a population file. No other file of src/skin uses toml++.

#include "skin/plan/skin_spec.hpp"

#include "core/text/toml_reader.hpp"

namespace corpuscle::skins {
namespace {

using Names = TomlReader::Names;

const Names skin_keys = {"title", "unit", "seed", "felt_area", "nerve", "sites", "region", "class", "source"};
const Names skin_sources = {"sites", "felt_area", "nerve"};
const Names sites_keys = {"rows", "columns", "pitch", "area", "list"};
const Names site_keys = {"name", "x", "y", "region"};
const Names region_keys = {"name", "shapes"};
const Names shape_kinds = {"strip", "capsule", "ellipse", "polygon"};
const Names shape_keys = {"strip", "capsule", "ellipse", "polygon", "width", "height", "angle"};
const Names class_keys = {"name",      "afferent",        "set",      "spread",          "density", "per_site", "sigma",
                          "hot_spots", "hot_spot_spread", "velocity", "velocity_spread", "source"};
const Names class_sources = {"afferent", "set",       "spread",          "density",  "per_site",
                             "sigma",    "hot_spots", "hot_spot_spread", "velocity", "velocity_spread"};

/// Reads the tables of a population file. The first error is kept in first_error; reading goes on after it.
class SkinReading : public TomlReader {
public:
    using TomlReader::TomlReader;

    /// The value of a key that must exist. `where` and `example` are for the message.
    LocatedText required(const toml::table& from, std::string_view name, std::string_view where, std::string_view example) {
        if (auto value = scalar(from, name)) return *value;
        reject(from.source(), fmt::format("{}: {} is missing: {} = {}", where, name, name, example));
        return {};
    }

    /// A position [x, y].
    PositionSpec pair(const toml::node& node, std::string_view name) {
        const auto* array = node.as_array();
        if (array && array->size() == 2) return list(*array, name);
        reject(node.source(), fmt::format("{}: a position needs two numbers, [x, y]", name));
        return {};
    }

    std::vector<PositionSpec> positions(const toml::node& node, std::string_view name) {
        std::vector<PositionSpec> out;
        const auto* array = node.as_array();
        if (!array) return reject(node.source(), fmt::format("{} needs positions: [[x, y], [x, y] ...]", name)), out;
        for (const auto& one : *array) out.push_back(pair(one, name));
        return out;
    }

    void shape(const toml::node& node, std::vector<ShapeSpec>& out) {
        const auto* table = node.as_table();
        if (!table) return reject(node.source(), "a shape must be a table, such as {capsule = [[0, 0], [0, 20]], width = 16}");
        reject_unknown_keys(*table, shape_keys, "a shape: ");
        ShapeSpec s;
        for (const auto kind : shape_kinds) {
            const auto* points = table->get(kind);
            if (!points) continue;
            if (!s.kind.text.empty())
                return reject(points->source(), fmt::format("a shape must be a {} or a {}, not both", s.kind.text, kind));
            s.kind = {std::string(kind), location_of(node.source())};
            if (kind == "ellipse")
                s.points.push_back(pair(*points, kind));
            else
                s.points = positions(*points, kind);
        }
        if (s.kind.text.empty()) return reject(node.source(), fmt::format("a shape must be one of {}", fmt::join(shape_kinds, ", ")));
        if (const auto* width = table->get("width"))
            s.width = width->is_array() ? list(*width->as_array(), "width") : std::vector<LocatedText>{};
        if (const auto* width = table->get("width"); width && !width->is_array())
            if (auto value = scalar(*width, "width")) s.width.push_back(*value);
        s.height = scalar(*table, "height"), s.angle = scalar(*table, "angle");
        out.push_back(std::move(s));
    }

    void region(const toml::table& from, std::vector<RegionSpec>& out) {
        reject_unknown_keys(from, region_keys, "[[region]]: ");
        RegionSpec r{required(from, "name", "[[region]]", "\"palm\""), {}};
        const auto* shapes = from.get("shapes");
        if (!shapes || !shapes->is_array())
            return reject(shapes ? shapes->source() : from.source(), "[[region]]: shapes must be a list: shapes = [{capsule = ...}]");
        for (const auto& one : *shapes->as_array()) shape(one, r.shapes);
        out.push_back(std::move(r));
    }

    void site(const toml::node& node, std::vector<SiteSpec>& out) {
        const auto* table = node.as_table();
        if (!table) return reject(node.source(), "a site must be a table, such as {name = \"tip\", x = 0, y = 2}");
        reject_unknown_keys(*table, site_keys, "a site: ");
        out.push_back({required(*table, "name", "a site", "\"tip\""), required(*table, "x", "a site", "0"),
                       required(*table, "y", "a site", "2"), scalar(*table, "region")});
    }

    SitesSpec sites(const toml::node& node) {
        SitesSpec out{location_of(node.source()), {}, {}, {}, {}, {}, {}, {}};
        if (node.is_string()) return out.word = scalar(node, "sites"), out;
        const auto* table = node.as_table();
        if (!table) return reject(node.source(), "sites must be a table, [sites] on a line of its own, or sites = \"channels\""), out;
        reject_unknown_keys(*table, sites_keys, "[sites]: ");
        out.rows = scalar(*table, "rows"), out.columns = scalar(*table, "columns");
        out.pitch = scalar(*table, "pitch"), out.area = scalar(*table, "area");
        const auto* list = table->get("list");
        if (list && list->is_string()) out.file = scalar(*list, "list");
        if (const auto* array = list ? list->as_array() : nullptr) {
            out.has_list = true;
            for (const auto& one : *array) site(one, out.list);
        } else if (list && !list->is_string()) {
            reject(list->source(), "list must contain sites, list = [{name = \"tip\", x = 0, y = 2}], or be the name of a file with them");
        }
        return out;
    }

    /// Reads the keys and values of table `name`, if there is one. Only the keys in `known` are allowed, or any if `known` is empty.
    void settings_table(const toml::table& from, std::string_view name, const Names& known, std::vector<LocatedSetting>& out) {
        const auto* inner = table(from, name);
        if (!inner) return;
        if (!known.empty()) reject_unknown_keys(*inner, known, fmt::format("{}: ", name));
        settings(*inner, "", out);
    }

    void class_spec(const toml::table& from, std::vector<ClassSpec>& out) {
        reject_unknown_keys(from, class_keys, "[[class]]: ");
        ClassSpec c;
        c.location = location_of(from.source());
        c.name = scalar(from, "name"), c.afferent = scalar(from, "afferent"), c.per_site = scalar(from, "per_site");
        c.sigma = scalar(from, "sigma"), c.hot_spots = scalar(from, "hot_spots"), c.hot_spot_spread = scalar(from, "hot_spot_spread");
        c.velocity = scalar(from, "velocity"), c.velocity_spread = scalar(from, "velocity_spread");
        if (const auto* density = from.get("density"); density && !density->is_table())
            c.uniform_density = scalar(*density, "density");
        else
            settings_table(from, "density", {}, c.density);
        settings_table(from, "set", {}, c.set), settings_table(from, "spread", {}, c.spread),
            settings_table(from, "source", class_sources, c.source);
        out.push_back(std::move(c));
    }
};

SkinSpec skin_from(const toml::table& top, SkinReading& reading) {
    SkinSpec out;
    reading.reject_unknown_keys(top, skin_keys, "");
    out.title = reading.scalar(top, "title"), out.unit = reading.scalar(top, "unit"), out.seed = reading.scalar(top, "seed"),
    out.felt_area = reading.scalar(top, "felt_area");
    if (const auto* nerve = top.get("nerve")) out.nerve = reading.pair(*nerve, "nerve");
    if (const auto* sites = top.get("sites")) out.sites = reading.sites(*sites);
    reading.tables(top, "region", "each region", [&](const toml::table& region) { reading.region(region, out.regions); });
    reading.tables(top, "class", "each class of afferents",
                   [&](const toml::table& afferent_class) { reading.class_spec(afferent_class, out.classes); });
    reading.settings_table(top, "source", skin_sources, out.source);
    return out;
}

}  // namespace

Result<SkinSpec> parse_skin_spec(std::string_view text, const std::string& file) {
    const auto top = TRY(parse_toml(text, file));
    SkinReading reading(file);
    auto out = skin_from(top, reading);
    if (reading.first_error) return *reading.first_error;
    out.file = file;
    return out;
}

}  // namespace corpuscle::skins
