#include "sweep/calibrate/calibrate.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <optional>

#include "circuit/variant/hierarchical_names.hpp"
#include "core/parameter.hpp"
#include "core/text/ascii_text.hpp"
#include "core/thread_pool.hpp"

namespace corpuscle {
namespace {

using circuit::Chip;
using circuit::ChipResponse;
using circuit::ChipSample;
using circuit::CircuitAfferentFactory;
using Codes = std::vector<int>;

/// The simulation of one chip under the press with these codes, and its result.
struct ChipPress {
    std::size_t chip;  // index
    Codes codes;       // one for each trim
    std::vector<double> spikes = {};
    double distance = 0;
    bool meets_limits = false, diverged = false;
};

/// Simulates many presses in parallel. Makes each design (the netlist with one set of trim values) only once.
class ChipPresser {
    const ChipCalibration& options_;
    const std::vector<ChipSample>& chips_;
    std::map<std::vector<double>, std::shared_ptr<const CircuitAfferentFactory>> designs_;  // by trim values
    ThreadPool pool_;

    /// The value of each trim.
    std::vector<double> values(const Codes& codes) const {
        std::vector<double> out;
        for (std::size_t k = 0; k < codes.size(); ++k) out.push_back(options_.trims[k].value(codes[k], options_.bits));
        return out;
    }
    Result<std::shared_ptr<const CircuitAfferentFactory>> design(const Codes& codes) {
        const auto trim_values = values(codes);
        if (const auto known = designs_.find(trim_values); known != designs_.end()) return known->second;
        auto overrides = options_.overrides;
        for (std::size_t k = 0; k < trim_values.size(); ++k)
            for (const auto& name : options_.trims[k].names)
                overrides.push_back({options_.netlist, name, fmt::format("{:.17g}", trim_values[k]), name});
        const auto netlist = TRY(circuit::apply_overrides(options_.netlist, overrides));
        TRY(check_all_used(netlist.unused, std::array{std::string_view(options_.netlist)}));
        auto factory = TRY(CircuitAfferentFactory::create(netlist.result));
        return designs_.emplace(trim_values, factory).first->second;
    }
    /// Sets the results of a press.
    void evaluate(ChipPress& p, ChipResponse&& response) const {
        p.spikes = std::move(response.spikes), p.diverged = response.error.has_value();
        p.meets_limits = !p.diverged && !response.hit_iteration_limit && options_.limits.are_met(p.spikes);
        p.distance = p.diverged ? std::numeric_limits<double>::infinity() : options_.limits.distance(p.spikes);
        // A press that was stopped at the iteration limit, because the chip fired too often, gets a larger distance than any complete
        // press: 1e6 to 2e6. The earlier its last spike, the larger.
        if (response.hit_iteration_limit)
            p.distance = 1e6 * (2 - (p.spikes.empty() ? 0 : p.spikes.back() / (options_.T * static_cast<double>(options_.force.size()))));
    }

public:
    ChipPresser(const ChipCalibration& options, const std::vector<ChipSample>& chips)
        : options_(options), chips_(chips), pool_(options.threads) {}

    /// True if two sets of codes give the same trim values; different codes can, if the values are rounded to integers.
    bool same_values(const Codes& a, const Codes& b) const { return values(a) == values(b); }

    /// Simulates these presses and writes their results into them.
    Result<void> press(std::vector<ChipPress>& all) {
        if (all.empty()) return {};
        std::vector<std::shared_ptr<const CircuitAfferentFactory>> designs;
        for (const auto& p : all) designs.push_back(TRY(design(p.codes)));
        std::mutex mutex;
        std::size_t next = 0;
        std::optional<Error> failed;
        const auto next_chip = [&]() -> std::optional<Chip> {
            const std::lock_guard lock(mutex);
            if (next == all.size()) return {};
            const auto k = next++;
            return Chip{static_cast<std::int64_t>(k), designs[k], chips_[all[k].chip], options_.force, options_.T};
        };
        const auto on_response = [&](const Chip& chip, ChipResponse&& response) {
            evaluate(all[static_cast<std::size_t>(chip.id)], std::move(response));
        };
        pool_.for_each(pool_.threads(), [&](std::size_t, unsigned) {
            // designs[0] stands for all designs, which have the same devices.
            if (auto done = circuit::run_chips(designs[0], next_chip, on_response, options_.batch); !done) {
                const std::lock_guard lock(mutex);
                failed = done.error();
            }
        });
        return failed ? Result<void>(*failed) : Result<void>();
    }
};

/// The search for the codes of one chip. Alternates between next_presses() and take_results().
class TrimSearch {
    const ChipCalibration& options_;
    const ChipPresser& presser_;
    std::size_t chip_;
    CalibratedChip out_;
    Codes best_;           // best codes so far; at first all 0: as designed
    double distance_ = 0;  // of the press with best_
    Codes combined_;  // codes of the next press, which moves all trims that reduced the distance; empty: the next ones move one trim each
    int bits_ = 0;    // present number of bits
    int rounds_ = 0;  // rounds of presses with this number of bits
    std::vector<Codes> tried_;

    static constexpr int max_rounds_per_bits = 6;  // for each number of bits

    /// Step of the codes with the present number of bits, in steps of the largest number of bits.
    int step() const { return 1 << (options_.bits - bits_); }
    /// True if the codes are in range and their values have not been tried.
    bool is_allowed(const Codes& codes) const {
        const int max = 1 << (options_.bits - 1), min = step() - max;
        for (const int c : codes)
            if (c < min || c > max) return false;
        return std::none_of(tried_.begin(), tried_.end(), [&](const Codes& t) { return presser_.same_values(t, codes); });
    }
    /// Ends the search with this number of bits; the next presses use one bit more.
    void finish_bits() {
        out_.codes.push_back(best_), out_.distance.push_back(distance_);
        ++bits_, rounds_ = 0;
    }
    /// Takes the press as the best one so far if its distance is smaller.
    bool take_if_better(const ChipPress& p) {
        if (!(p.distance < distance_)) return false;
        distance_ = p.distance, best_ = p.codes, out_.spikes = p.spikes;
        return true;
    }

public:
    TrimSearch(const ChipCalibration& options, const ChipPresser& presser, std::size_t chip)
        : options_(options), presser_(presser), chip_(chip), best_(options.trims.size()) {}

    bool is_finished() const { return out_.bits >= 0 || bits_ > options_.bits; }
    CalibratedChip take_result() { return std::move(out_); }

    /// The presses to simulate next.
    std::vector<ChipPress> next_presses() {
        if (bits_ == 0) return {{chip_, best_}};
        if (!combined_.empty()) return {{chip_, combined_}};
        while (!is_finished()) {
            std::vector<ChipPress> out;
            for (std::size_t k = 0; k < best_.size() && rounds_ < max_rounds_per_bits; ++k)
                for (const int d : {-step(), step()}) {
                    auto codes = best_;
                    codes[k] += d;
                    if (is_allowed(codes)) out.push_back({chip_, std::move(codes)});
                }
            if (!out.empty()) return out;
            finish_bits();
        }
        return {};
    }

    /// Takes the results of the presses that next_presses() returned.
    void take_results(std::vector<ChipPress>&& all) {
        out_.presses += static_cast<int>(all.size());
        for (const auto& p : all) tried_.push_back(p.codes);
        const auto passing = std::find_if(all.begin(), all.end(), [](const ChipPress& p) { return p.meets_limits; });
        if (passing != all.end()) out_.bits = bits_, best_ = passing->codes, distance_ = passing->distance, out_.spikes = passing->spikes;
        if (bits_ == 0) {
            out_.spikes_before = all[0].spikes, out_.diverged = all[0].diverged;
            if (passing == all.end()) distance_ = all[0].distance, out_.spikes = all[0].spikes;
            return finish_bits();
        }
        if (passing != all.end()) return finish_bits();
        const bool was_combined = !combined_.empty();
        combined_.clear();
        ++rounds_;
        const auto before = best_;
        auto combined = best_;
        const double distance_before = distance_;
        std::size_t improving_trims = 0;
        std::vector<double> best_distance(best_.size(), distance_before);  // for each trim, of its better move
        for (auto& p : all) {
            for (std::size_t k = 0; k < best_.size() && !was_combined; ++k)
                if (p.codes[k] != before[k] && p.distance < best_distance[k])
                    improving_trims += best_distance[k] == distance_before, best_distance[k] = p.distance, combined[k] = p.codes[k];
            take_if_better(p);
        }
        if (best_ == before && !was_combined) return finish_bits();
        if (improving_trims > 1 && is_allowed(combined)) combined_ = combined;
    }
};

}  // namespace

double Trim::value(int code, int bits) const {
    const double change = range * static_cast<double>(code) / static_cast<double>(1 << (bits - 1)), value = designed * (1 + change);
    return is_integer ? std::max(1.0, std::round(value)) : value;
}

Result<Trim> trim_of(const std::string& netlist, const std::vector<ParameterOverride>& overrides, std::vector<std::string> names,
                     double range, bool is_integer) {
    const auto read = TRY(circuit::apply_overrides(netlist, overrides));
    TRY(check_all_used(read.unused, std::array{std::string_view(netlist)}));
    const auto circuit = TRY(read.result.elaborate());
    const auto full_name = lower(names.at(0));
    if (const auto p = circuit.parameters.find(full_name); p != circuit.parameters.end())
        return Trim{std::move(names), p->second, range, is_integer};
    const auto dot = full_name.rfind('.');
    std::vector<std::string_view> known;
    for (const auto& e : circuit.elements) known.push_back(e.name);
    const auto found = circuit::find_matching_names(known, full_name.substr(0, dot), circuit::LastPiece::element);
    if (dot != std::string::npos && found.size() == 1) {
        const auto& values = circuit.elements[found[0]].values;
        if (const auto v = values.find(full_name.substr(dot + 1)); v != values.end())
            return Trim{std::move(names), v->second, range, is_integer};
    }
    std::vector<std::string_view> parameters;
    for (const auto& [parameter, value] : circuit.parameters) parameters.push_back(parameter);
    return bad_input(
        fmt::format("trim '{}': {} has no such number; name a .param of the top level or a device parameter such as 'summer.n3b.m'{}",
                    names[0], netlist, did_you_mean(full_name, parameters)));
}

Result<std::vector<CalibratedChip>> calibrate(const ChipCalibration& options, const std::vector<ChipSample>& chips) {
    if (options.bits < 1 || options.bits > 12) return bad_input(fmt::format("calibration: bits = {} is outside 1 to 12", options.bits));
    ChipPresser presser(options, chips);
    std::vector<TrimSearch> searches;
    for (std::size_t k = 0; k < chips.size(); ++k) searches.emplace_back(options, presser, k);
    std::size_t presses = 0;
    for (;;) {
        std::vector<ChipPress> all;
        for (auto& s : searches)
            if (!s.is_finished())
                for (auto& p : s.next_presses()) all.push_back(std::move(p));
        if (all.empty()) break;
        TRY(presser.press(all));
        presses += all.size();
        for (std::size_t from = 0, to = 0; from < all.size(); from = to) {  // the presses of a chip follow one another
            while (to < all.size() && all[to].chip == all[from].chip) ++to;
            searches[all[from].chip].take_results({std::make_move_iterator(all.begin() + static_cast<std::ptrdiff_t>(from)),
                                                   std::make_move_iterator(all.begin() + static_cast<std::ptrdiff_t>(to))});
        }
        if (options.on_progress)
            options.on_progress(
                static_cast<std::size_t>(std::count_if(searches.begin(), searches.end(), [](const auto& s) { return !s.is_finished(); })),
                presses);
    }
    std::vector<CalibratedChip> out;
    for (auto& s : searches) out.push_back(s.take_result());
    return out;
}

}  // namespace corpuscle
