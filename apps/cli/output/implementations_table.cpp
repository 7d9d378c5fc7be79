#include "cli/output/implementations_table.hpp"

#include <fmt/format.h>

#include "cli/output/terminal.hpp"
#include "core/text/quantity.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_rows = 30;             // of the printed table, approximately
constexpr std::size_t max_rows_with_silent = 8;  // if there are more comparisons, those without spikes are omitted

/// The spike counts of all phases, of the implementation or of its reference (selected by `count`): "0 5 8 1 0".
std::string by_phase(const ImplementationComparison& c, std::size_t ImplementationComparison::PhaseCount::* count) {
    std::string text;
    for (const auto& p : c.phases) text += fmt::format("{}{}", text.empty() ? "" : " ", p.*count);
    return text.empty() ? "-" : text;
}

std::vector<std::string> line_of(const ImplementationComparison& c) {
    const auto shown = [](double x, const char* format) { return std::isnan(x) ? std::string("-") : fmt::format(fmt::runtime(format), x); };
    return {c.afferent,
            c.channel,
            fmt::format("{}", c.total.spikes),
            by_phase(c, &ImplementationComparison::PhaseCount::spikes),
            shown(100 * c.total.excess(), "{:+.0f}"),
            fmt::format("{}", c.matched),
            shown(1e3 * c.median_shift, "{:+.2f}"),
            shown(c.victor_purpura, "{:.2f}"),
            shown(c.van_rossum, "{:.2f}")};
}

/// The line of the reference, with which the following lines are compared.
std::vector<std::string> reference_line(const ImplementationComparison& c) {
    return {c.reference, c.channel, fmt::format("{}", c.total.reference_spikes),
            by_phase(c, &ImplementationComparison::PhaseCount::reference_spikes)};
}

}  // namespace

std::string implementations_table(const ImplementationComparisons& comparisons) {
    std::vector<std::vector<std::string>> rows = {
        {"implementation", "channel", "spikes", "by phase", "change (%)", "matched", "shift (ms)", "Victor-Purpura", "van Rossum"}};
    const auto& all = comparisons.rows();
    std::size_t omitted = 0, silent = 0;
    const ImplementationComparison* last = nullptr;  // the last printed row; its reference has been printed, too
    for (const auto& c : all) {
        if (c.total.spikes + c.total.reference_spikes == 0 && all.size() > max_rows_with_silent) {
            ++silent;
            continue;
        }
        if (rows.size() > max_rows) {
            ++omitted;
            continue;
        }
        if (!last || last->reference != c.reference || last->channel != c.channel) rows.push_back(reference_line(c));
        rows.push_back(line_of(c));
        last = &c;
    }
    if (rows.size() == 1) return "";
    auto text = "\n" + format_table(rows);
    if (omitted > 0) text += fmt::format("... and {} more rows; --out writes all of them to summary.json\n", omitted);
    if (silent > 0) text += fmt::format("Not shown: {} pairs without spikes.\n", silent);
    return text +
           fmt::format(
               "Compared with the first row of each afferent type and channel. Spikes within {} match; shift: median of matched spikes.\n"
               "Victor-Purpura cost {:g} per second; van Rossum time constant {}.\n",
               format_quantity(2 / ImplementationComparisons::cost, "s"), ImplementationComparisons::cost,
               format_quantity(ImplementationComparisons::tau, "s"));
}

}  // namespace corpuscle
