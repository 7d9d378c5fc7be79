#include "run/earlier_outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/text/input_files.hpp"
#include "io/output/output_check.hpp"

namespace corpuscle {
namespace {

constexpr std::uintmax_t max_summary_size = std::uintmax_t{256} << 20;  // bytes

/// True for the number in a file name: "" for the first file, "-2" for the second.
bool is_file_number(std::string_view text) {
    return text.empty() || (text.size() > 1 && text[0] == '-' && text.find_first_not_of("0123456789", 1) == text.npos);
}

/// True for a regular file. False for a symbolic link, because its target may be outside the directory.
bool is_plain_file(const std::filesystem::path& path) {
    std::error_code status;
    return std::filesystem::symlink_status(path, status).type() == std::filesystem::file_type::regular;
}

}  // namespace

bool is_own_page(std::string_view beginning) {
    const auto head = beginning.substr(0, 1024);
    // The second text is in pages written before the generator tag was added.
    return head.find("<meta name=\"generator\" content=\"corpuscle\">") != head.npos ||
           head.find("content=\"default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">") != head.npos;
}

bool is_output_name(std::string_view name) {
    if (name.find('/') != name.npos || name.find('\0') != name.npos) return false;
    // Earlier versions wrote units.csv and traces*.csv.
    const std::string_view fixed_names[] = {"spikes.csv", "spikes.jsonl",  "spikes.aer", "spikes.aedat", "spikes.npz",
                                            "copies.csv", "afferents.csv", "psth.csv",   "summary.json", "units.csv"};
    if (std::find(std::begin(fixed_names), std::end(fixed_names), name) != std::end(fixed_names)) return true;
    // The part of the name between two texts, or no value if the name does not begin and end with them.
    const auto between = [&](std::string_view before, std::string_view after) {
        return name.size() >= before.size() + after.size() && name.starts_with(before) && name.ends_with(after)
                   ? std::optional(name.substr(before.size(), name.size() - before.size() - after.size()))
                   : std::nullopt;
    };
    for (const auto& [before, after] : {std::pair{"probes", ".csv"}, std::pair{"traces", ".csv"}, std::pair{"spikes", ".wav"}})
        if (const auto number = between(before, after); number && is_file_number(*number)) return true;
    for (const auto* const before : {"vectors-", "rom-"})
        if (const auto afferent = between(before, ".csv"); afferent && !afferent->empty()) return true;
    return name.size() > 5 && name.ends_with(".html");
}

std::vector<std::string> earlier_outputs(const std::string& directory) {
    const std::filesystem::path folder(directory), summary = folder / "summary.json";
    std::error_code status;
    if (!is_plain_file(summary) || std::filesystem::file_size(summary, status) > max_summary_size) return {};
    std::ifstream file(summary, std::ios::binary);
    const auto earlier = nlohmann::json::parse(file, nullptr, false);
    if (!earlier.is_object() || earlier.value("program", nlohmann::json()) != "corpuscle" || !earlier.contains("files") ||
        !earlier["files"].is_array())
        return {};
    std::vector<std::string> all = {"summary.json"};
    for (const auto& entry : earlier["files"]) {
        if (!entry.is_string()) continue;
        auto name = entry.get<std::string>();
        if (!is_output_name(name) || name == "summary.json" || !is_plain_file(folder / name)) continue;
        if (name.ends_with(".html") && !is_own_page(read_beginning((folder / name).string()))) continue;
        all.push_back(std::move(name));
    }
    return all;
}

std::vector<std::string> remove_stale_outputs(const std::string& directory, const std::vector<std::string>& written) {
    std::vector<std::string> removed;
    for (const auto& name : earlier_outputs(directory)) {
        const auto path = (std::filesystem::path(directory) / name).string();
        const bool is_current = name == "summary.json" || std::find(written.begin(), written.end(), name) != written.end();
        if (is_current || known_input_path(path) || !is_plain_file(path)) continue;
        std::error_code status;
        if (std::filesystem::remove(path, status)) removed.push_back(name);
    }
    return removed;
}

}  // namespace corpuscle
