#include "study/skin_bins_file.hpp"

#include <algorithm>
#include <map>

#include "io/spikes.hpp"

namespace corpuscle {

SkinBinsFile::SkinBinsFile(OutputFile file, double bin) : file_(std::move(file)), bin_(bin) {
    (void)file_.write("afferent,channel,units,from_s,to_s,spikes,rate_Hz\n");
}

Result<void> SkinBinsFile::begin(const SkinInput& input) {
    if (auto ok = EvenBins::check(input.clock, bin_); !ok) return ok;
    const auto& [plan, units, first, fields] = input.skin;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> units_of;  // by class and region
    for (const auto& u : units) ++units_of[{u.of, u.region}];
    std::vector<EvenBins::Row> rows;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> row_of;
    for (const auto& [of, count] : units_of) {
        row_of[of] = static_cast<std::uint32_t>(rows.size());
        rows.push_back({fmt::format("{},{},{}", csv_field(plan.classes[of.first].name), csv_field(plan.sites.regions[of.second]), count),
                        1.0 * count});
    }
    row_of_.clear();
    for (const auto& u : units) row_of_.push_back(row_of[{u.of, u.region}]);
    bins_ = EvenBins(std::move(rows), input.clock, bin_);
    return {};
}

Result<void> SkinBinsFile::block(const SkinInput&, const SkinAnswered& answered) {
    for (const auto& s : answered.spikes) bins_.count(s, row_of_[s.unit]);
    bins_.known_to(answered.first + static_cast<std::int64_t>(answered.steps) - 1);
    return file_.write(bins_.lines());
}

Result<void> SkinBinsFile::end(const SkinInput&, std::int64_t samples, std::span<const Spike> last) {
    for (const auto& s : last) bins_.count(s, row_of_[s.unit]);
    bins_.end(last.empty() ? samples : std::max(samples, last.back().step + 1));
    return file_.write(bins_.lines());
}

}  // namespace corpuscle
