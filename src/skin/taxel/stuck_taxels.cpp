#include "skin/taxel/stuck_taxels.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "core/text/ascii_text.hpp"

namespace corpuscle {

void StuckTaxels::add(std::size_t taxel, double force) {
    auto& r = readings_[taxel];
    if (r.count++ == 0) r.first = r.highest = force;
    r.varies = r.varies || force != r.first;
    r.run = force == r.highest ? r.run + 1 : force > r.highest ? 1 : 0;
    if (force > r.highest) r.highest = force, r.longest_run = 0;
    r.longest_run = std::max(r.longest_run, r.run);
}

std::vector<std::string> StuckTaxels::notes() const {
    constexpr std::int64_t min_samples = 20;  // fewer say nothing
    if (std::none_of(readings_.begin(), readings_.end(), [](const Readings& r) { return r.varies; })) return {};
    std::vector<std::string> constant, held;
    for (std::size_t k = 0; k < readings_.size(); ++k) {
        const auto& r = readings_[k];
        if (layout_.taxels[k].use != TaxelUse::measured || r.count < min_samples || r.highest == 0) continue;
        if (!r.varies)
            constant.push_back(fmt::format("{} ({:.3g} N throughout)", layout_.taxels[k].name, r.first));
        else if (2 * r.longest_run > r.count)
            held.push_back(fmt::format("{} (at its highest, {:.3g} N, for {:.0f} % of the time)", layout_.taxels[k].name, r.highest,
                                       100.0 * static_cast<double>(r.longest_run) / static_cast<double>(r.count)));
    }
    if (2 * held.size() > readings_.size()) held.clear();  // a press that is held
    constant.insert(constant.end(), held.begin(), held.end());
    if (constant.empty()) return {};
    return {fmt::format("{} of {} taxels are probably dead: {}; set dead = 1 in {} to exclude them", constant.size(), readings_.size(),
                        joined(constant), layout_.file)};
}

}  // namespace corpuscle
