#include "circuit/afferent/operating_range.hpp"

#include <fmt/format.h>

namespace corpuscle::circuit {
namespace {

Result<OperatingRange> parse_range(const System& system, const Directive& c) {
    constexpr std::string_view syntax = ".assert v(NODE) LOW HIGH [\"MESSAGE\"]";
    const auto unknowns = read_output_variable(system, c, 0);
    if (!unknowns) return unknowns.error();
    const auto low = read_number(c, 1, "the lowest value"), high = read_number(c, 2, "the highest value");
    if (!low) return low.error();
    if (!high) return high.error();
    if (!(*low < *high)) return error_at(c, 1, fmt::format(".assert: {:g} to {:g}: LOW must be below HIGH", *low, *high));
    OperatingRange out{{c.words[0], *unknowns}, *low, *high, "", c.location};
    if (c.words.size() > 3) {
        const std::string_view word = c.words[3];
        if (word.size() < 3 || word.front() != '"' || word.back() != '"')
            return error_at(c, 3, fmt::format(".assert: '{}' must be a message in double quotes: {}", word, syntax));
        out.message = word.substr(1, word.size() - 2);
    }
    if (c.words.size() > 4) return error_at(c, 4, fmt::format(".assert: unexpected '{}'; expected {}", c.words[4], syntax));
    return out;
}

}  // namespace

Result<std::vector<OperatingRange>> read_operating_ranges(const System& system) {
    std::vector<OperatingRange> out;
    for (const auto& c : system.circuit().directives) {
        if (c.name != "assert") continue;
        auto range = parse_range(system, c);
        if (!range) return range.error();
        out.push_back(std::move(*range));
    }
    return out;
}

}  // namespace corpuscle::circuit
