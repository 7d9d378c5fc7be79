#pragma once
// The logical lines of a netlist, split into words and name=value pairs. Comments are removed, and a line is joined with the physical lines
// that continue it. The location of each byte in the file is kept.

#include <cstdint>

#include "circuit/error_at.hpp"

namespace corpuscle::circuit {

/// A logical line in small letters, except for text in double quotes and for lines that name files.
struct LogicalLine {
    /// From offset `at` on, the text comes from this physical line and column of the file, both counted from 1.
    struct Segment {
        std::uint32_t at, line, column;
    };
    std::string text;
    std::vector<Segment> segments;            ///< in order of their offsets
    std::shared_ptr<const std::string> file;  ///< path; null if the line was not read from a file

    std::vector<std::uint32_t> capitals;  ///< offsets of capital F and M, which users often take for farad and mega
    std::string drawing_note = {};        ///< the first note of CDL about the drawing, " $X=100", which is not in the text; "": none

    /// The location in the file of the character at this offset of the text.
    SourceLocation location(std::size_t at = 0) const;
    /// True if the character at this offset was a capital F or M in the file.
    bool was_capital(std::size_t at) const;
};

/// Reads the logical lines of a file one at a time.
class LogicalLineReader {
    std::shared_ptr<const std::string> file_;
    std::string_view rest_;       // the text that is not read yet
    std::string_view last_;       // rest_ before the last call of take(), for put_back()
    std::uint32_t number_ = 0;    // number of the physical line that was taken last, from 1
    LogicalLine next_;            // the logical line being read; further physical lines may continue it
    char quote_ = 0;              // the quote that is open at the end of next_; 0 if no quote is open
    std::uint32_t quote_at_ = 0;  // its offset in next_.text
    bool has_next_ = false;       // true if next_ has begun
    char line_end_ = '\n';

public:
    LogicalLineReader(std::string_view text, std::shared_ptr<const std::string> file);

    /// Reads the first line, which is the title in the main file of a netlist, as UTF-8. Call it before next().
    Result<std::string> title();
    /// Reads the next logical line. Returns false at the end of the file.
    Result<bool> next(LogicalLine&);
    /// Reads the next physical line, a command of a .control block, as if it were a directive: with a dot before it. Returns false at the
    /// end of the file.
    bool next_command(LogicalLine&);

private:
    bool take(std::string_view& physical);  // reads the next physical line; false at the end of the file
    void put_back();                        // undoes the last take()
    Result<void> append(std::string_view physical, std::size_t from);
    Result<void> finish_line(LogicalLine&);
};

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
    int condition = -1;                   ///< index in SubcktDef::conditions; the statement holds if this branch of .if does; -1: always
    const Statement* analysis = nullptr;  ///< of a print or meas of a script: the analysis to which it applies; null: any

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

/// Returns an error if two pairs of a line have the same name.
Result<void> check_duplicates(const Statement&);

/// "file:line" of a statement.
std::string location_text(const Statement&);

/// True for the characters of a name.
inline bool is_name_character(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == ':'; }

/// Splits all other directives. Blanks and commas outside parentheses, quotes and braces separate words; "a = 3" is one word.
Result<Statement> split_directive(LogicalLine);

}  // namespace corpuscle::circuit
