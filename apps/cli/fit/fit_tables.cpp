// The tables of a fit: parameters, scores, data beside the response, and what the data do not determine.

#include <fmt/format.h>
#include <cmath>

#include "cli/fit/fit_arguments.hpp"
#include "cli/output/terminal.hpp"
#include "core/text/ascii_text.hpp"
#include "core/text/quantity.hpp"
#include "fit/fit_document.hpp"

namespace corpuscle {
namespace {

std::string number(double x) { return std::isnan(x) ? "-" : fmt::format("{:.4g}", x); }

std::string quantity(double x, const std::string& unit) { return std::isfinite(x) ? format_quantity(x, unit) : "-"; }

std::string parameter_table(const FitResult& result) {
    TableRows rows = {{"parameter", "start", "fitted", "95 % interval"}};
    for (const auto& p : result.parameters) {
        const auto& unit = p.parameter.unit;
        const auto interval = p.low           ? fmt::format("{} to {}", format_quantity(*p.low, unit), format_quantity(*p.high, unit))
                              : p.is_at_bound ? "at its bound"
                              : result.is_interrupted ? "interrupted"
                                                      : "not identified";
        rows.push_back({p.parameter.name, format_quantity(p.parameter.start, unit), format_quantity(p.value, unit), interval});
    }
    return format_table(rows);
}

std::string score_text(const FitResult& result, const FitProblem& problem) {
    auto out = fmt::format("\nscore {} (before the fit {})", number(result.score), number(result.start_score));
    if (result.test_score) out += fmt::format(", held out {}", number(*result.test_score));
    return out + fmt::format(": {}\n{} simulations; {} of {} searches ended at this score\n", problem.score_meaning(), result.evaluations,
                             result.agreeing_starts, result.starts);
}

std::string row_table(const FitResult& result) {
    bool has_ranges = false, has_tests = false;
    for (const auto& r : result.rows) has_ranges = has_ranges || r.is_within(), has_tests = has_tests || r.is_test;
    TableRows rows = {{"data", "measure", "target", "fitted"}};
    if (has_ranges) rows[0].insert(rows[0].end(), {"range", "within"});
    if (has_tests) rows[0].push_back("set");
    for (const auto& r : result.rows) {
        auto row = table_row(r.data, r.measure, quantity(r.target, r.unit), quantity(r.fitted, r.unit));
        if (has_ranges) {
            const auto within = r.is_within();
            row.push_back(within ? fmt::format("{} to {}", quantity(*r.low, r.unit), quantity(*r.high, r.unit)) : "");
            row.push_back(!within ? "" : *within ? "yes" : "no");
        }
        if (has_tests) row.push_back(r.is_test ? "test" : "train");
        rows.push_back(std::move(row));
    }
    return "\n" + format_table(rows);
}

/// "k_A x 2 with V_th x 2 changes the score by 0.0001: only their combination is determined".
std::string trade_text(const FitResult& result, const ParameterTrade& trade) {
    std::vector<std::string> changes;
    for (const auto& [name, factor] : trade.factors) {
        bool is_logarithmic = true;
        for (const auto& p : result.parameters)
            if (p.parameter.name == name) is_logarithmic = p.parameter.is_logarithmic();
        changes.push_back(is_logarithmic ? fmt::format("{} x {:.3g}", name, factor) : fmt::format("{} = {:.3g}", name, factor));
    }
    // A change that clearly worsens the fit is undetermined only because the fit is bad.
    const bool has_effect = std::abs(trade.score_change) > 0.01 + 0.1 * result.score;
    const auto* reason = has_effect            ? "but the differences that remain are too large for an interval"
                         : changes.size() == 1 ? "the data do not determine it"
                                               : "the data determine only a combination; fix one of them";
    return fmt::format("{} changes the score by {:.2g}: {}\n", joined(changes, " with "), trade.score_change, reason);
}

}  // namespace

std::string fit_tables(const FitResult& result, const FitProblem& problem) {
    std::string out = parameter_table(result) + score_text(result, problem) + row_table(result);
    if (!result.trades.empty()) out += "\nNot identified:\n";
    for (const auto& trade : result.trades) out += "  " + trade_text(result, trade);
    return out + fmt::format("\nThe fitted values as options:\n  {}\n", settings_options(result));
}

}  // namespace corpuscle
