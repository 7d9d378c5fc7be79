#include "study/sweep/calibrate.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <optional>

#include "circuit/path_names.hpp"
#include "signal/field.hpp"
#include "signal/pool.hpp"
#include "signal/text.hpp"

namespace corpuscle {
namespace {

using circuit::Chip;
using circuit::ChipAnswer;
using circuit::CircuitDesign;
using circuit::Draw;
using Codes = std::vector<int>;

/// A chip that is to be pressed with these codes, and what it then did.
struct Pressing {
    std::size_t chip;
    Codes codes;
    std::vector<double> spikes = {};
    double distance = 0;
    bool kept = false, lost = false;
};

/// Presses chips, many at once; designs are made once for each set of values.
class TrimmingBench {
    const ChipCalibration& asked_;
    const std::vector<Draw>& chips_;
    std::map<std::vector<double>, std::shared_ptr<const CircuitDesign>> designs_;
    Pool pool_;

    std::vector<double> values(const Codes& codes) const {
        std::vector<double> out;
        for (std::size_t k = 0; k < codes.size(); ++k) out.push_back(asked_.trims[k].value(codes[k], asked_.bits));
        return out;
    }
    Result<std::shared_ptr<const CircuitDesign>> design(const Codes& codes) {
        const auto at = values(codes);
        if (const auto known = designs_.find(at); known != designs_.end()) return known->second;
        auto knobs = asked_.knobs;
        for (std::size_t k = 0; k < at.size(); ++k)
            for (const auto& name : asked_.trims[k].names) knobs.push_back({name, fmt::format("{:.17g}", at[k]), name});
        const auto netlist = circuit::tuned(asked_.netlist, knobs);
        if (!netlist) return netlist.error();
        auto made = CircuitDesign::of(*netlist);
        if (!made) return made.error();
        return designs_.emplace(at, *made).first->second;
    }
    void judge(Pressing& p, ChipAnswer&& answer) const {
        p.spikes = std::move(answer.spikes), p.lost = answer.error.has_value();
        p.kept = !p.lost && !answer.capped && asked_.limits.kept(p.spikes);
        p.distance = p.lost ? std::numeric_limits<double>::infinity() : asked_.limits.distance(p.spikes);
        // Broken off, as it fires too often: how early tells how far off it is, and it is worse than any that ended.
        if (answer.capped)
            p.distance = 1e6 * (2 - (p.spikes.empty() ? 0 : p.spikes.back() / (asked_.T * static_cast<double>(asked_.force.size()))));
    }

public:
    TrimmingBench(const ChipCalibration& asked, const std::vector<Draw>& chips) : asked_(asked), chips_(chips), pool_(asked.threads) {}

    /// Whether two codes mean the same chip: whole columns are fewer than codes.
    bool same(const Codes& a, const Codes& b) const { return values(a) == values(b); }

    Result<void> press(std::vector<Pressing>& all) {
        if (all.empty()) return {};
        std::vector<std::shared_ptr<const CircuitDesign>> designs;
        for (const auto& p : all) {
            auto made = design(p.codes);
            if (!made) return made.error();
            designs.push_back(std::move(*made));
        }
        std::mutex guard;
        std::size_t next = 0;
        std::optional<Error> failed;
        const auto more = [&]() -> std::optional<Chip> {
            const std::lock_guard lock(guard);
            if (next == all.size()) return {};
            const auto k = next++;
            return Chip{static_cast<std::int64_t>(k), designs[k], chips_[all[k].chip], asked_.force, asked_.T};
        };
        const auto told = [&](const Chip& chip, ChipAnswer&& answer) {
            judge(all[static_cast<std::size_t>(chip.number)], std::move(answer));
        };
        pool_.each(pool_.threads(), [&](std::size_t, unsigned) {
            if (auto done = circuit::run_chips(designs[0], more, told, asked_.batch); !done) {
                const std::lock_guard lock(guard);
                failed = done.error();
            }
        });
        return failed ? Result<void>(*failed) : Result<void>();
    }
};

/// One chip's search.
class TrimSearch {
    const ChipCalibration& asked_;
    const TrimmingBench& bench_;
    std::size_t chip_;
    CalibratedChip out_;
    Codes best_, together_;
    double distance_ = 0;
    int bits_ = 0, rounds_ = 0;
    std::vector<Codes> tried_;

    static constexpr int most_rounds = 6;  // of one number of bits

    int step() const { return 1 << (asked_.bits - bits_); }
    bool allowed(const Codes& codes) const {
        const int most = 1 << (asked_.bits - 1), least = step() - most;
        for (const int c : codes)
            if (c < least || c > most) return false;
        return std::none_of(tried_.begin(), tried_.end(), [&](const Codes& t) { return bench_.same(t, codes); });
    }
    void finish_bits() {
        out_.codes.push_back(best_), out_.distance.push_back(distance_);
        ++bits_, rounds_ = 0;
    }
    bool better(const Pressing& p) {
        if (!(p.distance < distance_)) return false;
        distance_ = p.distance, best_ = p.codes, out_.spikes = p.spikes;
        return true;
    }

public:
    TrimSearch(const ChipCalibration& asked, const TrimmingBench& bench, std::size_t chip)
        : asked_(asked), bench_(bench), chip_(chip), best_(asked.trims.size()) {}

    bool over() const { return out_.bits >= 0 || bits_ > asked_.bits; }
    CalibratedChip take() { return std::move(out_); }

    /// What it wants to have pressed next.
    std::vector<Pressing> wanted() {
        if (bits_ == 0) return {{chip_, best_}};
        if (!together_.empty()) return {{chip_, together_}};
        while (!over()) {
            std::vector<Pressing> out;
            for (std::size_t k = 0; k < best_.size() && rounds_ < most_rounds; ++k)
                for (const int d : {-step(), step()}) {
                    auto codes = best_;
                    codes[k] += d;
                    if (allowed(codes)) out.push_back({chip_, std::move(codes)});
                }
            if (!out.empty()) return out;
            finish_bits();
        }
        return {};
    }

    /// What came of it.
    void hear(std::vector<Pressing>&& all) {
        out_.presses += static_cast<int>(all.size());
        for (const auto& p : all) tried_.push_back(p.codes);
        const auto kept = std::find_if(all.begin(), all.end(), [](const Pressing& p) { return p.kept; });
        if (kept != all.end()) out_.bits = bits_, best_ = kept->codes, distance_ = kept->distance, out_.spikes = kept->spikes;
        if (bits_ == 0) {
            out_.spikes_before = all[0].spikes, out_.lost = all[0].lost;
            if (kept == all.end()) distance_ = all[0].distance, out_.spikes = all[0].spikes;
            return finish_bits();
        }
        if (kept != all.end()) return finish_bits();
        const bool was_together = !together_.empty();
        together_.clear();
        ++rounds_;
        const auto before = best_;
        auto joined = best_;
        const double start = distance_;
        std::size_t helped = 0;
        std::vector<double> least(best_.size(), start);
        for (auto& p : all) {
            for (std::size_t k = 0; k < best_.size() && !was_together; ++k)
                if (p.codes[k] != before[k] && p.distance < least[k])
                    helped += least[k] == start, least[k] = p.distance, joined[k] = p.codes[k];
            better(p);
        }
        if (best_ == before && !was_together) return finish_bits();
        if (helped > 1 && allowed(joined)) together_ = joined;
    }
};

}  // namespace

double Trim::value(int code, int bits) const {
    const double share = range * static_cast<double>(code) / static_cast<double>(1 << (bits - 1)), value = designed * (1 + share);
    return whole ? std::max(1.0, std::round(value)) : value;
}

Result<Trim> trim_of(const std::string& netlist, const std::vector<circuit::Knob>& knobs, std::vector<std::string> names, double range,
                     bool whole) {
    const auto read = circuit::tuned(netlist, knobs);
    if (!read) return read.error();
    const auto circuit = read->elaborate();
    if (!circuit) return circuit.error();
    const auto wanted = lower(names.at(0));
    if (const auto p = circuit->parameters.find(wanted); p != circuit->parameters.end())
        return Trim{std::move(names), p->second, range, whole};
    const auto dot = wanted.rfind('.');
    std::vector<std::string_view> known;
    for (const auto& e : circuit->elements) known.push_back(e.name);
    const auto found = circuit::meant(known, wanted.substr(0, dot), circuit::Last::element);
    if (dot != std::string::npos && found.size() == 1) {
        const auto& values = circuit->elements[found[0]].values;
        if (const auto v = values.find(wanted.substr(dot + 1)); v != values.end()) return Trim{std::move(names), v->second, range, whole};
    }
    std::vector<std::string_view> parameters;
    for (const auto& [parameter, value] : circuit->parameters) parameters.push_back(parameter);
    return bad_input(
        fmt::format("trim '{}': {} says no such number, a .param of the top level or one of a device, such as 'summer.n3b.m'{}", names[0],
                    netlist, did_you_mean(wanted, parameters)));
}

Result<std::vector<CalibratedChip>> calibrate(const ChipCalibration& asked, const std::vector<Draw>& chips) {
    if (asked.bits < 1 || asked.bits > 12) return bad_input(fmt::format("calibration: {} bits; 1 to 12", asked.bits));
    TrimmingBench bench(asked, chips);
    std::vector<TrimSearch> searches;
    for (std::size_t k = 0; k < chips.size(); ++k) searches.emplace_back(asked, bench, k);
    std::size_t presses = 0;
    for (;;) {
        std::vector<Pressing> all;
        for (auto& s : searches)
            if (!s.over())
                for (auto& p : s.wanted()) all.push_back(std::move(p));
        if (all.empty()) break;
        if (auto done = bench.press(all); !done) return done.error();
        presses += all.size();
        for (std::size_t from = 0, to = 0; from < all.size(); from = to) {
            while (to < all.size() && all[to].chip == all[from].chip) ++to;
            searches[all[from].chip].hear({std::make_move_iterator(all.begin() + static_cast<std::ptrdiff_t>(from)),
                                           std::make_move_iterator(all.begin() + static_cast<std::ptrdiff_t>(to))});
        }
        if (asked.told)
            asked.told(static_cast<std::size_t>(std::count_if(searches.begin(), searches.end(), [](const auto& s) { return !s.over(); })),
                       presses);
    }
    std::vector<CalibratedChip> out;
    for (auto& s : searches) out.push_back(s.take());
    return out;
}

}  // namespace corpuscle
