#include "cli/output/skin_outputs.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "cli/arguments/recording_arguments.hpp"
#include "cli/output/output_files.hpp"
#include "core/text/ascii_text.hpp"
#include "run/earlier_outputs.hpp"
#include "run/sinks/skin_afferents_file.hpp"
#include "run/sinks/skin_events_file.hpp"
#include "run/sinks/skin_npz_file.hpp"
#include "run/sinks/skin_psth_file.hpp"
#include "run/sinks/skin_spikes_file.hpp"

namespace corpuscle {

SkinOutputs::~SkinOutputs() {
    report_file_.reset(), summary_file_.reset();
    while (!files_.empty()) files_.pop_back();  // in reverse order: the first file may have created the directory, and then removes it
}

template <class F, class... A>
Result<void> SkinOutputs::add(const std::string& name, const A&... arguments) {
    auto file = OutputFile::create(directory_ + "/" + name);
    if (!file) return file.error();
    files_.push_back(std::make_unique<F>(std::move(*file), arguments...));
    return {};
}

Result<void> SkinOutputs::open_directory(const RespondArguments& args, const SkinSummary& summary, const std::optional<std::string>& page,
                                         OutputCheck& outputs) {
    const auto bin = optional_quantity(args.bin, "s", "--bin");
    if (!bin) return bin.error();
    if (*bin && !(**bin > 0)) return bad_usage(fmt::format("--bin {}: must be greater than 0, such as 10ms", *args.bin));
    const auto formats = event_formats();
    const auto format = std::find_if(formats.begin(), formats.end(), [&](const auto& f) { return f.name == args.events; });
    if (!args.events.empty() && format == formats.end()) {
        std::vector<std::string_view> names;
        for (const auto& f : formats) names.push_back(f.name);
        return bad_usage(
            fmt::format("--events {}: expected one of {}{}", args.events, fmt::join(names, ", "), did_you_mean(args.events, names)));
    }
    const auto spikes = args.events.empty() ? std::string("spikes.csv") : fmt::format("spikes{}", format->extension);
    std::vector<std::string> names = {spikes, "afferents.csv", "summary.json"};
    if (args.npz) names.emplace_back("spikes.npz");
    if (*bin) names.emplace_back("psth.csv");
    if (auto ok = check_outputs(args.out, std::move(names), page, args.checkpoint, outputs); !ok) return ok;
    auto ok = args.events.empty() ? add<SkinSpikesFile>(spikes) : add<SkinEventsFile>(spikes, args.events);
    if (!ok) return ok;
    if (ok = add<SkinAfferentsFile>("afferents.csv", std::cref(summary)); !ok) return ok;
    if (args.npz)
        if (ok = add<SkinNpzFile>("spikes.npz"); !ok) return ok;
    if (*bin)
        if (ok = add<SkinPsthFile>("psth.csv", **bin); !ok) return ok;
    auto file = OutputFile::create(directory_ + "/summary.json");
    if (!file) return file.error();
    summary_file_ = std::move(*file);
    return {};
}

Result<void> SkinOutputs::open(const RespondArguments& args, const SkinSummary& summary, OutputCheck& outputs) {
    for (const auto& [option, given] :
         {std::pair{"--bin", args.bin.has_value()}, std::pair{"--events", !args.events.empty()}, std::pair{"--npz", args.npz}})
        if (given && args.out.empty()) return bad_usage(fmt::format("{} needs --out DIR", option));
    directory_ = args.out;
    const auto page_path = report_page_path(args);
    if (!args.out.empty())
        if (auto ok = open_directory(args, summary, page_path, outputs); !ok) return ok;
    if (args.out.empty())
        if (auto ok = check_outputs("", {}, page_path, args.checkpoint, outputs); !ok) return ok;
    if (!page_path) return {};
    auto page = OutputFile::create(*page_path);
    if (!page) return page.error();
    report_file_ = std::move(*page);
    report_.emplace();
    return {};
}

void SkinOutputs::add_sinks(std::vector<SkinSink*>& sinks) {
    for (auto& file : files_) sinks.push_back(&*file);
    if (report_) sinks.push_back(&*report_);
}

std::vector<std::string> SkinOutputs::paths() const {
    std::vector<std::string> all;
    for (const auto& file : files_)
        for (auto& path : file->paths()) all.push_back(std::move(path));
    if (summary_file_) all.push_back(summary_file_->path());
    if (report_file_) all.push_back(report_file_->path());
    return all;
}

std::vector<std::string> SkinOutputs::file_names() const { return file_names_in(directory_, paths()); }

Result<void> SkinOutputs::commit(const SkinSummary& summary, const SkinRunNotes& run_info, const std::string& document,
                                 const std::string& command) {
    if (report_)
        if (auto ok = write_and_commit(*report_file_, skin_page(summary, *report_, run_info, command)); !ok) return ok;
    for (auto& file : files_)
        if (auto ok = file->commit(); !ok) return ok;
    if (!summary_file_) return {};
    removed_ = remove_stale_outputs(directory_, file_names());
    return write_and_commit(*summary_file_, document);
}

std::string SkinOutputs::written_text() const { return written_files_text(paths(), removed_); }

}  // namespace corpuscle
