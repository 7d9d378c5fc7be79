#include "study/bins_file.hpp"

namespace corpuscle {

BinsFile::BinsFile(OutputFile file, double bin) : file_(std::move(file)), bin_(bin) {
    (void)file_.write("afferent,channel,from_s,to_s,spikes,rate_Hz\n");
}

Result<void> BinsFile::begin(const Input& input) {
    if (auto ok = EvenBins::check(input.source.clock(), bin_); !ok) return ok;
    std::vector<EvenBins::Row> rows;
    for (auto& name : unit_names(input)) rows.push_back({std::move(name)});
    bins_ = EvenBins(std::move(rows), input.source.clock(), bin_);
    return {};
}

Result<void> BinsFile::block(const Input& input, const Answered& block) {
    for (const auto& s : block.spikes) bins_.count(s, s.afferent_index - input.first_unit);
    bins_.known_to(block.first + static_cast<std::int64_t>(block.force.count) - 1);
    return file_.write(bins_.lines());
}

Result<void> BinsFile::end(const Input&, std::int64_t samples) {
    bins_.end(samples);
    return file_.write(bins_.lines());
}

}  // namespace corpuscle
