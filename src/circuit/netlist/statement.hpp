#pragma once
// A logical line as words and name=value pairs.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "circuit/netlist/lines.hpp"

namespace corpuscle::circuit {

/// A part of a line's text.
struct Word {
    enum class Kind : std::uint8_t { plain, formula, quoted } kind = Kind::plain;  ///< formula: in {} or '', which are not part of it
    std::uint32_t at = 0, size = 0;
};

struct Named {
    Word name, value;
};

struct Statement {
    Line line;
    std::vector<Word> words;
    std::vector<Named> named;

    std::string_view text(const Word& w) const { return std::string_view(line.text).substr(w.at, w.size); }
    std::string_view text(std::size_t k) const { return k < words.size() ? text(words[k]) : std::string_view(); }
    Place place(const Word& w) const { return line.place(w.at); }
    /// Of the word, or of the line's end if there are fewer.
    Place place(std::size_t k) const { return line.place(k < words.size() ? words[k].at : line.text.size()); }
    const Named* find(std::string_view name) const;
};

/// Elements, .subckt and .model: blanks, commas and parentheses part words; "name = value" is a pair. A value goes on to the next blank
/// or comma, but for those that `whole` says: these go on to the next pair or the end, blanks and all.
Result<Statement> element_statement(Line, bool (*whole)(char letter, std::string_view name));

/// .param: nothing but pairs, of which names may be "f(x, y)" and values go on to the next pair.
Result<Statement> assignments(Line);

/// A word without the quotes about it.
inline std::string_view unquoted(std::string_view s) {
    const bool quoted = s.size() >= 2 && (s[0] == '\'' || s[0] == '"') && s.back() == s[0];
    return quoted ? s.substr(1, s.size() - 2) : s;
}

/// All other dot lines: blanks and commas outside parentheses, quotes and braces part words; "a = 3" is one word.
Result<Statement> command_statement(Line);

}  // namespace corpuscle::circuit
