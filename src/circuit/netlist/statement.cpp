#include "circuit/netlist/statement.hpp"

namespace corpuscle::circuit {
namespace {

bool is_blank_char(char c) { return c == ' ' || c == '\t'; }

/// A position in the text of a line.
class Cursor {
    const LogicalLine& line_;
    std::string_view s_;

public:
    std::size_t at = 0;
    explicit Cursor(const LogicalLine& line) : line_(line), s_(line.text) {}

    bool done() const { return at >= s_.size(); }
    char here() const { return done() ? '\0' : s_[at]; }
    std::string_view text() const { return s_; }
    void skip(std::string_view characters) { at = std::min(s_.find_first_not_of(characters, at), s_.size()); }
    template <class... Arguments>
    Error error_at(std::size_t offset, fmt::format_string<Arguments...> message, Arguments&&... arguments) const {
        return circuit::error_at(line_.location(offset), message, std::forward<Arguments>(arguments)...);
    }

    /// True if character k is an '=' that assigns, not a part of == <= >= !=.
    bool is_assignment(std::size_t k) const {
        if (k >= s_.size() || s_[k] != '=') return false;
        if (k + 1 < s_.size() && s_[k + 1] == '=') return false;
        return k == 0 || std::string_view("=<>!~").find(s_[k - 1]) == std::string_view::npos;
    }

    /// The offset after the group that opens here. A group is ( ) or { } with nested groups, or a quoted text.
    Result<std::size_t> past_group() const {
        std::string open;
        for (std::size_t k = at; k < s_.size(); ++k) {
            const char c = s_[k];
            if (c == '\'' || c == '"')
                k = std::min(s_.find(c, k + 1), s_.size() - 1);
            else if (c == '(' || c == '{')
                open += c;
            else if (c == ')' || c == '}') {
                if (open.empty() || (open.back() == '(') != (c == ')')) return error_at(k, "unmatched '{}'", c);
                open.pop_back();
            }
            if (open.empty()) return k + 1;
        }
        return error_at(at, "this '{}' is not closed", s_[at]);
    }
    bool opens_group() const { return here() == '(' || here() == '{' || here() == '\'' || here() == '"'; }

    /// Moves over characters and groups until stops() is true, or to the end.
    template <class Stops>
    Result<void> move_until(const Stops& stops) {
        while (!done() && !stops()) at = opens_group() ? TRY(past_group()) : at + 1;
        return {};
    }
    /// Moves over a value that ends at a blank, a comma, an unmatched parenthesis or an assignment.
    Result<void> move_over_value() {
        return move_until([this] { return is_blank_char(here()) || here() == ',' || here() == ')' || is_assignment(at); });
    }
    /// Moves over a value that ends where the next pair begins.
    Result<void> move_over_long_value() {
        const auto from = at;
        TRY(move_until([this] { return is_assignment(at); }));
        if (!done()) at = name_before(at, from);
        return {};
    }

private:
    /// The offset of the name before the '=' at offset k, at `from` or later: "a" or "f(x, y)".
    std::size_t name_before(std::size_t k, std::size_t from) const {
        const auto skip_back = [&](auto&& is) {
            while (k > from && is(s_[k - 1])) --k;
        };
        skip_back(is_blank_char);
        if (k > from && s_[k - 1] == ')') {
            skip_back([](char c) { return c != '('; });
            if (k > from) --k;
        }
        skip_back(is_name_character);
        return k;
    }
};

Word word(std::size_t from, std::size_t to, Word::Kind kind = Word::Kind::plain) {
    return {kind, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from)};
}

/// The text between two offsets, without blanks and commas at its end; an expression without its braces or quotes.
Word value_word(std::string_view s, std::size_t from, std::size_t to) {
    while (to > from && (is_blank_char(s[to - 1]) || s[to - 1] == ',')) --to;
    if (to - from < 2) return word(from, to);
    const char open = s[from], close = s[to - 1];
    const auto inside = s.substr(from + 1, to - from - 2);
    if (open == '"' && close == '"' && inside.find('"') == std::string_view::npos) return word(from + 1, to - 1, Word::Kind::quoted);
    const bool is_quoted = open == '\'' && close == '\'' && inside.find('\'') == std::string_view::npos;
    const bool is_braced = open == '{' && close == '}' && inside.find_first_of("{}") == std::string_view::npos;
    return is_quoted || is_braced ? word(from + 1, to - 1, Word::Kind::expression) : word(from, to);
}

Result<Word> read_value(Cursor& c, bool is_long) {
    c.skip(" \t");
    const auto from = c.at;
    TRY(is_long ? c.move_over_long_value() : c.move_over_value());
    const Word value = value_word(c.text(), from, c.at);
    if (value.size == 0) return c.error_at(from > 0 ? from - 1 : 0, "'=' without a value after it");
    return value;
}

/// Skips separators and checks that separating parentheses are balanced. `open` has the offsets of those that are open.
Result<void> skip_separators(Cursor& c, std::vector<std::size_t>& open) {
    for (; !c.done() && (is_blank_char(c.here()) || c.here() == ',' || c.here() == '(' || c.here() == ')'); ++c.at) {
        if (c.here() == '(') open.push_back(c.at);
        if (c.here() != ')') continue;
        if (open.empty()) return c.error_at(c.at, "unmatched ')'");
        open.pop_back();
    }
    return {};
}

/// Reads a plain word or a group.
Result<Word> plain_or_group(Cursor& c) {
    const auto from = c.at;
    if (c.opens_group()) {
        c.at = TRY(c.past_group());
        return value_word(c.text(), from, c.at);
    }
    while (!c.done() && !is_blank_char(c.here()) && c.here() != ',' && c.here() != ')' && !c.opens_group() && !c.is_assignment(c.at))
        ++c.at;
    return word(from, c.at);
}

}  // namespace

const NameValue* Statement::find(std::string_view name) const {
    for (const auto& pair : pairs)
        if (text(pair.name) == name) return &pair;
    return nullptr;
}

Result<Statement> split_element(LogicalLine line, bool (*is_long_value)(char, std::string_view)) {
    Statement s{std::move(line), {}, {}};
    Cursor c(s.line);
    std::vector<std::size_t> open;
    while (true) {
        TRY(skip_separators(c, open));
        if (c.done()) break;
        if (c.is_assignment(c.at)) return c.error_at(c.at, "'=' without a name before it");
        const auto first = TRY(plain_or_group(c));
        const auto after = c.at;
        c.skip(" \t");
        if (!c.is_assignment(c.at)) {
            c.at = after;
            s.words.push_back(first);
            continue;
        }
        if (s.words.empty()) return c.error_at(c.at, "unexpected '=' after '{}'; to define a parameter: .param name=value", s.text(first));
        ++c.at;
        const auto value = TRY(read_value(c, is_long_value && is_long_value(s.line.text[0], s.text(first))));
        s.pairs.push_back({first, value});
    }
    if (!open.empty()) return c.error_at(open.back(), "this '(' is not closed");
    return s;
}

Result<Statement> split_assignments(LogicalLine line) {
    Statement s{std::move(line), {}, {}};
    Cursor c(s.line);
    while (!c.done() && !is_blank_char(c.here())) ++c.at;
    s.words.push_back(word(0, c.at));
    for (c.skip(" \t,"); !c.done(); c.skip(" \t,")) {
        const auto from = c.at;
        while (!c.done() && is_name_character(c.here())) ++c.at;
        auto to = c.at;
        c.skip(" \t");
        if (c.here() == '(') {
            const auto end = TRY(c.past_group());
            to = c.at = end;
            c.skip(" \t");
        }
        if (!c.is_assignment(c.at) || to == from) return c.error_at(from, "expected name=value here");
        ++c.at;
        const auto value = TRY(read_value(c, true));
        s.pairs.push_back({word(from, to), value});
    }
    return s;
}

Result<Statement> split_directive(LogicalLine line) {
    Statement s{std::move(line), {}, {}};
    Cursor c(s.line);
    for (c.skip(" \t,"); !c.done(); c.skip(" \t,")) {
        const auto from = c.at;
        while (!c.done()) {
            if (c.opens_group()) {
                c.at = TRY(c.past_group());
            } else if (c.is_assignment(c.at) && c.at > from) {
                ++c.at;
                c.skip(" \t");
                continue;
            } else if (is_blank_char(c.here())) {  // a blank before '=' does not end the word
                const auto end = c.at;
                c.skip(" \t");
                if (c.is_assignment(c.at)) continue;
                c.at = end;
                break;
            } else if (c.here() == ',') {
                break;
            } else {
                ++c.at;
            }
        }
        s.words.push_back(word(from, c.at));
    }
    return s;
}

Result<void> check_duplicates(const Statement& s) {
    if (s.words.empty()) return error_at(s.line.location(), "the name before '=' is missing");
    std::vector<std::string_view> names;
    for (const auto& pair : s.pairs) names.push_back(s.text(pair.name));
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice == names.end()) return {};
    SourceLocation location;
    for (const auto& pair : s.pairs)
        if (s.text(pair.name) == *twice) location = s.location(pair.name);
    return error_at(location, "{}: {} is given twice", s.text(0), *twice);
}

std::string location_text(const Statement& s) {
    const SourceLocation p = s.line.location();
    return fmt::format("{}:{}", p.file, p.line);
}

}  // namespace corpuscle::circuit
