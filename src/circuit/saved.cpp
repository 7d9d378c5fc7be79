#include "circuit/saved.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace corpuscle::circuit {
namespace {

/// Of "i(x1.m1)" the element; -1: it is none whose current is told so.
int device_in(const System& system, std::string_view word) {
    if (!word.starts_with("i(") || !word.ends_with(')') || system.unknown(word) >= 0) return -1;
    const auto& circuit = system.circuit();
    const int k = circuit.element(word.substr(2, word.size() - 3));
    return k >= 0 && has_own_current(circuit.elements[static_cast<std::size_t>(k)]) ? k : -1;
}

}  // namespace

double Saved::current_into(const Device& d, std::span<const double> v) {
    const auto n = v.size();
    std::vector<double> room(2 * n + 2 * n * n);
    const auto all = std::span(room);
    Instant at;
    at.charges = false;
    d.eval(v, at, {all.first(n), all.subspan(n, n), all.subspan(2 * n, n * n), all.subspan(2 * n + n * n)});
    return room[0];
}

Result<std::vector<Saved>> saved_of(const System& system) {
    std::vector<Saved> out;
    bool all = false;
    for (const auto& c : system.circuit().commands) {
        if (c.name != "save") continue;
        for (std::size_t k = 0; k < c.words.size(); ++k) {
            const auto& word = c.words[k];
            if (word == "all") {
                all = true;
                continue;
            }
            auto named = c;
            named.words[k] = word.find('(') == std::string::npos ? fmt::format("v({})", word) : word;
            if (std::any_of(out.begin(), out.end(), [&](const Saved& s) { return s.name == named.words[k]; })) continue;
            if (const int device = device_in(system, named.words[k]); device >= 0) {
                out.push_back({named.words[k], {}, device});
                continue;
            }
            const auto of = wanted_of(system, named, k);
            if (!of) return of.error();
            out.push_back({named.words[k], *of});
        }
    }
    return all ? std::vector<Saved>{} : out;
}

}  // namespace corpuscle::circuit
