#include "run/sinks/file_sinks.hpp"

#include <iterator>

#include "io/spikes/spike_files.hpp"

namespace corpuscle {

std::vector<std::string> afferent_csv_names(const Input& input) {
    std::vector<std::string> names;
    for (std::size_t u = 0; u < input.afferent_count(); ++u)
        names.push_back(quote_csv_field(input.plan_of(u).name) + "," + quote_csv_field(input.channel_name(input.channel_of(u))));
    return names;
}

std::string numbered_path(const std::string& directory, std::string_view name, std::string_view extension, std::size_t index) {
    return fmt::format("{}/{}{}{}", directory, name, index == 0 ? "" : fmt::format("-{}", index + 1), extension);
}

SpikesFile::SpikesFile(OutputFile file) : file_(std::move(file)) {
    (void)file_.write("afferent,channel,time_s\n");  // commit() reports an error
}

Result<void> SpikesFile::begin(const Input& input) {
    names_ = afferent_csv_names(input);
    return {};
}

Result<void> SpikesFile::block(const Input& input, const RunBlock& block) {
    text_.clear();
    for (const auto& s : block.spikes)
        fmt::format_to(std::back_inserter(text_), "{},{:.9f}\n", names_[s.afferent_index - input.first_afferent],
                       input.source.clock().time(s.step, s.offset));
    return file_.write({text_.data(), text_.size()});
}

Result<void> ProbesFile::begin(const Input& input) {
    auto file = OutputFile::create(numbered_path(directory_, "probes", ".csv", input.index));
    if (!file) return file.error();
    std::string header = "time_s";
    for (std::size_t c = 0; c < input.source.channels().size(); ++c) header += "," + quote_csv_field(input.channel_name(c) + "_N");
    for (std::size_t u = 0; u < input.afferent_count(); ++u)
        for (const auto& p : input.probes[u % input.plans.size()])
            header += "," + quote_csv_field(fmt::format("{}.{}.{} [{}]", input.plan_of(u).name, input.channel_name(input.channel_of(u)),
                                                        p.name, p.unit));
    if (auto ok = file->write(header + "\n"); !ok) return ok;
    files_.push_back(std::move(*file));
    return {};
}

Result<void> ProbesFile::block(const Input& input, const RunBlock& block) {
    text_.clear();
    const auto out = std::back_inserter(text_);
    for (std::size_t k = 0; k < block.force.count; ++k) {
        fmt::format_to(out, "{:.9f}", input.source.clock().time(block.first_sample + static_cast<std::int64_t>(k)));
        for (const auto& channel : block.force.force) fmt::format_to(out, ",{:.9g}", channel[k]);
        for (const auto& afferent_probes : block.probes)
            for (const auto& probe : afferent_probes) fmt::format_to(out, ",{:.9g}", probe[k]);
        text_.push_back('\n');
    }
    return files_.back().write({text_.data(), text_.size()});
}

std::vector<std::string> ProbesFile::paths() const {
    std::vector<std::string> all;
    for (const auto& f : files_) all.push_back(f.path());
    return all;
}

Result<void> ProbesFile::commit() {
    for (auto& f : files_)
        if (auto ok = f.commit(); !ok) return ok;
    return {};
}

}  // namespace corpuscle
