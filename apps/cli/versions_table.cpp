// Below the rates of corpuscle respond: versions of one receptor, held against the first.

#include "versions_table.hpp"

#include <fmt/format.h>

#include "signal/quantity.hpp"
#include "terminal.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t most_rows = 30;
constexpr std::size_t most_rows_in_full = 8;  // silence is shown up to here

/// "0 5 8 1 0", phase by phase.
std::string by_phase(const Comparison& c, std::size_t Comparison::Count::* which) {
    std::string text;
    for (const auto& p : c.phases) text += fmt::format("{}{}", text.empty() ? "" : " ", p.*which);
    return text.empty() ? "-" : text;
}

std::vector<std::string> line_of(const Comparison& c) {
    const auto shown = [](double x, const char* how) { return std::isnan(x) ? std::string("-") : fmt::format(fmt::runtime(how), x); };
    return {c.afferent,
            c.channel,
            fmt::format("{}", c.all.spikes),
            by_phase(c, &Comparison::Count::spikes),
            shown(100 * c.all.excess(), "{:+.0f}"),
            fmt::format("{}", c.matched),
            shown(1e3 * c.median_shift, "{:+.2f}"),
            shown(c.victor_purpura, "{:.2f}"),
            shown(c.van_rossum, "{:.2f}")};
}

/// What the lines after it are held against.
std::vector<std::string> reference_line(const Comparison& c) {
    return {c.reference, c.channel, fmt::format("{}", c.all.in_reference), by_phase(c, &Comparison::Count::in_reference)};
}

}  // namespace

std::string versions_table(const Comparisons& comparisons) {
    std::vector<std::vector<std::string>> rows = {
        {"version", "channel", "spikes", "by phase", "differ (%)", "matched", "shift (ms)", "Victor-Purpura", "van Rossum"}};
    const auto& all = comparisons.rows();
    std::size_t more = 0, silent = 0;
    const Comparison* last = nullptr;  // whose reference has its line
    for (const auto& c : all) {
        if (c.all.spikes + c.all.in_reference == 0 && all.size() > most_rows_in_full) {
            ++silent;
            continue;
        }
        if (rows.size() > most_rows && ++more) continue;
        if (!last || last->reference != c.reference || last->channel != c.channel) rows.push_back(reference_line(c));
        rows.push_back(line_of(c));
        last = &c;
    }
    if (rows.size() == 1) return "";
    auto text = "\n" + table(rows);
    if (more > 0) text += fmt::format("... and {} rows more; --out writes them all to summary.json\n", more);
    if (silent > 0) text += fmt::format("Silent both, and not shown: {}.\n", silent);
    return text +
           fmt::format(
               "Against the first of each; matched within {}, shift their median; Victor-Purpura at {:g} a second; van Rossum with {}.\n",
               format_quantity(2 / Comparisons::cost, "s"), Comparisons::cost, format_quantity(Comparisons::tau, "s"));
}

}  // namespace corpuscle
