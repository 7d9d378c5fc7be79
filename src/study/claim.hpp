#pragma once
// A computed number beside the published one.

#include <limits>
#include <string>

namespace corpuscle {

struct Claim {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    static constexpr double tolerance = 0.1;  ///< relative deviation from the published value that needs no explanation

    std::string label;
    double computed = 0;
    std::string unit = {};
    double published = none;  ///< NaN if only a range, or nothing, was published
    /// `published` is not stated in the source but derived from it: from an equation, a sentence or the model
    bool is_derived = false;
    double allowed_min = none, allowed_max = none;  ///< allowed range; NaN if there is no limit
    std::string source = {};                        ///< of the published value
    std::string note = {};                          ///< explains a deviation
    bool is_boolean = false;                        ///< `computed` is 1 (true) or 0 (false)

    Claim& published_as(double value, std::string where) { return published = value, source = std::move(where), *this; }
    /// A reference value that the source does not state: it is derived from an equation, a sentence or the model.
    Claim& derived_as(double value, std::string from) { return is_derived = true, published_as(value, std::move(from)); }
    Claim& allow_range(double min, double max, std::string where) {
        return allowed_min = min, allowed_max = max, source = std::move(where), *this;
    }
    Claim& allow_min(double min, std::string where) { return allow_range(min, none, std::move(where)); }
    Claim& allow_max(double max, std::string where) { return allow_range(none, max, std::move(where)); }
    Claim& explain(std::string why) { return note = std::move(why), *this; }

    bool has_allowed_range() const { return allowed_min == allowed_min || allowed_max == allowed_max; }
    bool is_in_allowed_range() const { return !(computed < allowed_min) && !(computed > allowed_max); }
    /// Relative deviation from the published value; NaN if that is missing or 0.
    double deviation() const { return published == 0 ? none : (computed - published) / (published < 0 ? -published : published); }
    /// True if the value is outside the allowed range or, without such a range, if it deviates from the published value by more than
    /// the tolerance.
    bool needs_explanation() const {
        return has_allowed_range() ? !is_in_allowed_range() : deviation() > tolerance || deviation() < -tolerance;
    }
    /// Adds the explanation only if the claim needs one.
    Claim& explain_if_needed(std::string why) { return needs_explanation() ? explain(std::move(why)) : *this; }
    /// "holds" or "does not hold" if there is an allowed range; "agrees" (within the tolerance) or "differs" if there is a published
    /// number; otherwise "".
    const char* verdict() const {
        if (has_allowed_range()) return is_in_allowed_range() ? "holds" : "does not hold";
        if (deviation() != deviation()) return "";
        return needs_explanation() ? "differs" : "agrees";
    }
};

/// A computed or allowed value in the claim's unit: "350 mV", "yes"; "-" for NaN.
std::string format_claim_value(double, const Claim&);
/// The published value; in brackets if it is derived.
std::string format_published(const Claim&);
/// "350 mV to 351 mV", "at most 1 nA"; "-" if there is no range.
std::string format_allowed_range(const Claim&);
/// The relative deviation: "-2.3 %"; "-" if there is none.
std::string format_deviation(const Claim&);

}  // namespace corpuscle
