#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/output/output_files.hpp"
#include "cli/output/terminal.hpp"
#include "cli/respond/planned_run.hpp"
#include "core/text/ascii_text.hpp"
#include "io/output/output_check.hpp"
#include "io/table/foreign_format.hpp"
#include "run/earlier_outputs.hpp"

namespace corpuscle {
namespace {

/// The formats that are written in this run. Returns an error if one of them cannot be written.
Result<std::vector<const OutputFormat*>> wanted_formats(const OutputRequest& request) {
    std::vector<const OutputFormat*> wanted;
    for (const auto* format : output_formats) {
        if (!is_wanted(*format, request)) continue;
        const bool is_of_trials = format == &psth_format && request.trials;  // --bin is then also for the page and --json
        if (!format->option.empty() && request.directory.empty() && !is_of_trials)
            return bad_usage(fmt::format("{} needs --out DIR", format->option));
        wanted.push_back(format);
    }
    for (const auto* format : wanted) TRY(format->check(request));
    if (request.directory.empty()) wanted.clear();
    return wanted;
}

/// The file names of the paths that are directly in this directory, without the other paths.
std::vector<std::string> file_names_in(const std::string& directory, const std::vector<std::string>& paths) {
    std::vector<std::string> all;
    for (const auto& path : paths)
        if (!directory.empty() && path.starts_with(directory + "/") && path.find('/', directory.size() + 1) == path.npos)
            all.push_back(std::filesystem::path(path).filename().string());
    return all;
}

/// The command line without the options that do not change the response, so that files that contain it do not depend on them.
std::string response_command(const CommonArguments& common) {
    std::string out = "corpuscle respond";
    for (const auto& [name, values] : common.typed) {
        if (is_output_option(name)) continue;
        const bool is_flag = values.empty() || values == std::vector<std::string>{"true"};
        if (is_flag) out += " " + name;
        for (std::size_t k = 0; k < values.size() && !is_flag; ++k)
            out += (name == "FORCE" ? " " : " " + name + " ") + quote_shell_word(values[k]);
    }
    return out;
}

/// Checks that each output may be written: the files `names` in the directory, the report page and the checkpoint.
Result<void> check_outputs(const OutputArguments& args, std::vector<std::string> names, bool overwrite) {
    OutputCheck check(overwrite);
    if (args.page) {
        const auto page_names = file_names_in(args.directory, {*args.page});
        if (page_names.empty()) TRY(check.check_file(*args.page, is_own_page));
        names.insert(names.end(), page_names.begin(), page_names.end());
    }
    if (!args.checkpoint.empty()) TRY(check.check_file(args.checkpoint, is_own_checkpoint));
    if (args.directory.empty()) return {};
    const auto earlier = earlier_outputs(args.directory);
    const auto is_listed = [&](const std::string& name) { return std::find(earlier.begin(), earlier.end(), name) != earlier.end(); };
    return check.check_directory(args.directory, names, is_listed, is_output_name, is_own_page);
}

}  // namespace

bool is_output_option(std::string_view name) {
    constexpr std::string_view options[] = {"--checkpoint", "--out",  "--report",  "--overwrite",
                                            "--quiet",      "--json", "--threads", "--nwb-field"};
    const auto is_of = [&](const OutputFormat* format) { return format->option == name; };
    return std::find(std::begin(options), std::end(options), name) != std::end(options) ||
           std::any_of(std::begin(output_formats), std::end(output_formats), is_of);
}

/// Removes the files that were not committed. The last one is removed first: the first one may have created the directory, and removes it
/// if it is empty by then.
RunOutputs::~RunOutputs() {
    report_file_.reset(), summary_file_.reset();
    while (!files_.empty()) files_.pop_back();
}

Result<void> RunOutputs::open(const OutputArguments& args, PlannedRun& run, const CommonArguments& common) {
    auto request = run.output_request();
    request.directory = directory_ = args.directory, request.options = args.formats, request.trials = run.trials();
    request.nwb_fields = args.nwb_fields, request.command = response_command(common);
    request.seed = run.options().seed, request.sampled = run.options().sampled;
    const auto formats = TRY(wanted_formats(request));
    std::vector<std::string> names;
    for (const auto* format : formats)
        for (auto& name : file_names_of(*format, request)) names.push_back(std::move(name));
    if (!directory_.empty()) names.emplace_back("summary.json");
    TRY(check_outputs(args, std::move(names), common.overwrite));
    for (const auto* format : formats) files_.push_back(TRY(format->make(request)));
    if (!directory_.empty()) summary_file_ = TRY(OutputFile::create(directory_ + "/summary.json"));
    if (!args.page) return {};
    report_ = &run.start_report();
    report_file_ = TRY(OutputFile::create(*args.page));
    return {};
}

void RunOutputs::add_sinks(std::vector<Sink*>& sinks) const {
    for (const auto& file : files_) sinks.push_back(&*file);
    if (report_) sinks.push_back(report_);
}

std::vector<std::string> RunOutputs::paths() const {
    std::vector<std::string> all;
    for (const auto& file : files_)
        for (auto& path : file->paths()) all.push_back(std::move(path));
    if (summary_file_) all.push_back(summary_file_->path());
    if (report_file_) all.push_back(report_file_->path());
    return all;
}

std::vector<std::string> RunOutputs::file_names() const { return file_names_in(directory_, paths()); }

Result<void> RunOutputs::commit(const PlannedRun& run, const nlohmann::ordered_json& document) {
    if (report_) TRY(write_and_commit(*report_file_, run.page(document)));
    for (auto& file : files_) TRY(file->commit());
    if (!summary_file_) return {};
    removed_ = remove_stale_outputs(directory_, file_names());
    return write_and_commit(*summary_file_, json_text(document) + "\n");
}

std::string RunOutputs::written_text() const {
    const auto all = paths();
    if (all.empty()) return "Nothing was written: --out DIR writes the spikes, --report writes a report page.\n";
    const auto removed_text = removed_.empty() ? "" : fmt::format("Removed files of an earlier run: {}\n", printable(joined(removed_)));
    return fmt::format("Written: {}\n{}", printable(joined(all)), removed_text);
}

}  // namespace corpuscle
