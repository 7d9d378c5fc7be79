#include "run/sinks/skin_psth_file.hpp"

#include <algorithm>
#include <map>

#include "io/spikes/spike_files.hpp"

namespace corpuscle {

SkinPsthFile::SkinPsthFile(OutputFile file, double bin_width) : file_(std::move(file)), bin_width_(bin_width) {
    (void)file_.write("afferent,channel,afferents,from_s,to_s,spikes,rate_Hz\n");  // commit() reports an error
}

Result<void> SkinPsthFile::begin(const SkinInput& input) {
    if (auto ok = TimeBins::check(input.clock, bin_width_); !ok) return ok;
    const auto& plan = input.skin.plan;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> afferents_in;  // by class and region
    for (const auto& u : input.skin.afferents) ++afferents_in[{u.class_index, u.region}];
    std::vector<TimeBins::Group> groups;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> group_of;
    for (const auto& [class_and_region, count] : afferents_in) {
        group_of[class_and_region] = static_cast<std::uint32_t>(groups.size());
        groups.push_back({fmt::format("{},{},{}", quote_csv_field(plan.classes[class_and_region.first].name),
                                      quote_csv_field(plan.sites.regions[class_and_region.second]), count),
                          1.0 * count});
    }
    group_of_.clear();
    for (const auto& u : input.skin.afferents) group_of_.push_back(group_of[{u.class_index, u.region}]);
    bins_ = TimeBins(std::move(groups), input.clock, bin_width_);
    return {};
}

Result<void> SkinPsthFile::block(const SkinInput&, const SkinRunBlock& block) {
    for (const auto& s : block.spikes) bins_.count(s, group_of_[s.afferent_index]);
    bins_.advance_to(block.first_sample + static_cast<std::int64_t>(block.steps) - 1);
    return file_.write(bins_.take_lines());
}

Result<void> SkinPsthFile::end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) {
    for (const auto& s : last) bins_.count(s, group_of_[s.afferent_index]);
    // Conduction delays can make the last spikes arrive after the end of the force; the bins then end after the last spike.
    bins_.end(last.empty() ? samples : std::max(samples, last.back().step + 1));
    return file_.write(bins_.take_lines());
}

}  // namespace corpuscle
