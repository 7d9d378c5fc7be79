#pragma once
// A number that a study computes, and the published number or the allowed range with which it is compared.

#include <limits>
#include <optional>
#include <string>

#include "reproduction/claims/claim_kind.hpp"

namespace corpuscle {

struct Claim {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    static constexpr double relative_tolerance = 0.1;  ///< largest relative deviation that needs no explanation, without `tolerance`

    std::string label;
    double computed = 0;      ///< in `unit`, as all values of the claim
    std::string unit = {};    ///< such as "V"; "" for a pure number
    double published = none;  ///< NaN if only a range, or nothing, was published
    /// `published` is not stated in the source but derived from it: from an equation, a sentence or the model
    bool is_derived = false;
    /// Largest difference from the published value that needs no explanation, in `unit`; NaN: a tenth of the value. It is stated where
    /// a tenth of the value is too much to mean anything, such as for an effect of 3 mV on 350 mV.
    double tolerance = none;
    double allowed_min = none, allowed_max = none;  ///< allowed range of `computed`; NaN for a missing limit
    std::string source = {};             ///< where the published value or the allowed range is stated, or from what it is derived
    std::string note = {};               ///< explains a deviation
    bool is_boolean = false;             ///< `computed` is 1 (true) or 0 (false)
    std::optional<ClaimKind> kind = {};  ///< empty: the kind of its study, which Study::run fills in

    Claim& published_as(double value, std::string where) { return published = value, source = std::move(where), *this; }
    /// Sets a published value that the source does not state: it is derived from an equation, a sentence or the model.
    Claim& derived_as(double value, std::string from) { return is_derived = true, published_as(value, std::move(from)); }
    Claim& within(double largest_difference) { return tolerance = largest_difference, *this; }
    Claim& of_kind(ClaimKind which) { return kind = which, *this; }
    Claim& allow_range(double min, double max, std::string where) {
        return allowed_min = min, allowed_max = max, source = std::move(where), *this;
    }
    Claim& allow_min(double min, std::string where) { return allow_range(min, none, std::move(where)); }
    Claim& allow_max(double max, std::string where) { return allow_range(none, max, std::move(where)); }
    Claim& explain(std::string why) { return note = std::move(why), *this; }

    /// True if at least one limit is not NaN.
    bool has_allowed_range() const { return allowed_min == allowed_min || allowed_max == allowed_max; }
    bool is_in_allowed_range() const { return !(computed < allowed_min) && !(computed > allowed_max); }
    /// Relative deviation from the published value; NaN if that is missing or 0.
    double deviation() const { return published == 0 ? none : (computed - published) / (published < 0 ? -published : published); }
    /// The largest difference from the published value that needs no explanation; NaN without a published value other than 0.
    double allowed_difference() const {
        if (tolerance == tolerance) return tolerance + 0 * published;
        return published == 0 ? none : relative_tolerance * (published < 0 ? -published : published);
    }
    /// True if the value is outside the allowed range or, without such a range, if it differs from the published value by more than
    /// the tolerance.
    bool needs_explanation() const {
        const double difference = computed - published;
        return has_allowed_range() ? !is_in_allowed_range() : difference > allowed_difference() || difference < -allowed_difference();
    }
    /// Adds the explanation only if the claim needs one.
    Claim& explain_if_needed(std::string why) { return needs_explanation() ? explain(std::move(why)) : *this; }
    /// If there is an allowed range: "holds" or "does not hold". Otherwise, if there is a published value: "agrees" if the difference is
    /// within the tolerance, else "differs". Otherwise "".
    const char* verdict() const {
        if (has_allowed_range()) return is_in_allowed_range() ? "holds" : "does not hold";
        const double difference = computed - published, allowed = allowed_difference();
        if (difference != difference || allowed != allowed) return "";
        return needs_explanation() ? "differs" : "agrees";
    }
};

/// A computed or allowed value in the claim's unit: "350 mV", "yes"; "-" for NaN.
std::string format_claim_value(double, const Claim&);
/// The published value in the claim's unit; in parentheses if it is derived; "-" for NaN.
std::string format_published(const Claim&);
/// "350 mV to 351 mV", "at most 1 nA"; "within 1 mV" of the published value if there is a tolerance; "-" if there is neither.
std::string format_allowed_range(const Claim&);
/// The relative deviation: "-2.3 %"; "-" if there is none.
std::string format_deviation(const Claim&);

}  // namespace corpuscle
