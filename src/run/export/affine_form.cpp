#include "run/export/affine_form.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace corpuscle {

AffineForm& AffineForm::operator+=(const AffineForm& other) {
    constant += other.constant;
    for (const auto& [signal, factor] : other.factors)
        if ((factors[signal] += factor) == 0) factors.erase(signal);
    return *this;
}

AffineForm& AffineForm::operator*=(double x) {
    constant *= x;
    for (auto& [signal, factor] : factors) factor *= x;
    if (x == 0) factors.clear();
    return *this;
}

/// A parser by recursive descent of one expression.
class AffineFormParser {
    AffineForms& forms_;
    std::string_view text_;  // the rest of the expression

    void skip_spaces() {
        while (text_.starts_with(' ')) text_.remove_prefix(1);
    }
    bool take(char c) {
        skip_spaces();
        if (!text_.starts_with(c)) return false;
        text_.remove_prefix(1);
        return true;
    }
    static AffineForm times(AffineForm form, double x) { return form *= x; }

    Result<AffineForm> sum() {
        AffineForm total = TRY(product());
        for (;;) {
            if (take('+'))
                total += TRY(product());
            else if (take('-'))
                total += times(TRY(product()), -1);
            else
                return total;
        }
    }

    Result<AffineForm> product() {
        AffineForm value = TRY(factor());
        for (;;) {
            const bool divides = !take('*');
            if (divides && !take('/')) return value;
            auto other = TRY(factor());
            if (divides && !other.is_constant()) return bad_input("it divides by a signal");
            if (!value.is_constant() && !other.is_constant()) return bad_input("it multiplies two signals");
            if (other.is_constant())
                value *= divides ? 1 / other.constant : other.constant;
            else
                value = times(std::move(other), value.constant);
        }
    }

    Result<AffineForm> factor() {
        if (take('-')) return times(TRY(factor()), -1);
        if (take('(')) {
            auto inner = TRY(sum());
            if (!take(')')) return bad_input("a parenthesis is missing");
            return inner;
        }
        skip_spaces();
        if (!text_.empty() && std::isdigit(static_cast<unsigned char>(text_[0])) != 0) return number();
        return name_or_call();
    }

    Result<AffineForm> number() {
        const std::string copy(text_);
        char* end = nullptr;
        const double value = std::strtod(copy.c_str(), &end);
        text_.remove_prefix(static_cast<std::size_t>(end - copy.c_str()));
        return AffineForm{.constant = value};
    }

    Result<AffineForm> name_or_call() {
        std::size_t end = 0;
        while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) != 0 || text_[end] == '_')) ++end;
        const auto name = text_.substr(0, end), before = text_;
        text_.remove_prefix(end);
        if (take('(')) return call(name, before);
        const auto found = forms_.names_.find(name);
        if (found == forms_.names_.end()) return bad_input(fmt::format("it uses '{}'", name));
        return found->second;
    }

    Result<AffineForm> call(std::string_view function, std::string_view before) {
        std::vector<AffineForm> arguments;
        do arguments.push_back(TRY(sum()));
        while (take(','));
        if (!take(')')) return bad_input("a parenthesis is missing");
        const std::string typed(before.substr(0, before.size() - text_.size()));
        if (function == "abs" && arguments.size() == 1) {
            auto value = forms_.rectify(arguments[0], fmt::format("the positive part of {}", typed));
            return value += forms_.rectify(times(arguments[0], -1), fmt::format("the negative part of {}", typed));
        }
        if ((function == "max" || function == "min") && arguments.size() == 2) {  // max(a, b) = b + max(a - b, 0), min: of -a and -b
            const double sign = function == "max" ? 1 : -1;
            auto difference = times(arguments[0], sign);
            difference += times(arguments[1], -sign);
            auto value = times(forms_.rectify(std::move(difference), typed), sign);
            return value += arguments[1];
        }
        if (function == "sqrt" && arguments.size() == 1 && arguments[0].is_constant())
            return AffineForm{.constant = std::sqrt(arguments[0].constant)};
        return bad_input(fmt::format("it uses the function {}", function));
    }

public:
    AffineFormParser(AffineForms& forms, std::string_view text) : forms_(forms), text_(text) {}

    Result<AffineForm> read() {
        auto form = TRY(sum());
        skip_spaces();
        if (!text_.empty()) return bad_input(fmt::format("it has '{}'", text_));
        return form;
    }
};

Result<AffineForm> AffineForms::read(std::string_view expression) { return AffineFormParser(*this, expression).read(); }

AffineForm AffineForms::rectify(AffineForm input, std::string text) {
    if (input.is_constant()) return {.constant = std::max(input.constant, 0.0)};
    const auto name = fmt::format("rectifier_{}", rectifiers_.size() + 1);
    rectifiers_.push_back({name, std::move(text), std::move(input)});
    return {.factors = {{name, 1}}};
}

}  // namespace corpuscle
