#include "api/c/c_simulation.hpp"

#include <algorithm>
#include <cstring>

#include "api/c/c_error.hpp"

namespace corpuscle::api {
namespace {

constexpr std::size_t first_size = sizeof(corpuscle_simulation);  // of the first version; the structure only grows

/// A copy of the structure. The caller may have been compiled with fewer members, or with more. Throws BadCall if it uses members that this
/// library does not have.
corpuscle_simulation known_members(const corpuscle_simulation* given) {
    corpuscle_simulation out = {};
    if (given->size < first_size || given->size > (std::size_t{1} << 16))
        throw BadCall("simulation.size is " + std::to_string(given->size) + ", but must be sizeof(corpuscle_simulation), here " +
                      std::to_string(sizeof out));
    std::memcpy(&out, given, std::min(given->size, sizeof out));
    const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
    if (std::any_of(bytes + std::min(given->size, sizeof out), bytes + given->size, [](unsigned char b) { return b != 0; }))
        throw BadCall("the simulation has members that this library, version " + std::string(corpuscle_version()) +
                      ", does not know; set them to 0, or use a later version");
    return out;
}

/// "sa1,fa1" as {"sa1", "fa1"}.
std::vector<std::string> split_at_commas(const std::string& text) {
    std::vector<std::string> out(1);
    for (const char c : text) c == ',' ? static_cast<void>(out.emplace_back()) : out.back().push_back(c);
    return out;
}

std::string text_or_empty(const char* text) { return text ? text : ""; }

}  // namespace

Simulation simulation_of(const corpuscle_simulation* given) {
    if (!given) return {};
    const auto c = known_members(given);
    constexpr auto known_flags = CORPUSCLE_BACKWARD_EULER | CORPUSCLE_SAMPLED | CORPUSCLE_SINGLE_PRECISION;
    if ((c.flags & ~known_flags) != 0 || c.unused != 0)
        throw BadCall("simulation: flags " + std::to_string(c.flags) + " or unused " + std::to_string(c.unused) +
                      " have bits without a meaning; set them to 0");
    Simulation out;
    if (c.afferents && *c.afferents) out.afferents = split_at_commas(c.afferents);
    out.population = text_or_empty(c.population), out.contact = text_or_empty(c.contact), out.taxels = text_or_empty(c.taxels);
    out.settings = texts_of(c.settings, c.setting_count, "simulation.settings");
    out.spreads = texts_of(c.spreads, c.spread_count, "simulation.spreads");
    out.seed = c.seed, out.noise = c.noise, out.copies = c.copies, out.threads = c.threads;
    out.backward_euler = (c.flags & CORPUSCLE_BACKWARD_EULER) != 0, out.sampled = (c.flags & CORPUSCLE_SAMPLED) != 0;
    out.single_precision = (c.flags & CORPUSCLE_SINGLE_PRECISION) != 0;
    if (c.progress) out.progress = [c](double fraction) { return c.progress(c.user, fraction) == 0; };
    return out;
}

}  // namespace corpuscle::api
