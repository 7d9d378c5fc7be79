#include "run/earlier_outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/text/input_files.hpp"
#include "io/output/output_check.hpp"
#include "run/sinks.hpp"

namespace corpuscle {
namespace {

constexpr std::uintmax_t max_summary_size = std::uintmax_t{256} << 20;  // bytes

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
    const auto is_of = [&](const OutputFormat* format) { return can_write(*format, name); };
    const bool is_former = name == "units.csv" || matches_name("traces#.csv", name);  // written by earlier versions
    if (name == "summary.json" || is_former || std::any_of(std::begin(output_formats), std::end(output_formats), is_of)) return true;
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
        if (name.ends_with(".html") && !is_own_page(peek_input((folder / name).string()))) continue;
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
