#pragma once
// A computed number beside the published one.

#include <limits>
#include <string>

namespace corpuscle {

struct Claim {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    static constexpr double near = 0.1;  ///< relative deviation from the published value that needs no explanation

    std::string what;
    double made = 0;
    std::string unit = {};
    double printed = none;  ///< NaN if only a range, or nothing, was published
    /// `published` is not stated in the source but derived from it: from an equation, a sentence or the model
    bool follows = false;
    double low = none, high = none;  ///< allowed range; NaN if there is no limit
    std::string source = {};         ///< of the published value
    std::string note = {};           ///< explains a deviation
    bool is_truth = false;           ///< `computed` is 1 (true) or 0 (false)

    Claim& printed_as(double value, std::string where) { return printed = value, source = std::move(where), *this; }
    /// A value that is not published itself but derived from what is: from an equation, a sentence or the model.
    Claim& held_to(double value, std::string from) { return follows = true, printed_as(value, std::move(from)); }
    Claim& between(double min, double max, std::string where) { return low = min, high = max, source = std::move(where), *this; }
    Claim& at_least(double min, std::string where) { return between(min, none, std::move(where)); }
    Claim& at_most(double max, std::string where) { return between(none, max, std::move(where)); }
    Claim& because(std::string why) { return note = std::move(why), *this; }

    bool judged() const { return low == low || high == high; }
    bool holds() const { return !(made < low) && !(made > high); }
    /// Relative deviation from the published value; NaN if there is none.
    double deviation() const { return printed == 0 ? none : (made - printed) / (printed < 0 ? -printed : printed); }
    /// True if the value is outside the allowed range, or deviates from the published value by more than the tolerance.
    bool needs_reason() const { return judged() ? !holds() : deviation() > near || deviation() < -near; }
    /// Adds the explanation only if the claim needs one.
    Claim& if_off(std::string why) { return needs_reason() ? because(std::move(why)) : *this; }
    /// "holds" or "does not hold" if there is an allowed range; "agrees" (within a tenth) or "differs" if there is a published number;
    /// otherwise "".
    const char* verdict() const {
        if (judged()) return holds() ? "holds" : "does not hold";
        if (deviation() != deviation()) return "";
        return needs_reason() ? "differs" : "agrees";
    }
};

/// A computed or allowed value in the claim's unit: "350 mV", "yes"; "-" for none.
std::string quantity_of(double, const Claim&);
/// The published value; in brackets if it is derived.
std::string printed_of(const Claim&);
/// "350 mV .. 351 mV", "<= 1 nA"; "-" if there is no range.
std::string allowed_of(const Claim&);
/// "-2.3 %"; "-" if there is none.
std::string deviation_of(const Claim&);

}  // namespace corpuscle
