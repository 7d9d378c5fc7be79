#include "circuit/export/kit_card.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "core/text/ascii_text.hpp"
#include "core/text/input_files.hpp"
#include "core/text/printable.hpp"

namespace corpuscle::circuit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_card_bytes = std::size_t{1} << 28, max_include_depth = 50, max_names_shown = 8;
constexpr const char* kind_of_card = "file of a kit (--card)";

/// The first words of a line, in small letters. A parenthesis ends a word.
std::vector<std::string> first_card_words(std::string_view line) {
    std::vector<std::string> out;
    auto text = lower(line.substr(0, 400));
    std::ranges::replace_if(text, [](char c) { return c == '\t' || c == '(' || c == '\r'; }, ' ');
    for (const auto word : split(text, ' '))
        if (!word.empty() && out.size() < 3) out.emplace_back(word);
    return out;
}

bool is_include(const std::vector<std::string>& words) { return words[0] == ".include" || words[0] == ".inc"; }
bool is_lib_of_file(const std::vector<std::string>& words) { return words[0] == ".lib" && words.size() > 2; }

/// The path in a line with .include or .lib.
std::string path_in_line(std::string_view line) {
    line = trimmed(line);
    line = trimmed(line.substr(std::min(line.find_first_of(" \t"), line.size())));
    const bool is_quoted = line.starts_with('\'') || line.starts_with('"');
    if (is_quoted) return std::string(line.substr(1, std::min(line.find(line[0], 1), line.size()) - 1));
    return std::string(line.substr(0, line.find_first_of(" \t")));
}

/// A .model or .subckt of a kit's file. `type`: "nmos"; "" if it is not on the same line.
struct CardDevice {
    std::string name, type;
    long line;
};

/// Follows the files that a kit's file includes.
class IncludeFollower {
    std::vector<fs::path> open_;  // from the kit's file to the one that is being read
    std::set<fs::path> read_;

public:
    Result<void> follow(const std::string& path, const std::string& text) {
        open_.push_back(canonical(path)), read_.insert(open_.back());
        long number = 0;
        for (const auto line : split(text, '\n')) {
            ++number;
            const auto words = first_card_words(line);
            if (words.size() < 2 || (!is_include(words) && !is_lib_of_file(words))) continue;
            const auto file = (fs::path(path).parent_path() / path_in_line(line)).string();
            const bool is_open = std::ranges::find(open_, canonical(file)) != open_.end();
            if (is_open && is_include(words))
                return bad_input(
                    fmt::format("this line includes {}, which includes this file; ngspice would read them without end. Remove one "
                                "of the lines",
                                printable(file)),
                    {path, number});
            TRY(read(file));
        }
        open_.pop_back();
        return {};
    }

private:
    static fs::path canonical(const std::string& path) {
        std::error_code failure;
        return fs::weakly_canonical(path, failure);
    }

    /// A file that cannot be read is left to ngspice, which may not need it.
    Result<void> read(const std::string& file) {
        std::error_code failure;
        if (open_.size() > max_include_depth || read_.contains(canonical(file)) || !fs::is_regular_file(file, failure)) return {};
        const auto text = read_entire_input(file, max_card_bytes, kind_of_card);
        return text ? follow(file, *text) : Result<void>();
    }
};

Error missing_device(const std::string& path, std::string_view definition, const std::string& device, const std::vector<CardDevice>& all) {
    std::string names;
    for (std::size_t k = 0; k < std::min(all.size(), max_names_shown); ++k) names += (k > 0 ? ", " : "") + printable(all[k].name);
    return bad_input(fmt::format("--card {}: it has no {} {}; {}", printable(path), definition, device,
                                 all.empty() ? "it has none at all, so name the file of the kit that defines it" : "it has " + names));
}

}  // namespace

Result<void> check_devices_in_card(const KitMap& map, std::string_view text, const std::string& path) {
    const std::string_view definition = map.is_subcircuit ? ".subckt" : ".model";
    std::vector<CardDevice> all;
    long number = 0;
    for (const auto line : split(text, '\n')) {
        const auto words = first_card_words(line);
        ++number;
        if (words.size() < 2) continue;
        if (is_include(words) || is_lib_of_file(words)) return {};  // the device may be in that file
        if (words[0] == definition) all.push_back({words[1], words.size() > 2 && !map.is_subcircuit ? words[2] : "", number});
    }
    for (std::size_t k = 0; k < map.devices.size(); ++k) {
        const auto& device = map.devices[k];
        const auto found = std::ranges::find_if(all, [&](const CardDevice& d) {  // a binned model is nch.1, nch.2 ...
            return d.name == lower(device) || (!map.is_subcircuit && d.name.starts_with(lower(device) + "."));
        });
        if (device.empty()) continue;
        if (found == all.end()) return missing_device(path, definition, device, all);
        const std::string_view type = kit_device_names[k].ends_with("pch") ? "pmos" : "nmos";
        if (!found->type.empty() && found->type != type)
            return bad_input(fmt::format(".model {} is {}, but the device for {} must be {}; name another", device, printable(found->type),
                                         kit_device_names[k], type),
                             {path, found->line});
    }
    return {};
}

Result<void> check_card(const KitMap& map, const std::string& path) {
    std::error_code failure;
    const auto status = fs::status(path, failure);
    if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
        return bad_input("ngspice reads the file of a kit (--card) again, so it cannot be a pipe or a device; name a file", {path});
    const auto text = TRY(read_entire_input(path, max_card_bytes, kind_of_card));
    TRY(check_devices_in_card(map, text, path));
    return IncludeFollower().follow(path, text);
}

}  // namespace corpuscle::circuit
