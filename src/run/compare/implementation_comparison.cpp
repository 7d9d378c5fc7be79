#include "run/compare/implementation_comparison.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/median.hpp"
#include "core/text/ascii_text.hpp"
#include "measure/train_distance.hpp"
#include "run/channels/channel_population.hpp"
#include "run/summary/json_number.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json count_document(const ImplementationComparison::PhaseCount& c) {
    return {{"spikes", c.spikes}, {"reference_spikes", c.reference_spikes}, {"excess", json_number(c.excess())}};
}

Json row_document(const ImplementationComparison& c) {
    Json out = {{"afferent_type", c.afferent_type}, {"afferent", c.afferent}, {"reference", c.reference}, {"channel", c.channel}};
    out.update(count_document(c.total));
    out["phases"] = Json::array();
    for (const auto& p : c.phases) {
        Json one = {{"phase", p.phase}};
        one.update(count_document(p));
        out["phases"].push_back(std::move(one));
    }
    out["matched"] = c.matched;
    out["mean_shift_s"] = json_number(c.mean_shift);
    out["median_shift_s"] = json_number(c.median_shift);
    out["victor_purpura"] = json_number(c.victor_purpura);
    out["van_rossum"] = c.van_rossum;
    return out;
}

/// Number of spikes of a train in [from, to).
std::size_t count_spikes(std::span<const double> train, double from, double to) {
    return static_cast<std::size_t>(std::lower_bound(train.begin(), train.end(), to) - std::lower_bound(train.begin(), train.end(), from));
}

/// Fills in the distances and shifts. If there are too many pairs of close spikes to align the trains, only the van Rossum distance.
void measure_distance(std::span<const double> reference, std::span<const double> train, ImplementationComparison& c) {
    c.van_rossum = std::sqrt(van_rossum_squared(reference, train, ImplementationComparisons::tau));
    const auto aligned = align_trains(reference, train, ImplementationComparisons::cost);
    if (!aligned) return;
    std::vector<double> shifts;
    double sum = 0;
    for (const auto& m : aligned->moved) shifts.push_back(train[m.b] - reference[m.a]), sum += shifts.back();
    c.matched = shifts.size();
    c.victor_purpura = aligned->distance;
    c.mean_shift = shifts.empty() ? NAN : sum / static_cast<double>(shifts.size());
    c.median_shift = median_of(shifts);
}

}  // namespace

double ImplementationComparison::PhaseCount::excess() const {
    return reference_spikes == 0 ? NAN : static_cast<double>(spikes) / static_cast<double>(reference_spikes) - 1;
}

Result<void> ImplementationComparisons::begin(const Input& input) {
    const auto plans = input.on_channels().plans();
    is_kept_.assign(plans.size(), false);
    groups_.clear();
    const bool has_copies = std::any_of(plans.begin(), plans.end(), [](const auto& a) { return a.copy_number > 0; });
    for (auto& group : has_copies ? std::vector<ImplementationGroup>{} : implementation_groups(plans)) {
        if (group.members.size() < 2) continue;
        for (const auto m : group.members) is_kept_[m] = true;
        groups_.push_back(std::move(group));
    }
    trains_.assign(groups_.empty() ? 0 : input.population.size(), {});
    return {};
}

Result<void> ImplementationComparisons::block(const Input& input, const RunBlock& block) {
    for (const auto& s : block.spikes)
        if (const auto afferent_index = input.afferent_of(s); is_kept_[afferent_index % is_kept_.size()])
            trains_[afferent_index].push_back(input.since_start(s));
    return {};
}

Result<void> ImplementationComparisons::end(const Input& input, std::int64_t, std::span<const Spike>) {
    for (std::size_t c = 0; c < input.on_channels().channels(); ++c)
        for (const auto& group : groups_)
            for (std::size_t m = 1; m < group.members.size(); ++m) rows.push_back(compare_implementation(input, c, group, m));
    trains_.clear();
    return {};
}

ImplementationComparison ImplementationComparisons::compare_implementation(const Input& input, std::size_t channel,
                                                                           const ImplementationGroup& group, std::size_t member) const {
    const auto& afferents = input.on_channels();
    const auto plans = afferents.plans();
    const std::size_t first = channel * plans.size();
    const auto &reference = trains_[first + group.members[0]], &train = trains_[first + group.members[member]];
    ImplementationComparison out{group.afferent_type,
                                 plans[group.members[member]].name,
                                 plans[group.members[0]].name,
                                 afferents.channel(channel),
                                 {"", train.size(), reference.size()}};
    for (const auto& p : input.phases)
        out.phases.push_back({p.name, count_spikes(train, p.from, p.to), count_spikes(reference, p.from, p.to)});
    measure_distance(reference, train, out);
    return out;
}

Json ImplementationComparisons::document() const {
    Json pairs = Json::array();
    for (const auto& r : rows) pairs.push_back(row_document(r));
    return {{"cost_Hz", cost}, {"tau_s", tau}, {"pairs", pairs}};
}

namespace {

/// The catalogue's afferent with this name or alias; null if there is none.
const NamedAfferent* find_afferent(const std::string& name) {
    for (const auto& a : named_afferents())
        if (a.name == name || std::find(a.aliases.begin(), a.aliases.end(), name) != a.aliases.end()) return &a;
    return nullptr;
}

/// The afferent with the lowest rank is the reference: 0 the afferent that has the name of the type, 1 another model, 2 an implementation.
int reference_rank(const AfferentPlan& plan, const std::string& afferent_type) {
    return plan.traits().is_implementation ? 2 : plan.name == afferent_type ? 0 : 1;
}

}  // namespace

std::string afferent_type_of(std::string_view plan_name) {
    const auto stem = std::filesystem::path(plan_name).stem().string();  // without folder and extension, if the name is a path
    const auto* by_alias = find_afferent(lower(stem));  // SA-I is sa1, RA is fa1-nerve
    const auto name = by_alias ? std::string(by_alias->name) : lower(stem);
    const auto* prefix_match = find_afferent(name.substr(0, name.find_first_of("-_")));
    return prefix_match ? std::string(prefix_match->name) : stem;
}

std::vector<ImplementationGroup> implementation_groups(std::span<const AfferentPlan> plans) {
    std::vector<ImplementationGroup> all;
    for (std::size_t k = 0; k < plans.size(); ++k) {
        const auto afferent_type = afferent_type_of(plans[k].name);
        auto at =
            std::find_if(all.begin(), all.end(), [&](const ImplementationGroup& group) { return group.afferent_type == afferent_type; });
        if (at == all.end()) at = all.insert(at, {afferent_type, {}});
        at->members.push_back(k);
    }
    for (auto& group : all)
        std::sort(group.members.begin(), group.members.end(), [&](std::size_t a, std::size_t b) {
            return std::pair(reference_rank(plans[a], group.afferent_type), a) <
                   std::pair(reference_rank(plans[b], group.afferent_type), b);
        });
    return all;
}

}  // namespace corpuscle
