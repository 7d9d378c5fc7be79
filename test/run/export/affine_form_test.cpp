#include "run/export/affine_form.hpp"

#include <gtest/gtest.h>

#include "support/support.hpp"

namespace corpuscle {
namespace {

using Factors = std::map<std::string, double, std::less<>>;

AffineForms forms_of_two_signals() {
    AffineForms forms;
    forms.define_number("k", 3), forms.define_signal("x"), forms.define_signal("y");
    return forms;
}

TEST(AffineForm, KeepsTheFactorOfEachSignal) {
    auto forms = forms_of_two_signals();
    const auto form = test::value_or_throw(forms.read("k*(x - 2*y)/4 + 1e-1 - -x"));
    EXPECT_EQ(form.factors, (Factors{{"x", 1.75}, {"y", -1.5}}));
    EXPECT_EQ(form.constant, 0.1);
    EXPECT_TRUE(test::value_or_throw(forms.read("x - x + k")).is_constant());
    EXPECT_TRUE(test::value_or_throw(forms.read("0*(x + y)")).is_constant());
}

TEST(AffineForm, MaximaMinimaAndMagnitudesBecomeRectifiers) {
    auto forms = forms_of_two_signals();
    EXPECT_EQ(test::value_or_throw(forms.read("2*max(x, k)")).factors, (Factors{{"rectifier_1", 2}}));
    EXPECT_EQ(forms.rectifiers()[0].input.constant, -3) << "max(x, 3) = 3 + max(x - 3, 0)";
    const auto smaller = test::value_or_throw(forms.read("min(x, y)"));
    EXPECT_EQ(smaller.factors, (Factors{{"rectifier_2", -1}, {"y", 1}})) << "min(x, y) = y - max(y - x, 0)";
    EXPECT_EQ(forms.rectifiers()[1].input.factors, (Factors{{"x", -1}, {"y", 1}}));
    EXPECT_EQ(test::value_or_throw(forms.read("abs(x)")).factors, (Factors{{"rectifier_3", 1}, {"rectifier_4", 1}}));
    EXPECT_EQ(test::value_or_throw(forms.read("max(k, 5)")).constant, 5);
    EXPECT_EQ(forms.rectifiers().size(), 4U) << "a maximum of numbers is a number";
}

TEST(AffineForm, ExpressionsWithoutAFormAreRefusedWithTheReason) {
    auto forms = forms_of_two_signals();
    for (const auto& [text, reason] : {std::pair("x*y", "it multiplies two signals"), {"k/x", "it divides by a signal"},
                                       {"asinh(x)", "it uses the function asinh"}, {"z + 1", "it uses 'z'"}, {"x > 1", "it has '> 1'"},
                                       {"(x", "a parenthesis is missing"}}) {
        const auto form = forms.read(text);
        ASSERT_FALSE(form) << text;
        EXPECT_EQ(form.error().message, reason);
    }
}

}  // namespace
}  // namespace corpuscle
