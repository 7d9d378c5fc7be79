#include "study/skin_bins_file.hpp"

#include <algorithm>
#include <map>

#include "io/spike_files.hpp"

namespace corpuscle {

SkinBinsFile::SkinBinsFile(OutputFile file, double bin) : file_(std::move(file)), bin_(bin) {
    (void)file_.write("afferent,channel,units,from_s,to_s,spikes,rate_Hz\n");
}

Result<void> SkinBinsFile::begin(const SkinInput& input) {
    if (auto ok = EvenBins::check(input.clock, bin_); !ok) return ok;
    const auto& [plan, units, first, fields] = input.skin;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> afferents_in;  // by class and region
    for (const auto& u : units) ++afferents_in[{u.class_index, u.region}];
    std::vector<EvenBins::Row> groups;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> group_of;
    for (const auto& [class_and_region, count] : afferents_in) {
        group_of[class_and_region] = static_cast<std::uint32_t>(groups.size());
        groups.push_back({fmt::format("{},{},{}", quote_csv_field(plan.classes[class_and_region.first].name),
                                      quote_csv_field(plan.sites.regions[class_and_region.second]), count),
                          1.0 * count});
    }
    row_of_.clear();
    for (const auto& u : units) row_of_.push_back(group_of[{u.class_index, u.region}]);
    bins_ = EvenBins(std::move(groups), input.clock, bin_);
    return {};
}

Result<void> SkinBinsFile::block(const SkinInput&, const SkinAnswered& block) {
    for (const auto& s : block.spikes) bins_.count(s, row_of_[s.afferent_index]);
    bins_.known_to(block.first + static_cast<std::int64_t>(block.steps) - 1);
    return file_.write(bins_.lines());
}

Result<void> SkinBinsFile::end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) {
    for (const auto& s : last) bins_.count(s, row_of_[s.afferent_index]);
    bins_.end(last.empty() ? samples : std::max(samples, last.back().step + 1));
    return file_.write(bins_.lines());
}

}  // namespace corpuscle
