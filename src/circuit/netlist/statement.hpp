#pragma once
// A logical line split into words and name=value pairs.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "circuit/netlist/logical_lines.hpp"

namespace corpuscle::circuit {

/// A part of the text of a line.
struct Word {
    enum class Kind : std::uint8_t {
        plain,
        expression,
        quoted
    } kind = Kind::plain;            ///< expression: in {} or '', which the word does not include
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
    const NameValue* find(std::string_view name) const;
};

/// Splits elements, .subckt and .model. Blanks, commas and parentheses separate words; "name = value" is a pair. A value ends at the next
/// blank or comma, unless `is_long_value` is true for its name. A long value may contain blanks and extends to the next pair or the end.
Result<Statement> split_element(LogicalLine, bool (*is_long_value)(char letter, std::string_view name));

/// Splits .param into pairs. A name may be "f(x, y)", and a value extends to the next pair.
Result<Statement> split_assignments(LogicalLine);

/// The word without its quotes.
inline std::string_view unquoted(std::string_view s) {
    const bool quoted = s.size() >= 2 && (s[0] == '\'' || s[0] == '"') && s.back() == s[0];
    return quoted ? s.substr(1, s.size() - 2) : s;
}

/// Splits all other directives. Blanks and commas outside parentheses, quotes and braces separate words; "a = 3" is one word.
Result<Statement> split_directive(LogicalLine);

}  // namespace corpuscle::circuit
