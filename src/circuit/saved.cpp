#include "circuit/saved.hpp"

#include <fmt/format.h>

namespace corpuscle::circuit {

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
            const auto of = wanted_of(system, named, k);
            if (!of) return of.error();
            out.push_back({named.words[k], *of});
        }
    }
    return all ? std::vector<Saved>{} : out;
}

}  // namespace corpuscle::circuit
