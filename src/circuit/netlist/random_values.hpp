#pragma once
// Random values of a netlist: the functions agauss, gauss, aunif, unif, limit of ngspice, and the tolerances dev= and lot= of PSpice.

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "circuit/netlist/netlist.hpp"
#include "core/random.hpp"

namespace corpuscle::circuit {

/// A name of a tolerance in a line of an element or a model.
struct ToleranceName {
    std::string_view name;
    bool is_lot, is_normal;
};
inline constexpr ToleranceName tolerance_names[] = {{"dev", false, false}, {"dev/uniform", false, false}, {"dev/gauss", false, true},
                                                    {"lot", true, false},  {"lot/uniform", true, false},  {"lot/gauss", true, true}};
/// Null if there is none of this name.
inline const ToleranceName* find_tolerance(std::string_view name) {
    const auto* found = std::ranges::find(tolerance_names, name, &ToleranceName::name);
    return found == std::end(tolerance_names) ? nullptr : found;
}

/// Draws the random values of one chip in the order in which the netlist is elaborated. The same draws give the same values.
class RandomValues {
    std::optional<RandomDraws> draws_;  // empty: each random value is its mean
    std::uint32_t count_ = 0;           // values drawn so far
    bool is_used_ = false;
    std::map<std::string, double, std::less<>> lots_;  // deviates that all elements of a model share

    static constexpr std::uint32_t purpose = 0x73707264;  // "sprd" in ASCII: separates these random numbers from those of other purposes

    double normal_deviate() { return normal(draws_->seed, count_++, purpose, draws_->chip); }
    /// Uniform from -1 to 1.
    double uniform_deviate() {
        const auto chip = draws_->chip;
        const auto w = philox({static_cast<std::uint32_t>(chip), static_cast<std::uint32_t>(chip >> 32), count_++, purpose}, draws_->seed);
        return 2 * unit_interval(w[0], w[1]) - 1;
    }
    double deviate(bool is_normal) { return is_normal ? normal_deviate() : uniform_deviate(); }

public:
    explicit RandomValues(std::optional<RandomDraws> draws) : draws_(draws) {}

    bool draws() const { return draws_.has_value(); }
    /// True if the netlist has random values, drawn or not.
    bool is_used() const { return is_used_; }

    /// The value of a random function of ngspice with these arguments:
    ///
    ///     agauss(x, d, k)   normal, mean x, standard deviation d / k        gauss(x, r, k)   the same with d = r x
    ///     aunif(x, d)       uniform from x - d to x + d                     unif(x, r)       the same with d = r x
    ///     limit(x, d)       x - d or x + d
    double function(std::string_view name, std::span<const double> arguments) {
        is_used_ = true;
        const double x = arguments[0], spread = arguments[1];
        if (!draws_) return x;
        if (name == "agauss") return x + spread / arguments[2] * normal_deviate();
        if (name == "gauss") return x + x * spread / arguments[2] * normal_deviate();
        if (name == "aunif") return x + spread * uniform_deviate();
        if (name == "unif") return x + x * spread * uniform_deviate();
        return uniform_deviate() < 0 ? x - spread : x + spread;
    }

    /// The factor of an element's value. A tolerance is a standard deviation if it is normal, else the largest deviation, relative to the
    /// value.
    double element_factor(double tolerance, bool is_normal) {
        is_used_ = true;
        return draws_ && draws_->has_mismatch ? 1 + tolerance * deviate(is_normal) : 1;
    }
    /// The factor of the values of all elements of a lot, which is named by its model or, without one, by the element.
    double lot_factor(const std::string& lot, double tolerance, bool is_normal) {
        is_used_ = true;
        if (!draws_ || !draws_->has_process) return 1;
        const auto [at, is_new] = lots_.try_emplace(lot, 0);
        if (is_new) at->second = deviate(is_normal);
        return 1 + tolerance * at->second;
    }
};

}  // namespace corpuscle::circuit
