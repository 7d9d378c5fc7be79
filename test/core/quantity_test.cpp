#include "support/property.hpp"

#include <cmath>

#include "core/text/quantity.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

TEST(Quantity, ReadsNumbersWithUnitsInAllTheirSpellings) {
    const struct {
        const char *text, *unit;
        double value;
    } cases[] = {
        {"10 ms", "s", 10e-3},
        {"0.5um", "m", 0.5e-6},
        {"1k", "ohm", 1e3},
        {"25Hz", "Hz", 25},
        {"1.5 N", "N", 1.5},
        {"10%", "", 0.1},
        {"8 uA/N", "A/N", 8e-6},
        {"8 \u00b5A/N", "A/N", 8e-6},
        {"3e-7", "A", 3e-7},
        {"500n", "F", 500e-9},
        {"100 gf", "N", 0.980665},
        {"2 kgf", "N", 19.6133},
        {"-65mV", "V", -65e-3},
        {"2.5 V/ms/uA", "V/s/A", 2.5e9},
        {"100 nA s/N", "A s/N", 1e-7},
        {"40 mm/s", "m/s", 0.04},
        {"2 min", "s", 120},
        {"1 Mohm", "ohm", 1e6},
        {"5m", "N", 5e-3},
        {"5m", "m", 5},
        {" +7 ", "", 7},
        {"0.02 1/ms", "1/s", 20},
        {"20 Hz", "1/s", 20},
        {"1 S", "A/V", 1},
        {"1 V/A", "ohm", 1},
    };
    for (const auto& c : cases) {
        const auto value = parse_quantity(c.text, c.unit);
        ASSERT_TRUE(value) << c.text << ": " << value.error().text();
        EXPECT_NEAR(*value, c.value, 1e-12 * std::abs(c.value)) << c.text;
    }
}

TEST(Quantity, RefusesInvalidTextsAndGivesAnExample) {
    const struct {
        const char *text, *unit, *message;
    } cases[] = {
        {"25 ms", "Hz", "'25 ms' is a time; expected a value in Hz, such as '2 Hz'"},
        {"", "s", "'' is not a quantity; write a number and a unit, such as '2 s'"},
        {"ten", "s", "'ten' is not a quantity; write a number and a unit, such as '2 s'"},
        {"3 furlong", "m", "'3 furlong': unknown unit 'furlong'; expected a value in m, such as '2 m'"},
        {"1e999", "s", "'1e999' is not a quantity; write a number and a unit, such as '2 s'"},
        {"1e300 G", "s", "'1e300 G' is not a finite number"},
        {"2 N", "", "'2 N' is a force; expected a number without a unit"},
        {"nan", "s", "'nan' is not a finite number"},
        {"2 A/", "A/N", "'2 A/': unit 'A/' is incomplete: a symbol is missing at the end; expected a value in A/N, such as '2 A/N'"},
    };
    for (const auto& c : cases) {
        const auto value = parse_quantity(c.text, c.unit);
        ASSERT_FALSE(value) << c.text << " gave " << *value;
        EXPECT_EQ(value.error().message, c.message);
    }
}

TEST(Quantity, FormattedDefaultsOfAllParametersAreReadBack) {
    for (const auto& entries : {receptor_entries(), neuron_entries(), stimulus_catalog()})
        for (const auto& entry : entries)
            for (const auto& row : entry.parameters) {
                const auto text = format_quantity(row.default_value, row.unit);
                const auto back = parse_quantity(text, row.unit);
                ASSERT_TRUE(back) << entry.name << '.' << row.name << ": " << back.error().text();
                EXPECT_NEAR(*back, row.default_value, 1e-3 * std::abs(row.default_value))
                    << entry.name << '.' << row.name << " as " << text;
            }
}

RC_GTEST_PROP(Quantity, AFormattedValueIsReadBack, ()) {
    const auto mantissa = *rc::gen::inRange(1000, 9999);
    const auto power = *rc::gen::inRange(-15, 12);
    const double value = mantissa * std::pow(10.0, power - 3);
    const auto unit = *rc::gen::element<std::string>("s", "Hz", "N", "V", "A", "A/N", "A s/N", "V/s", "ohm", "F");
    const auto back = parse_quantity(format_quantity(value, unit), unit);
    RC_ASSERT(static_cast<bool>(back));
    RC_ASSERT(std::abs(*back - value) <= 1e-9 * value);
}

TEST(Quantity, ReadsAreasDensitiesAndPressures) {
    EXPECT_DOUBLE_EQ(*parse_quantity("4 mm2", "m2"), 4e-6);
    EXPECT_DOUBLE_EQ(*parse_quantity("241 /cm2", "1/m2"), 241e4);
    EXPECT_DOUBLE_EQ(*parse_quantity("2 1/mm2", "1/m2"), 2e6);
    EXPECT_DOUBLE_EQ(*parse_quantity("50 kPa", "Pa"), 50e3);
    EXPECT_DOUBLE_EQ(*parse_quantity("0.05 N/mm2", "Pa"), 50e3);
    EXPECT_DOUBLE_EQ(*parse_quantity("3 cm", "m"), 0.03);
    EXPECT_EQ(format_quantity(4e-6, "m2"), "4e-06 m2");  // not "4 um2", which is 4e-12 m2
    for (const auto* wrong : {"4 mm", "4 /", "4 2", "4 ccm2", "4 cm22"}) EXPECT_FALSE(parse_quantity(wrong, "m2")) << wrong;
}

RC_GTEST_PROP(Quantity, AcceptsOnlyUnitsOfTheRequiredDimension, ()) {
    const auto a = *rc::gen::element<std::string>("s", "N", "V", "A", "m"), b = *rc::gen::element<std::string>("s", "N", "V", "A", "m");
    RC_ASSERT(static_cast<bool>(parse_quantity("2 k" + a, b)) == (a == b));
}

}  // namespace
}  // namespace corpuscle
