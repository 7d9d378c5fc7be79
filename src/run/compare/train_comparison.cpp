#include "run/compare/train_comparison.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "core/text/ascii_text.hpp"
#include "measure/train_distance.hpp"

namespace corpuscle {
namespace {

using Trains = std::vector<NamedTrain>;

/// The names of the first eight trains, for a message.
std::string list_names(const Trains& trains) {
    std::vector<std::string> names;
    for (const auto& t : trains)
        if (names.size() < 8) names.push_back(t.name().empty() ? "(unnamed)" : t.name());
    return fmt::format("{}{}", joined(names, "; "), names.size() < trains.size() ? " ..." : "");
}

/// Looks up the trains of a file by name.
class TrainIndex {
    std::map<std::pair<std::string_view, std::string_view>, const NamedTrain*> by_name_;  // afferent and channel
    std::map<std::string_view, std::vector<const NamedTrain*>> by_afferent_;

    /// The train of this afferent if there is exactly one, otherwise null.
    const NamedTrain* only_of(const std::string& afferent) const {
        const auto found = by_afferent_.find(afferent);
        return found != by_afferent_.end() && found->second.size() == 1 ? found->second.front() : nullptr;
    }

public:
    explicit TrainIndex(const Trains& trains) {
        for (const auto& t : trains) by_name_.try_emplace({t.afferent, t.channel}, &t), by_afferent_[t.afferent].push_back(&t);
    }

    const NamedTrain* of_name(std::string_view afferent, std::string_view channel) const {
        const auto found = by_name_.find({afferent, channel});
        return found == by_name_.end() ? nullptr : found->second;
    }
    /// The train with the same afferent and channel as a train of another file. If one of the two files has no channels (address events):
    /// the only train of the same afferent; "sa1#1" without a channel also matches the only train of "sa1". Null if there is none.
    const NamedTrain* partner_of(const NamedTrain& train) const {
        if (const auto* found = of_name(train.afferent, train.channel)) return found;
        if (train.afferent.empty()) return nullptr;
        if (train.channel.empty()) {
            const auto* found = only_of(train.afferent);
            return found || !train.afferent.ends_with("#1") ? found : only_of(train.afferent.substr(0, train.afferent.size() - 2));
        }
        const auto* found = of_name(train.afferent, "");
        return found ? found : of_name(train.afferent + "#1", "");
    }
};

/// The trains whose complete name, afferent or channel is `name`.
std::vector<const NamedTrain*> trains_named(const Trains& trains, const std::string& name) {
    std::vector<const NamedTrain*> all;
    for (const auto& t : trains)
        if (t.name() == name || t.afferent == name || t.channel == name) all.push_back(&t);
    return all;
}

/// The train of file B whose name is that of a train of file A with `from` (the complete name, the afferent or the channel) replaced by
/// `to`; null if there is none. `candidates`: the trains of file B that `to` names.
const NamedTrain* renamed_partner(const TrainIndex& b, std::span<const NamedTrain* const> candidates, const NamedTrain& train,
                                  const std::string& from, const std::string& to) {
    if (train.name() == from)
        for (const auto* candidate : candidates)
            if (candidate->name() == to) return candidate;
    const auto* found = train.afferent == from ? b.of_name(to, train.channel) : nullptr;
    return found || train.channel != from ? found : b.of_name(train.afferent, to);
}

/// Adds the pairs of the option --pair FROM=TO. If FROM names one train of A and TO names one train of B, these are the pair. Otherwise
/// adds all pairs of trains whose names become equal when FROM is replaced by TO.
Result<void> add_pairs(const Trains& a, const Trains& b, const std::string& text, std::vector<TrainPair>& out) {
    const auto equals = text.find('=');
    if (equals == text.npos) return bad_usage(fmt::format("--pair {}: write A-NAME=B-NAME, such as sa1=sa1-kim", text));
    const auto from = text.substr(0, equals), to = text.substr(equals + 1);
    const auto in_a = trains_named(a, from), in_b = trains_named(b, to);
    for (const auto& [name, found, all, file] : {std::tuple{&from, &in_a, &a, "first"}, std::tuple{&to, &in_b, &b, "second"}})
        if (found->empty())
            return bad_usage(fmt::format("--pair {}: the {} file has no train '{}'; it has {}", text, file, *name, list_names(*all)));
    if (in_a.size() == 1 && in_b.size() == 1) return out.push_back({in_a[0], in_b[0]}), Result<void>();
    const std::size_t before = out.size();
    const TrainIndex index(b);
    for (const auto* train : in_a)
        if (const auto* other = renamed_partner(index, in_b, *train, from, to)) out.push_back({train, other});
    if (out.size() > before) return {};
    return bad_usage(
        fmt::format("--pair {}: matches {} trains of the first file and {} of the second, and no two of their names differ only "
                    "in this part; name one train of each file, such as --pair '{}={}'",
                    text, in_a.size(), in_b.size(), in_a[0]->name(), in_b[0]->name()));
}

/// Pairs trains of equal name; other trains have no partner. A pair must match both ways: "sa1" of a file without channels does not match
/// several channels of another file.
std::vector<TrainPair> by_name(const Trains& a, const Trains& b) {
    const TrainIndex in_a(a), in_b(b);
    const auto partner = [](const NamedTrain& t, const TrainIndex& same_file, const TrainIndex& other_file) {
        const auto* found = other_file.partner_of(t);
        return found && same_file.partner_of(*found) == &t ? found : nullptr;
    };
    std::vector<TrainPair> out;
    for (const auto& t : a) out.push_back({&t, partner(t, in_a, in_b)});
    for (const auto& t : b)
        if (!partner(t, in_b, in_a)) out.push_back({nullptr, &t});
    return out;
}

/// A --pair option for a message: for two trains whose names differ only in the afferent or only in the channel; if there are none, for the
/// first train of each file.
std::string suggest_pair(const Trains& a, const Trains& b) {
    for (const auto& x : a)
        for (const auto& y : b) {
            if (x.channel == y.channel && !x.afferent.empty() && !y.afferent.empty())
                return fmt::format("--pair {}={}", x.afferent, y.afferent);
            if (x.afferent == y.afferent && !x.channel.empty() && !y.channel.empty())
                return fmt::format("--pair {}={}", x.channel, y.channel);
        }
    return fmt::format("--pair '{}={}'", a[0].name(), b[0].name());
}

}  // namespace

double TrainDifference::rms() const { return std::sqrt(sum_of_squares / static_cast<double>(matched)); }

double TrainDifference::van_rossum() const { return std::sqrt(van_rossum_squared); }

double TrainDifference::victor_purpura_per_spike() const {
    return spikes_a + spikes_b == 0 ? 0 : victor_purpura / static_cast<double>(spikes_a + spikes_b);
}

void TrainDifference::add(const TrainDifference& o) {
    spikes_a += o.spikes_a, spikes_b += o.spikes_b, matched += o.matched;
    max_shift = std::max(max_shift, o.max_shift);
    sum_of_squares += o.sum_of_squares, victor_purpura += o.victor_purpura, van_rossum_squared += o.van_rossum_squared;
}

Result<std::vector<TrainPair>> pair_trains(const Trains& a, const Trains& b, const CompareOptions& options) {
    std::vector<TrainPair> out;
    if (options.by_order) {
        if (!options.pairs.empty()) return bad_usage("--by-order and --pair are alternatives: give one");
        if (a.size() != b.size())
            return bad_usage(
                fmt::format("--by-order: the first file has {} trains, the second {}; --pair A-NAME=B-NAME selects trains to compare",
                            a.size(), b.size()));
        for (std::size_t k = 0; k < a.size(); ++k) out.push_back({&a[k], &b[k]});
        return out;
    }
    for (const auto& text : options.pairs) TRY(add_pairs(a, b, text, out));
    if (!options.pairs.empty()) return out;
    out = by_name(a, b);
    if (a.empty() || b.empty() || std::any_of(out.begin(), out.end(), [](const auto& p) { return p.a && p.b; })) return out;
    if (a.size() == 1 && b.size() == 1) return std::vector<TrainPair>{{&a[0], &b[0]}};
    return bad_usage(fmt::format("no train has the same name in both files: {} | {}; {} would compare these{}", list_names(a),
                                 list_names(b), suggest_pair(a, b),
                                 a.size() == b.size() ? ", --by-order compares all of them in this order" : ""));
}

Result<TrainDifference> compare_trains(const TrainPair& pair, const CompareOptions& options) {
    static const NamedTrain missing;
    const auto &train_a = pair.a ? *pair.a : missing, &train_b = pair.b ? *pair.b : missing;
    const auto &a = train_a.times, &b = train_b.times;
    const auto matched = TRY(align_trains(a, b, 2 / options.window));  // a cost at which only spikes closer than the window can match
    TrainDifference d{train_a.name(), train_b.name(), a.size(), b.size(), matched.moved.size()};
    for (const auto& m : matched.moved) {
        const double shift = std::abs(b[m.b] - a[m.a]);
        d.max_shift = std::max(d.max_shift, shift);
        d.sum_of_squares += shift * shift;
    }
    d.victor_purpura = TRY(victor_purpura(a, b, options.cost));
    d.van_rossum_squared = van_rossum_squared(a, b, options.tau);
    return d;
}

}  // namespace corpuscle
