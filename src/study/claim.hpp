#pragma once
// A number made here, beside one that was printed.

#include <limits>
#include <string>

namespace corpuscle {

struct Claim {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();
    static constexpr double near = 0.1;  ///< a deviation from what was printed that needs no reason

    std::string what;
    double made = 0;
    std::string unit = {};
    double printed = none;           ///< NaN: only the range, or nothing, was printed
    bool follows = false;            ///< `printed` does not stand there itself but follows: from an equation, from words, from the model
    double low = none, high = none;  ///< what is allowed, if that is said
    std::string source = {};         ///< of what was printed
    std::string note = {};           ///< why it differs, where it does
    bool is_truth = false;           ///< made is 1 or 0: whether it is so

    Claim& printed_as(double value, std::string where) { return printed = value, source = std::move(where), *this; }
    /// A number that was not printed itself but follows from what was: from an equation, from words, from the model.
    Claim& held_to(double value, std::string from) { return follows = true, printed_as(value, std::move(from)); }
    Claim& between(double least, double most, std::string where) { return low = least, high = most, source = std::move(where), *this; }
    Claim& at_least(double least, std::string where) { return between(least, none, std::move(where)); }
    Claim& at_most(double most, std::string where) { return between(none, most, std::move(where)); }
    Claim& because(std::string why) { return note = std::move(why), *this; }

    bool judged() const { return low == low || high == high; }
    bool holds() const { return !(made < low) && !(made > high); }
    /// From what was printed, as a share of it; NaN: there is none.
    double deviation() const { return printed == 0 ? none : (made - printed) / (printed < 0 ? -printed : printed); }
    /// Farther from what was printed, or from what is allowed, than goes without saying.
    bool needs_reason() const { return judged() ? !holds() : deviation() > near || deviation() < -near; }
    /// Why it is off, told only if it is.
    Claim& if_off(std::string why) { return needs_reason() ? because(std::move(why)) : *this; }
    /// "holds" or "does not hold" where something is allowed; "agrees" (within a tenth) or "differs" where a number was printed; else "".
    const char* verdict() const {
        if (judged()) return holds() ? "holds" : "does not hold";
        if (deviation() != deviation()) return "";
        return needs_reason() ? "differs" : "agrees";
    }
};

/// What was made or allowed, in the claim's unit: "350 mV", "yes", "-" for nothing.
std::string quantity_of(double, const Claim&);
/// What was printed; in brackets where it only follows.
std::string printed_of(const Claim&);
/// "350 mV .. 351 mV", "<= 1 nA"; "-" if nothing is said.
std::string allowed_of(const Claim&);
/// "-2.3 %"; "-": none.
std::string deviation_of(const Claim&);

}  // namespace corpuscle
