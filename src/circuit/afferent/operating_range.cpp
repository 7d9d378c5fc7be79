#include "circuit/afferent/operating_range.hpp"

#include <fmt/format.h>

namespace corpuscle::circuit {
namespace {

Result<OperatingRange> parse_range(const System& system, const Directive& c) {
    constexpr std::string_view syntax = ".assert v(NODE) LOW HIGH [\"MESSAGE\"]";
    const auto unknowns = TRY(read_output_variable(system, c, 0));
    const double low = TRY(read_number(c, 1, "the lowest value")), high = TRY(read_number(c, 2, "the highest value"));
    if (!(low < high)) return error_at(c, 1, fmt::format(".assert: {:g} to {:g}: LOW must be below HIGH", low, high));
    std::string message;
    if (c.words.size() > 3) {
        const std::string_view word = c.words[3];
        if (word.size() < 3 || word.front() != '"' || word.back() != '"')
            return error_at(c, 3, fmt::format(".assert: '{}' must be a message in double quotes: {}", word, syntax));
        message = word.substr(1, word.size() - 2);
    }
    if (c.words.size() > 4) return error_at(c, 4, fmt::format(".assert: unexpected '{}'; expected {}", c.words[4], syntax));
    SavedQuantity quantity{c.words[0], unknowns};
    return OperatingRange{std::move(quantity), low, high, std::move(message), c.location};
}

}  // namespace

Result<std::vector<OperatingRange>> read_operating_ranges(const System& system) {
    std::vector<OperatingRange> out;
    for (const auto& c : system.circuit().directives) {
        if (c.name != "assert") continue;
        out.push_back(TRY(parse_range(system, c)));
    }
    return out;
}

}  // namespace corpuscle::circuit
