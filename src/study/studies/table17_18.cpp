// Tables 17 and 18: V_Q and I_Q of 1000 chips, with and without the bias generator.

#include <fmt/format.h>

#include "study/deck.hpp"
#include "study/spread.hpp"
#include "study/studies.hpp"

namespace corpuscle::studies::table17_18 {

struct Row {
    const char *circuit, *name, *voltage, *current;
    struct Printed {
        double mean, spread;  // V or A; % of it
    } V[3], I[3];
};
constexpr Row rows[] = {
    {"quiescent",
     "no biasing",
     "v(qa)",
     "i(visa)",
     {{355.5e-3, 2.64}, {355.1e-3, 0.13}, {355.2e-3, 2.28}},
     {{17.51e-9, 28.4}, {17.59e-9, 1.19}, {17.50e-9, 27.2}}},
    {"bias",
     "biasing",
     "v(q)",
     "i(vis)",
     {{350.1e-3, 0.02}, {350.1e-3, 0.19}, {350.1e-3, 0.18}},
     {{199.6e-9, 0.77}, {199.4e-9, 2.56}, {199.0e-9, 2.59}}},
};
struct Way {
    const char *name, *corner, *words;
};
constexpr Way ways[] = {{"process", "mc", "mismatch=0"}, {"mismatch", "tt", "process=0"}, {"all", "mc", ""}};

Result<Outcome> work(const StudyOptions& options) {
    Outcome out;
    for (const auto& row : rows)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto chips =
                all_found_in({row.circuit, {fmt::format("corner={}", ways[k].corner)}, fmt::format(".op\n.mc 1000 {}", ways[k].words)});
            if (!chips) return chips.error();
            const auto V = spread_of(*chips, row.voltage), I = spread_of(*chips, row.current);
            const auto what = fmt::format("{}, {}: ", row.name, ways[k].name);
            out.claim(what + "mean V_Q", V.mean, "V").printed_as(row.V[k].mean, "table 17");
            out.claim(what + "deviation of V_Q", V.percent(), "%").printed_as(row.V[k].spread, "table 17");
            out.claim(what + "mean I_Q", I.mean, "A").printed_as(row.I[k].mean, "table 18");
            out.claim(what + "deviation of I_Q", I.percent(), "%").printed_as(row.I[k].spread, "table 18");
        }
    return options.at(1) ? Result<Outcome>(out) : options.at(1).error();
}

const Study study{"table17-18", "V_Q and I_Q of 1000 chips", "Printed for process, mismatch and all. Thesis E.2, tables 17 and 18", work};

}  // namespace corpuscle::studies::table17_18
