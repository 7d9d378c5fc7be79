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
struct AffineForm {
    double constant = 0;
    std::map<std::string, double, std::less<>> factors{};  ///< of signals, by name; none is 0

    bool is_constant() const { return factors.empty(); }
    double factor(std::string_view signal) const {
        const auto found = factors.find(signal);
        return found == factors.end() ? 0 : found->second;
    }
    AffineForm& operator+=(const AffineForm&);
    AffineForm& operator*=(double);
};

/// A signal that is max(input, 0).
struct Rectifier {
    std::string name, text;  ///< "rectifier_1", "max(K_B*(F - y_B), 0)"
    AffineForm input;
};

/// Reads expressions.
class AffineForms {
    std::map<std::string, AffineForm, std::less<>> names_;
    std::vector<Rectifier> rectifiers_;
    friend class AffineFormParser;

public:
    void define(std::string_view name, AffineForm form) { names_[std::string(name)] = std::move(form); }
    void define_number(std::string_view name, double value) { define(name, {.constant = value}); }
    void define_signal(std::string_view name) { define(name, {.factors = {{std::string(name), 1}}}); }
    /// The form of an expression. max, min and abs of signals become positive parts. Returns an error that states why an expression has no
    /// form: a product of signals, or another function.
    Result<AffineForm> read(std::string_view expression);
    /// The signal that is the positive part of a form. `text`: its name for people.
    AffineForm rectify(AffineForm, std::string text);
    const std::vector<Rectifier>& rectifiers() const { return rectifiers_; }
};

}  // namespace corpuscle
