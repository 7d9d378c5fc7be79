#include "circuit/export/kit_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "core/text/embedded_files.hpp"
#include "core/text/input_files.hpp"
#include "core/text/printable.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle::circuit {
namespace {

using enum ConfigKey::Kind;

constexpr std::string_view maps_folder = "process/kits/", map_extension = ".toml";
constexpr std::size_t max_map_bytes = 1 << 20;
constexpr double max_hv_shift = 5;  // V
constexpr ConfigKey map_keys[] = {{"instance"},          {"length_unit"},      {"multiplier", list},     {"areas", flag},
                                  {"temperature", flag}, {"threshold"},        {"pmos_threshold"},       {"hv_shift"},
                                  {"mobility"},          {"lines", list},      {"mismatch_lines", list}, {"last_lines", list},
                                  {"devices", settings}, {"models", settings}, {"corners", settings}};
/// The directives that a line of a map may be. Others could end the deck or run commands.
constexpr std::string_view allowed_directives[] = {".lib", ".include", ".inc", ".param", ".options", ".option", ".global", ".func"};

bool is_kit_name_character(char c) {
    return (c >= '0' && c <= '9') || (lower(c) >= 'a' && lower(c) <= 'z') || std::string_view("_.$:-").find(c) != std::string_view::npos;
}

Result<std::string> name_of(const LocatedText& text, std::string_view key) {
    TRY(text.located(check_kit_name(key, text.text)));
    return text.text;
}

/// The name of a parameter that an instance gets besides those that the export writes itself.
Result<std::string> parameter_of(const LocatedText& text, std::string_view key) {
    constexpr std::string_view written[] = {"w", "l", "ad", "as", "pd", "ps", "temp", "dtemp"};
    const auto name = TRY(name_of(text, key));
    if (lower(name[0]) < 'a' || lower(name[0]) > 'z')
        return text.error_here(
            fmt::format("{} = '{}' is not the name of a parameter; write one such as m or delvto", key, printable(name)));
    if (std::ranges::find(written, lower(name)) == std::end(written)) return name;
    return text.error_here(fmt::format("{} = '{}': the export writes {} itself; name another parameter", key, name, name));
}

/// One of two words, as true for the first.
Result<bool> choice_of(const ConfigNode& node, std::string_view key, std::string_view yes, std::string_view no) {
    if (node.text == yes || node.text == no) return node.text == yes;
    return node.error_here(fmt::format("{} = '{}'; write {} or {}", key, printable(node.text), yes, no));
}

Result<std::vector<std::string>> lines_of(const ConfigNode& map, std::string_view key) {
    std::vector<std::string> out;
    for (const auto& line : map.elements_of(key)) {
        const auto& text = line.text;
        if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t'; }))
            return line.error_here(
                fmt::format("{}: '{}' has a line break or a control character; write a list of lines", key, printable(text)));
        const auto first = lower(text.substr(0, text.find_first_of(" \t")));
        const bool is_allowed =
            std::find(std::begin(allowed_directives), std::end(allowed_directives), first) != std::end(allowed_directives);
        if (!is_allowed && !text.starts_with('*'))
            return line.error_here(
                fmt::format("{}: '{}' is not one of {}, or a comment with *", key, printable(text), joined(allowed_directives)));
        TRY(line.located(fill_kit_line(text, {}), fmt::format("{}: ", key)));
        out.push_back(text);
    }
    const auto reads_card = [](const std::string& line) { return line[0] == '.' && line.find("{card}") != std::string::npos; };
    if (key == "last_lines" || !map.has(key) || std::ranges::any_of(out, reads_card)) return out;
    return map.get(key)->error_here(
        fmt::format("{}: no line reads the kit's file; add .include '{{card}}' or .lib '{{card}}' {{corner}}", key));
}

Result<KitDevice> device_of(const LocatedText& at, std::string_view name) {
    const auto found = std::find(std::begin(kit_device_names), std::end(kit_device_names), name);
    if (found != std::end(kit_device_names)) return static_cast<KitDevice>(found - std::begin(kit_device_names));
    return at.error_here(
        fmt::format("there is no '{}'{} (there are {})", printable(name), did_you_mean(name, kit_device_names), joined(kit_device_names)));
}

Result<double> length_of(const ConfigNode& node) {
    const auto metres = parse_quantity(fmt::format("1 {}", node.text), "m");
    if (metres && *metres > 0 && *metres <= 1) return *metres;
    return node.error_here(fmt::format("length_unit = '{}' is not a unit of length; write m, um or nm", printable(node.text)));
}

Result<double> shift_of(const ConfigNode& node) {
    const auto volts = TRY(node.located(parse_quantity(node.text, "V"), "hv_shift: "));
    if (volts >= 0 && volts <= max_hv_shift) return volts;
    return node.error_here(fmt::format("hv_shift = '{}' is outside [0, {}] V", printable(node.text), max_hv_shift));
}

Result<void> read_instance(const ConfigNode& map, KitMap& out) {
    if (const auto* node = map.get("instance")) out.is_subcircuit = TRY(choice_of(*node, "instance", "X", "M"));
    if (const auto* node = map.get("length_unit")) out.length_unit = TRY(length_of(*node));
    for (const auto& node : map.elements_of("multiplier")) out.multipliers.push_back(TRY(parameter_of(node, "multiplier")));
    if (!map.has("multiplier")) out.multipliers = {"m"};
    const auto is_on = [&](std::string_view key, bool otherwise) { return map.has(key) ? map.get(key)->text == "true" : otherwise; };
    out.has_areas = is_on("areas", true), out.has_temperature = is_on("temperature", !out.is_subcircuit);
    if (const auto* node = map.get("threshold"); node != nullptr && node->text != "gate")
        out.threshold = TRY(parameter_of(*node, "threshold"));
    if (const auto* node = map.get("pmos_threshold"))
        out.pmos_threshold_is_negative = TRY(choice_of(*node, "pmos_threshold", "negative", "positive"));
    if (const auto* node = map.get("hv_shift")) out.hv_shift = TRY(shift_of(*node));
    if (const auto* node = map.get("mobility")) out.mobility = TRY(parameter_of(*node, "mobility"));
    return {};
}

Result<void> read_tables(const ConfigNode& map, KitMap& out) {
    for (const auto& [name, value] : map.settings("devices"))
        out.devices[static_cast<std::size_t>(TRY(device_of(value, name)))] = TRY(name_of(value, name));
    for (const auto& [name, value] : map.settings("models")) out.models[lower(name)] = TRY(device_of(value, value.text));
    for (const auto& [name, value] : map.settings("corners")) out.corners[lower(name)] = TRY(name_of(value, name));
    return {};
}

}  // namespace

Result<void> check_kit_name(std::string_view label, std::string_view name) {
    if (!name.empty() && std::all_of(name.begin(), name.end(), is_kit_name_character)) return {};
    return bad_input(fmt::format("{}: '{}' is not a name of ngspice; use letters, digits and _ . $ : -", label, printable(name)));
}

Result<std::string> fill_kit_line(const std::string& line, const KitPlaceholders& values) {
    std::string out;
    for (std::size_t at = 0; at < line.size();) {
        const auto open = line.find('{', at), close = line.find('}', std::min(open, line.size()));
        out += line.substr(at, std::min(open, line.size()) - at);
        if (open == std::string::npos) break;
        const auto name = line.substr(open, close == std::string::npos ? close : close + 1 - open);
        if (name == "{card}") out += values.card;
        if (name == "{folder}") out += values.folder;
        if (name == "{corner}") out += values.corner;
        if (name != "{card}" && name != "{folder}" && name != "{corner}")
            return bad_input(
                fmt::format("'{}' is not {{card}}, {{folder}} or {{corner}}; write expressions in quotes, '2*w'", printable(name)));
        at = close + 1;
    }
    return out;
}

Result<KitMap> parse_kit_map(std::string_view text, const std::string& name) {
    const auto map = TRY(parse_toml(text, name));
    TRY(check_keys(map, map_keys, ""));
    KitMap out;
    out.name = name;
    TRY(read_instance(map, out));
    TRY(read_tables(map, out));
    out.lines = TRY(lines_of(map, "lines"));
    if (!map.has("lines")) out.lines = {".include '{card}'"};
    out.mismatch_lines = TRY(lines_of(map, "mismatch_lines"));
    out.last_lines = TRY(lines_of(map, "last_lines"));
    return out;
}

std::vector<std::string> kit_map_names() {
    std::vector<std::string> out;
    for (auto path : embedded_files())
        if (path.starts_with(maps_folder))
            out.emplace_back(path.substr(maps_folder.size(), path.size() - maps_folder.size() - map_extension.size()));
    return out;
}

Result<KitMap> read_kit_map(const std::string& name_or_path) {
    const auto names = kit_map_names();
    if (std::find(names.begin(), names.end(), name_or_path) != names.end())
        return parse_kit_map(TRY(embedded_text(fmt::format("{}{}{}", maps_folder, name_or_path, map_extension))), name_or_path);
    const auto text = read_entire_input(name_or_path, max_map_bytes, "map of a kit (--map)");
    if (text) return parse_kit_map(*text, name_or_path);
    return bad_input(fmt::format("{}; the built-in maps are {}", text.error().message, joined(names)), text.error().location);
}

}  // namespace corpuscle::circuit
