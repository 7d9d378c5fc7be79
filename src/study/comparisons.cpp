#include "study/comparisons.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "measure/train_distance.hpp"
#include "study/json_number.hpp"

namespace corpuscle {
namespace {

using Json = nlohmann::ordered_json;

Json count_document(const Comparison::Count& c) {
    return {{"spikes", c.spikes}, {"reference_spikes", c.in_reference}, {"excess", json_number(c.excess())}};
}

Json row_document(const Comparison& c) {
    Json out = {{"receptor", c.receptor}, {"afferent", c.afferent}, {"reference", c.reference}, {"channel", c.channel}};
    out.update(count_document(c.all));
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
std::size_t count(std::span<const double> train, double from, double to) {
    return static_cast<std::size_t>(std::lower_bound(train.begin(), train.end(), to) - std::lower_bound(train.begin(), train.end(), from));
}

double median_shift_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto n = values.size();
    return n == 0 ? NAN : n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

void measure_distance(std::span<const double> reference, std::span<const double> train, Comparison& c) {
    c.van_rossum = std::sqrt(van_rossum_squared(reference, train, Comparisons::tau));
    const auto aligned = align_trains(reference, train, Comparisons::cost);
    if (!aligned) return;
    std::vector<double> shifts;
    double sum = 0;
    for (const auto& m : aligned->moved) shifts.push_back(train[m.b] - reference[m.a]), sum += shifts.back();
    c.matched = shifts.size();
    c.victor_purpura = aligned->distance;
    c.mean_shift = shifts.empty() ? NAN : sum / static_cast<double>(shifts.size());
    c.median_shift = median_shift_of(std::move(shifts));
}

}  // namespace

double Comparison::Count::excess() const {
    return in_reference == 0 ? NAN : static_cast<double>(spikes) / static_cast<double>(in_reference) - 1;
}

Result<void> Comparisons::begin(const Input& input) {
    kept_.assign(input.afferents.size(), false);
    versions_.clear();
    const bool copies = std::any_of(input.afferents.begin(), input.afferents.end(), [](const auto& a) { return a.copy_number > 0; });
    for (auto& v : copies ? std::vector<Versions>{} : versions_of(input.afferents)) {
        if (v.members.size() < 2) continue;
        for (const auto m : v.members) kept_[m] = true;
        versions_.push_back(std::move(v));
    }
    trains_.assign(versions_.empty() ? 0 : input.units(), {});
    since_start_ = input.source.clock();
    since_start_.t0 = 0;
    return {};
}

Result<void> Comparisons::block(const Input& input, const Answered& block) {
    for (const auto& s : block.spikes)
        if (const auto afferent_index = s.afferent_index - input.first_unit; kept_[afferent_index % kept_.size()])
            trains_[afferent_index].push_back(since_start_.time(s.step, s.offset));
    return {};
}

Result<void> Comparisons::end(const Input& input, std::int64_t) {
    for (std::size_t c = 0; c < input.source.channels().size(); ++c)
        for (const auto& v : versions_)
            for (std::size_t m = 1; m < v.members.size(); ++m) rows_.push_back(compared(input, c, v, m));
    trains_.clear();
    return {};
}

Comparison Comparisons::compared(const Input& input, std::size_t channel, const Versions& v, std::size_t member) const {
    const std::size_t first = channel * input.afferents.size();
    const auto &reference = trains_[first + v.members[0]], &train = trains_[first + v.members[member]];
    Comparison out{v.receptor,
                   input.afferents[v.members[member]].name,
                   input.afferents[v.members[0]].name,
                   input.channel_name(channel),
                   {"", train.size(), reference.size()}};
    for (const auto& p : input.source.phases()) out.phases.push_back({p.name, count(train, p.from, p.to), count(reference, p.from, p.to)});
    measure_distance(reference, train, out);
    return out;
}

Json Comparisons::document() const {
    Json pairs = Json::array();
    for (const auto& r : rows_) pairs.push_back(row_document(r));
    return {{"cost_Hz", cost}, {"tau_s", tau}, {"pairs", pairs}};
}

}  // namespace corpuscle
