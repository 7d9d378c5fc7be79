#include "cli/output/respond_outputs.hpp"

#include <fmt/format.h>

#include "cli/arguments/recording_arguments.hpp"
#include "cli/output/output_files.hpp"
#include "run/earlier_outputs.hpp"
#include "run/sinks/copies_file.hpp"
#include "run/sinks/npz_file.hpp"
#include "run/sinks/psth_file.hpp"
#include "run/sinks/spike_sound_file.hpp"
#include "run/sinks/test_vectors_file.hpp"

namespace corpuscle {

/// Removes the files that were not committed. The last one is removed first: the first one may have created the directory, and removes it
/// if it is empty by then.
RespondOutputs::~RespondOutputs() {
    report_file_.reset(), summary_file_.reset();
    while (!files_.empty()) files_.pop_back();
}

template <class F, class... A>
Result<void> RespondOutputs::add(const char* name, A... arguments) {
    auto file = OutputFile::create(directory_ + "/" + name);
    if (!file) return file.error();
    files_.push_back(std::make_unique<F>(std::move(*file), arguments...));
    return {};
}

Result<void> RespondOutputs::open_directory(const RespondArguments& args, const CopySpec& copy_spec, std::optional<double> bin) {
    if (auto ok = add<SpikesFile>("spikes.csv"); !ok) return ok;
    if (copy_spec.count > 0)
        if (auto ok = add<CopiesFile>("copies.csv", copy_spec); !ok) return ok;
    if (args.npz)
        if (auto ok = add<NpzFile>("spikes.npz"); !ok) return ok;
    if (bin)
        if (auto ok = add<PsthFile>("psth.csv", *bin); !ok) return ok;
    if (args.wav) files_.push_back(std::make_unique<SpikeSoundFile>(directory_));
    if (args.probe_files) files_.push_back(std::make_unique<ProbesFile>(directory_));
    if (args.vectors) files_.push_back(std::make_unique<TestVectorsFile>(directory_));
    auto summary = OutputFile::create(directory_ + "/summary.json");
    if (!summary) return summary.error();
    summary_file_ = std::move(*summary);
    return {};
}

std::vector<std::string> RespondOutputs::paths() const {
    std::vector<std::string> all;
    for (const auto& file : files_)
        for (auto& path : file->paths()) all.push_back(std::move(path));
    if (summary_file_) all.push_back(summary_file_->path());
    if (report_file_) all.push_back(report_file_->path());
    return all;
}

/// Checks all output files, also those that are created later, before the first is created.
Result<void> RespondOutputs::check(const RespondArguments& args, const CopySpec& copy_spec, const std::optional<std::string>& page,
                                   std::vector<std::string> later_names, OutputCheck& outputs) {
    const std::pair<const char*, bool> names[] = {{"spikes.csv", true},
                                                  {"copies.csv", copy_spec.count > 0},
                                                  {"spikes.npz", args.npz},
                                                  {"psth.csv", args.bin.has_value()},
                                                  {"summary.json", true}};
    for (const auto& [name, is_written] : names)
        if (is_written) later_names.emplace_back(name);
    return check_outputs(args.out, std::move(later_names), page, args.checkpoint, outputs);
}

Result<void> RespondOutputs::open(const RespondArguments& args, const CopySpec& copy_spec, std::vector<std::string> later_names,
                                  OutputCheck& outputs) {
    const std::pair<const char*, bool> options[] = {{"--probe-files", args.probe_files},
                                                    {"--vectors", args.vectors},
                                                    {"--bin", args.bin.has_value()},
                                                    {"--npz", args.npz},
                                                    {"--wav", args.wav}};
    for (const auto& [option, given] : options)
        if (given && args.out.empty()) return bad_usage(fmt::format("{} needs --out DIR", option));
    for (const auto& [option, given] : {std::pair{"--probe-files", args.probe_files}, std::pair{"--vectors", args.vectors}})
        if (given && args.copies > RespondReport::max_copies)
            return bad_usage(
                fmt::format("{} works with at most {} copies, not {}; use fewer, or simulate one copy: --set its values from copies.csv",
                            option, RespondReport::max_copies, args.copies));
    const auto bin = optional_quantity(args.bin, "s", "--bin");
    if (!bin) return bin.error();
    if (*bin && !(**bin > 0)) return bad_usage(fmt::format("--bin {}: must be greater than 0, such as 10ms", *args.bin));
    directory_ = args.out;
    const auto page_path = report_page_path(args);
    if (auto ok = check(args, copy_spec, page_path, std::move(later_names), outputs); !ok) return ok;
    if (!args.out.empty())
        if (auto ok = open_directory(args, copy_spec, *bin); !ok) return ok;
    if (!page_path) return {};
    auto page = OutputFile::create(*page_path);
    if (!page) return page.error();
    report_file_ = std::move(*page);
    report_.emplace(RespondReport::max_total_points, copy_spec, !args.use_float);  // --float records no probes
    return {};
}

void RespondOutputs::add_sinks(std::vector<ResponseSink*>& sinks) {
    for (auto& file : files_) sinks.push_back(&*file);
    if (report_) sinks.push_back(&*report_);
}

std::vector<std::string> RespondOutputs::file_names() const { return file_names_in(directory_, paths()); }

Result<void> RespondOutputs::commit(const RunSummary& summary, std::span<const AfferentPlan> afferents,
                                    const std::vector<std::string>& warnings, const std::string& document, const std::string& command,
                                    const nlohmann::ordered_json& costs) {
    if (report_)
        if (auto ok = write_and_commit(*report_file_, report_->page(summary, afferents, command, warnings, costs)); !ok) return ok;
    for (auto& file : files_)
        if (auto ok = file->commit(); !ok) return ok;
    if (!summary_file_) return {};
    removed_ = remove_stale_outputs(directory_, file_names());
    return write_and_commit(*summary_file_, document);
}

std::string RespondOutputs::written_text() const { return written_files_text(paths(), removed_); }

}  // namespace corpuscle
