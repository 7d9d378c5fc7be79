#include "circuit/afferent/response_directives.hpp"

namespace corpuscle::circuit {
namespace {

Result<SpikeOutput> parse_spike(const System& system, const Directive& c) {
    const auto unknowns = TRY(read_output_variable(system, c, 0));
    if (c.words.size() < 2)
        return error_at(c.location_of(1), ".spike: {} needs a level to cross: .spike v(NODE) LEVEL [rise|fall]", c.words[0]);
    const auto level = TRY(read_number(c, 1, "the level to cross"));
    SpikeOutput out{c.words[0], unknowns, level, true, c.location};
    if (c.words.size() > 2) {
        if (c.words[2] != "rise" && c.words[2] != "fall")
            return error_at(c.location_of(2), ".spike: '{}' must be rise or fall", c.words[2]);
        out.is_rising = c.words[2] == "rise";
    }
    if (c.words.size() > 3)
        return error_at(c.location_of(3), ".spike: unexpected '{}'; expected .spike v(NODE) LEVEL [rise|fall]", c.words[3]);
    return out;
}

Result<OperatingRange> parse_range(const System& system, const Directive& c) {
    constexpr std::string_view syntax = ".assert v(NODE) LOW HIGH [\"MESSAGE\"]";
    const auto unknowns = TRY(read_output_variable(system, c, 0));
    const double low = TRY(read_number(c, 1, "the lowest value")), high = TRY(read_number(c, 2, "the highest value"));
    if (!(low < high)) return error_at(c.location_of(1), ".assert: {:g} to {:g}: LOW must be below HIGH", low, high);
    std::string message;
    if (c.words.size() > 3) {
        const std::string_view word = c.words[3];
        if (word.size() < 3 || word.front() != '"' || word.back() != '"')
            return error_at(c.location_of(3), ".assert: '{}' must be a message in double quotes: {}", word, syntax);
        message = word.substr(1, word.size() - 2);
    }
    if (c.words.size() > 4) return error_at(c.location_of(4), ".assert: unexpected '{}'; expected {}", c.words[4], syntax);
    SavedQuantity quantity{c.words[0], unknowns};
    return OperatingRange{std::move(quantity), low, high, std::move(message), c.location};
}

}  // namespace

Result<std::optional<SpikeOutput>> read_spike_output(const System& system) {
    std::optional<SpikeOutput> out;
    for (const auto& c : system.circuit().directives_named("spike")) {
        if (out) return error_at(c.location, ".spike: only one is allowed; the first is in line {}", out->location.line);
        out = TRY(parse_spike(system, c));
    }
    return out;
}

Result<std::vector<OperatingRange>> read_operating_ranges(const System& system) {
    std::vector<OperatingRange> out;
    for (const auto& c : system.circuit().directives_named("assert")) out.push_back(TRY(parse_range(system, c)));
    return out;
}

}  // namespace corpuscle::circuit
