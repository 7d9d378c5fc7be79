#include "circuit/afferent/spike_output.hpp"

#include <fmt/format.h>

namespace corpuscle::circuit {
namespace {

Result<SpikeOutput> parse_spike(const System& system, const Directive& c) {
    const auto unknowns = TRY(read_output_variable(system, c, 0));
    if (c.words.size() < 2)
        return error_at(c, 1, fmt::format(".spike: {} needs a level to cross: .spike v(NODE) LEVEL [rise|fall]", c.words[0]));
    const auto level = TRY(read_number(c, 1, "the level to cross"));
    SpikeOutput out{c.words[0], unknowns, level, true, c.location};
    if (c.words.size() > 2) {
        if (c.words[2] != "rise" && c.words[2] != "fall")
            return error_at(c, 2, fmt::format(".spike: '{}' must be rise or fall", c.words[2]));
        out.is_rising = c.words[2] == "rise";
    }
    if (c.words.size() > 3)
        return error_at(c, 3, fmt::format(".spike: unexpected '{}'; expected .spike v(NODE) LEVEL [rise|fall]", c.words[3]));
    return out;
}

}  // namespace

Result<std::optional<SpikeOutput>> read_spike_output(const System& system) {
    std::optional<SpikeOutput> out;
    for (const auto& c : system.circuit().directives) {
        if (c.name != "spike") continue;
        if (out) return bad_input(fmt::format(".spike: only one is allowed; the first is in line {}", out->location.line), c.location);
        out = TRY(parse_spike(system, c));
    }
    return out;
}

}  // namespace corpuscle::circuit
