#include "run/sinks/psth_file.hpp"

namespace corpuscle {

PsthFile::PsthFile(OutputFile file, double bin_width) : file_(std::move(file)), bin_width_(bin_width) {
    (void)file_.write("afferent,channel,from_s,to_s,spikes,rate_Hz\n");  // commit() reports an error
}

Result<void> PsthFile::begin(const Input& input) {
    if (auto ok = TimeBins::check(input.source.clock(), bin_width_); !ok) return ok;
    std::vector<TimeBins::Group> groups;
    for (auto& name : afferent_csv_names(input)) groups.push_back({std::move(name)});
    bins_ = TimeBins(std::move(groups), input.source.clock(), bin_width_);
    return {};
}

Result<void> PsthFile::block(const Input& input, const RunBlock& block) {
    for (const auto& s : block.spikes) bins_.count(s, s.afferent_index - input.first_afferent);
    bins_.advance_to(block.first_sample + static_cast<std::int64_t>(block.force.count) - 1);
    return file_.write(bins_.take_lines());
}

Result<void> PsthFile::end(const Input&, std::int64_t samples) {
    bins_.end(samples);
    return file_.write(bins_.take_lines());
}

}  // namespace corpuscle
