#include "cli/output/output_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>

#include "cli/arguments/own_files.hpp"
#include "cli/output/printable.hpp"
#include "cli/respond/respond_arguments.hpp"
#include "run/earlier_outputs.hpp"

namespace corpuscle {

Result<void> write_and_commit(OutputFile& file, const std::string& text) {
    TRY(file.write(text));
    TRY(file.commit());
    return file.is_synced() ? sync_directory_of(file.path()) : Result<void>();
}

Result<void> write_file(const std::string& path, const std::string& text) {
    auto file = OutputFile::create(path);
    return file ? write_and_commit(*file, text) : file.error();
}

std::vector<std::string> file_names_in(const std::string& directory, const std::vector<std::string>& paths) {
    std::vector<std::string> all;
    for (const auto& path : paths)
        if (!directory.empty() && path.starts_with(directory + "/") && path.find('/', directory.size() + 1) == path.npos)
            all.push_back(std::filesystem::path(path).filename().string());
    return all;
}

std::optional<std::string> report_page_path(const RespondArguments& args) {
    if (!args.has_report) return {};
    return !args.report_file.empty() ? args.report_file : args.out.empty() ? "report.html" : args.out + "/report.html";
}

Result<void> check_outputs(const std::string& directory, std::vector<std::string> names, const std::optional<std::string>& page,
                           const std::string& checkpoint, OutputCheck& outputs) {
    if (page) {
        const auto page_names = file_names_in(directory, {*page});
        if (page_names.empty()) TRY(outputs.check_file(*page, is_own_page));
        names.insert(names.end(), page_names.begin(), page_names.end());
    }
    if (!checkpoint.empty()) TRY(outputs.check_file(checkpoint, is_own_checkpoint));
    if (directory.empty()) return {};
    const auto earlier = earlier_outputs(directory);
    const auto is_listed = [&](const std::string& name) { return std::find(earlier.begin(), earlier.end(), name) != earlier.end(); };
    return outputs.check_directory(directory, names, is_listed, is_output_name, is_own_page);
}

std::string written_files_text(const std::vector<std::string>& paths, const std::vector<std::string>& removed) {
    if (paths.empty()) return "Nothing was written: --out DIR writes the spikes, --report writes a report page.\n";
    const auto removed_text =
        removed.empty() ? "" : fmt::format("Removed files of an earlier run: {}\n", printable(fmt::format("{}", fmt::join(removed, ", "))));
    return fmt::format("Written: {}\n{}", printable(fmt::format("{}", fmt::join(paths, ", "))), removed_text);
}

}  // namespace corpuscle
