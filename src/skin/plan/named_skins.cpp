// Finds populations by name: grids, the built-in populations, and files.

#include "skin/plan/skin_plan.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "core/text/ascii_text.hpp"
#include "core/text/config_file.hpp"
#include "core/text/embedded_files.hpp"
#include "core/text/input_files.hpp"

namespace corpuscle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_file_size = std::size_t{64} << 20;  // bytes

std::string embedded_path(std::string_view name) { return fmt::format("skins/{}.toml", name); }

Error unknown_skin(std::string_view name) {
    std::vector<std::string_view> names = {"grid 8x8"};
    for (const auto& s : named_skins()) names.push_back(s.name);
    return bad_usage(fmt::format("there is no population '{}'{} (there are {}, grid ROWSxCOLUMNS, and files: own.toml)", name,
                                 did_you_mean(name, names), fmt::join(names.begin() + 1, names.end(), ", ")));
}

/// Names and titles of the built-in populations, which are embedded in the program as files.
std::vector<std::pair<std::string, std::string>> embedded_skins() {
    std::vector<std::pair<std::string, std::string>> out;
    for (const auto file : embedded_files()) {
        if (!file.starts_with("skins/")) continue;
        const auto population = parse_toml(*embedded_text(std::string(file)), std::string(file));
        const auto* title = population ? population->get("title") : nullptr;
        out.emplace_back(fs::path(file).stem().string(), title ? title->text : "");
    }
    return out;
}

}  // namespace

std::span<const NamedSkin> named_skins() {
    static const auto texts = embedded_skins();  // a NamedSkin refers to these strings
    static const auto all = [] {
        std::vector<NamedSkin> out;
        for (const auto& [name, title] : texts) out.push_back({name, title});
        return out;
    }();
    return all;
}

Result<SkinPlan> load_skin_plan(std::string_view name, std::span<const Channel> channels) {
    name = trimmed(name);
    if (is_grid_name(name)) return plan_grid(name);
    if (const auto text = embedded_text(embedded_path(lower(name)))) return parse_skin_plan(*text, embedded_path(lower(name)), channels);
    const fs::path path(name);
    std::error_code status;
    if (fs::exists(path, status) && !fs::is_directory(path, status)) {
        const auto text = read_entire_input(path.string(), max_file_size, "population file");
        return text ? parse_skin_plan(*text, path.string(), channels) : Result<SkinPlan>(text.error());
    }
    if (path.extension() == ".toml") return bad_input("cannot be read: there is no such file", {path.string()});
    return unknown_skin(name);
}

}  // namespace corpuscle
