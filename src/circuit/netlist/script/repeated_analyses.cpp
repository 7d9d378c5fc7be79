#include "circuit/netlist/script/repeated_analyses.hpp"

#include <map>
#include <set>
#include <vector>

namespace corpuscle::circuit {
namespace {

std::vector<std::string_view> words_of(const Statement& s) {
    std::vector<std::string_view> out;
    for (std::size_t k = 0; k < s.words.size(); ++k) out.push_back(s.text(k));
    return out;
}

}  // namespace

void remove_repeated_analyses(ParsedNetlist& parsed, std::span<const Statement* const> script_analyses) {
    if (script_analyses.empty()) return;
    const std::set<const Statement*> scripts(script_analyses.begin(), script_analyses.end());
    // Directives outside of scripts that do not depend on a condition, by their words.
    std::map<std::vector<std::string_view>, const Statement*> directives;
    for (const auto* s : parsed.directives)
        if (!scripts.contains(s) && s->condition < 0) directives.try_emplace(words_of(*s), s);
    const auto repeated = [&](const Statement* s) {
        const auto at = scripts.contains(s) ? directives.find(words_of(*s)) : directives.end();
        return at == directives.end() ? nullptr : at->second;
    };
    for (auto& s : parsed.statements)
        if (const auto* directive = s.analysis ? repeated(s.analysis) : nullptr) s.analysis = directive;
    std::erase_if(parsed.directives, [&](const Statement* s) { return repeated(s) != nullptr; });
}

}  // namespace corpuscle::circuit
