#include "circuit/netlist/script/script_variables.hpp"

#include <algorithm>
#include <cctype>

#include "circuit/netlist/statement.hpp"

namespace corpuscle::circuit {
namespace {

/// The offset after the word at `from`. A quoted text or a list in parentheses is one word, and so is an '='.
std::size_t end_of_word(std::string_view text, std::size_t from) {
    constexpr std::string_view open = "('\"", close = ")'\"";
    if (const auto group = open.find(text[from]); group != std::string_view::npos)
        return std::min(text.find(close[group], from + 1), text.size() - 1) + 1;
    return text[from] == '=' ? from + 1 : std::min(text.find_first_of(" \t=", from), text.size());
}

}  // namespace

std::vector<ScriptVariable> read_variables(std::string_view text) {
    std::vector<std::string_view> words;
    for (auto at = text.find_first_not_of(" \t"); at < text.size(); at = text.find_first_not_of(" \t", at)) {
        const auto end = end_of_word(text, at);
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    std::vector<ScriptVariable> out;
    for (std::size_t k = 0; k < words.size(); ++k) {
        auto& variable = out.emplace_back(ScriptVariable{std::string(words[k]), {}});
        if (k + 2 >= words.size() || words[k + 1] != "=") continue;
        k += 2;
        const auto value = unquoted(words[k]);
        if (value.find_first_of("($") == std::string_view::npos) variable.value = std::string(value);
    }
    return out;
}

std::string ScriptVariables::replace(std::string_view text, const std::function<std::optional<std::string>(std::string_view)>& number_of,
                                     std::size_t limit) const {
    std::string out;
    std::size_t from = 0;
    for (auto at = text.find('$'); at != std::string_view::npos && out.size() <= limit; at = text.find('$', from)) {
        const bool is_vector = text.substr(at + 1).starts_with('&');
        const auto first = at + 1 + is_vector;
        auto end = first;
        while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_')) ++end;
        const auto name = text.substr(first, end - first);
        const auto variable = values_.find(name);
        const auto value = is_vector ? number_of(name) : variable != values_.end() ? std::optional(variable->second) : std::nullopt;
        out += text.substr(from, at - from);
        out += value ? std::string_view(*value) : text.substr(at, end - at);
        from = end;
    }
    out += text.substr(from);
    return out;
}

}  // namespace corpuscle::circuit
