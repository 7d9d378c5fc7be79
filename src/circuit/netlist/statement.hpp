#pragma once
// A logical line split into words and name=value pairs.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "circuit/netlist/logical_lines.hpp"

namespace corpuscle::circuit {

/// A part of the text of a logical line.
struct Word {
    enum class Kind : std::uint8_t {
        plain,
        expression,
        quoted
    } kind = Kind::plain;            ///< expression: in {} or ''; quoted: in ""; the word does not include these characters
    std::uint32_t at = 0, size = 0;  ///< offset and length in the line's text, bytes
};

/// A pair name=value.
struct NameValue {
    Word name, value;
};

/// A logical line split into words and pairs.
struct Statement {
    LogicalLine line;
    std::vector<Word> words;
    std::vector<NameValue> pairs;

    std::string_view text(const Word& w) const { return std::string_view(line.text).substr(w.at, w.size); }
    std::string_view text(std::size_t k) const { return k < words.size() ? text(words[k]) : std::string_view(); }
    SourceLocation location(const Word& w) const { return line.location(w.at); }
    /// The location of word k, or of the end of the line if there are fewer words.
    SourceLocation location(std::size_t k) const { return line.location(k < words.size() ? words[k].at : line.text.size()); }
    /// The first pair with this name; null if there is none.
    const NameValue* find(std::string_view name) const;
};

/// Splits elements, .subckt, .model and .options. Blanks, commas and parentheses separate words; "name = value" is a pair. A value ends at
/// the next blank or comma, unless is_long_value(first letter of the line, name) is true. A long value may contain blanks and extends to
/// the next pair or the end. Null: there are no long values.
Result<Statement> split_element(LogicalLine, bool (*is_long_value)(char letter, std::string_view name));

/// Splits .param into pairs; the only word is ".param". A name may be "f(x, y)", and a value extends to the next pair.
Result<Statement> split_assignments(LogicalLine);

/// The text without the quotes around it, if there are any.
inline std::string_view unquoted(std::string_view s) {
    const bool quoted = s.size() >= 2 && (s[0] == '\'' || s[0] == '"') && s.back() == s[0];
    return quoted ? s.substr(1, s.size() - 2) : s;
}

/// Splits all other directives. Blanks and commas outside parentheses, quotes and braces separate words; "a = 3" is one word.
Result<Statement> split_directive(LogicalLine);

}  // namespace corpuscle::circuit
