#include "reproduction/thesis/bias/bias_widths.hpp"

#include <fmt/format.h>
#include <cmath>

#include "core/text/quantity.hpp"
#include "reproduction/thesis/bias/bias_sweep.hpp"

namespace corpuscle {
namespace {

/// A condition, and the published value there.
struct Condition {
    const char *label, *setting, *unit;
    double published;
    double BiasState::* quantity;
};
constexpr Condition conditions[] = {
    {"V_BN at 100 nA", "i_bias=100n", "V", 100e-3, &BiasState::V_BN}, {"V_BN at 2 uA", "i_bias=2u", "V", 600e-3, &BiasState::V_BN},
    {"I_Q at 2 uA", "i_bias=2u", "A", 2e-6, &BiasState::I_Q},         {"I_Q at 0.55 V", "supply=0.55", "A", 200e-9, &BiasState::I_Q},
    {"I_Q at 0.75 V", "supply=0.75", "A", 200e-9, &BiasState::I_Q},   {"I_Q at 0.8 V", "supply=0.8", "A", 200e-9, &BiasState::I_Q},
    {"I_Q at 60 C", "temp=60", "A", 200e-9, &BiasState::I_Q},         {"I_Q at 95 C", "temp=95", "A", 200e-9, &BiasState::I_Q},
};

std::vector<std::string> width_settings(double factor) {
    std::vector<std::string> out;
    for (const char* p : {"m1a", "m1b", "m3a", "m3b", "m5a", "m5b"}) out.push_back(fmt::format("{}.w={:g}", p, factor * 6e-6));
    for (const char* n : {"m2a", "m2b", "m4a", "m4b", "m4c"}) out.push_back(fmt::format("{}.w={:g}", n, factor * 1.5e-6));
    return out;
}

}  // namespace

Result<void> report_bias_widths(StudyResult& out) {
    bool one_has_all = false;
    for (const double factor : {1.0, 2.0, 3.4, 4.0}) {
        bool has_all = true;
        for (const auto& c : conditions) {
            auto settings = width_settings(factor);
            settings.emplace_back(c.setting);
            const double value = TRY(simulate_bias_state(settings)).*c.quantity;
            has_all = has_all && std::abs(value / c.published - 1) <= Claim::relative_tolerance;
            out.claim(fmt::format("arrays {}: {}", factor == 1 ? "as printed" : fmt::format("{:g} times as wide", factor), c.label), value,
                      c.unit)
                .explain(fmt::format("thesis E.2: {}", format_quantity(c.published, c.unit)));
        }
        one_has_all = one_has_all || has_all;
    }
    out.claim_true("arrays as printed, 2, 3.4 and 4 times as wide: none has all published voltages and currents within a tenth",
                   !one_has_all, "thesis E.2, figs. 53 to 55 against each other");
    out.claims.back().of_kind(ClaimKind::ours);
    out.note(
        "The published ranges contradict each other. Those of the current ask for arrays 3.4 times as wide, those of supply and "
        "temperature "
        "for about twice as wide, and tables 16 to 18 for the printed ones.");
    return {};
}

}  // namespace corpuscle
