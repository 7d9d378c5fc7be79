#include "study/stale.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace corpuscle {

std::vector<std::string> remove_stale(const std::string& directory, const std::vector<std::string>& written) {
    std::vector<std::string> removed;
    std::ifstream file(directory + "/summary.json", std::ios::binary);
    const auto earlier = nlohmann::json::parse(file, nullptr, false);
    if (!earlier.is_object() || earlier.value("program", nlohmann::json()) != "corpuscle" || !earlier.contains("files")) return removed;
    for (const auto& entry : earlier["files"]) {
        if (!entry.is_string()) continue;
        const auto name = entry.get<std::string>();
        std::error_code status;
        const auto path = std::filesystem::path(directory) / name;
        if (std::filesystem::path(name).filename() != name || !std::filesystem::is_regular_file(path, status)) continue;
        if (std::find(written.begin(), written.end(), name) == written.end() && std::filesystem::remove(path, status))
            removed.push_back(name);
    }
    return removed;
}

}  // namespace corpuscle
