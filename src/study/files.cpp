#include "study/files.hpp"

#include <iterator>

namespace corpuscle {
namespace {

/// A name as a field of a CSV file.
std::string field(const std::string& name) {
    if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
    std::string quoted = "\"";
    for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

SpikesFile::SpikesFile(OutputFile file) : file_(std::move(file)) { (void)file_.write("afferent,channel,time_s\n"); }

Result<void> SpikesFile::begin(const Input& input) {
    names_.clear();
    for (std::size_t u = 0; u < input.units(); ++u)
        names_.push_back(field(input.afferent_of(u).name) + "," + field(input.channel_name(input.channel_of(u))));
    return {};
}

Result<void> SpikesFile::block(const Input& input, const Answered& answered) {
    text_.clear();
    for (const auto& s : answered.spikes)
        fmt::format_to(std::back_inserter(text_), "{},{:.9f}\n", names_[s.unit - input.first_unit],
                       input.source.clock().time(s.step, s.offset));
    return file_.write({text_.data(), text_.size()});
}

Result<void> TracesFile::begin(const Input& input) {
    auto file = OutputFile::create(directory_ + (input.index == 0 ? "/traces.csv" : fmt::format("/traces-{}.csv", input.index + 1)));
    if (!file) return file.error();
    std::string header = "time_s";
    for (std::size_t c = 0; c < input.source.channels().size(); ++c) header += "," + field(input.channel_name(c) + "_N");
    for (std::size_t u = 0; u < input.units(); ++u)
        for (const auto& p : input.probes[u % input.afferents.size()])
            header += "," + field(fmt::format("{}.{}.{} [{}]", input.afferent_of(u).name, input.channel_name(input.channel_of(u)), p.name,
                                              p.unit));
    if (auto ok = file->write(header + "\n"); !ok) return ok;
    files_.push_back(std::move(*file));
    return {};
}

Result<void> TracesFile::block(const Input& input, const Answered& answered) {
    text_.clear();
    const auto out = std::back_inserter(text_);
    for (std::size_t k = 0; k < answered.force.count; ++k) {
        fmt::format_to(out, "{:.9f}", input.source.clock().time(answered.first + static_cast<std::int64_t>(k)));
        for (const auto& channel : answered.force.force) fmt::format_to(out, ",{:.9g}", channel[k]);
        for (const auto& unit : answered.probes)
            for (const auto& probe : unit) fmt::format_to(out, ",{:.9g}", probe[k]);
        text_.push_back('\n');
    }
    return files_.back().write({text_.data(), text_.size()});
}

std::vector<std::string> TracesFile::paths() const {
    std::vector<std::string> all;
    for (const auto& f : files_) all.push_back(f.path());
    return all;
}

Result<void> TracesFile::commit() {
    for (auto& f : files_)
        if (auto ok = f.commit(); !ok) return ok;
    return {};
}

}  // namespace corpuscle
