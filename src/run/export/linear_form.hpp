#pragma once
// An expression of model/equations as a sum of signals with constant factors, where each signal is a force, a state, or a positive part of
// such a sum.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace corpuscle {

/// A sum of signals with factors, and a constant.
struct LinearForm {
    double constant = 0;
    std::map<std::string, double, std::less<>> factors{};  ///< of signals, by name; none is 0

    bool is_constant() const { return factors.empty(); }
    double factor(std::string_view signal) const {
        const auto found = factors.find(signal);
        return found == factors.end() ? 0 : found->second;
    }
    LinearForm& operator+=(const LinearForm&);
    LinearForm& operator*=(double);
};

/// A signal that is max(input, 0).
struct PositivePart {
    std::string name, text;  ///< "plus_1", "max(K_B*(F - y_B), 0)"
    LinearForm input;
};

/// Reads expressions.
class LinearForms {
    std::map<std::string, LinearForm, std::less<>> names_;
    std::vector<PositivePart> parts_;
    friend class LinearFormParser;

public:
    void define(std::string_view name, LinearForm form) { names_[std::string(name)] = std::move(form); }
    void define_number(std::string_view name, double value) { define(name, {.constant = value}); }
    void define_signal(std::string_view name) { define(name, {.factors = {{std::string(name), 1}}}); }
    /// The form of an expression. max, min and abs of signals become positive parts. Returns an error that states why an expression has no
    /// form: a product of signals, or another function.
    Result<LinearForm> read(std::string_view expression);
    /// The signal that is the positive part of a form. `text`: its name for people.
    LinearForm positive_part(LinearForm, std::string text);
    const std::vector<PositivePart>& positive_parts() const { return parts_; }
};

}  // namespace corpuscle
