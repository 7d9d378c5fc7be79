#include "circuit/netlist/statement.hpp"

#include <fmt/format.h>

namespace corpuscle::circuit {
namespace {

bool blank(char c) { return c == ' ' || c == '\t'; }
bool in_name(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == ':'; }

/// Goes through a line's text.
class Cursor {
    const Line& line_;
    std::string_view s_;

public:
    std::size_t at = 0;
    explicit Cursor(const Line& line) : line_(line), s_(line.text) {}

    bool done() const { return at >= s_.size(); }
    char here() const { return done() ? '\0' : s_[at]; }
    std::string_view text() const { return s_; }
    void skip(std::string_view these) { at = std::min(s_.find_first_not_of(these, at), s_.size()); }
    Error wrong(std::string sentence, std::size_t where) const { return bad_input(std::move(sentence), line_.place(where)); }

    /// Whether '=' here gives a value, rather than being part of == <= >= !=.
    bool gives(std::size_t k) const {
        if (k >= s_.size() || s_[k] != '=') return false;
        if (k + 1 < s_.size() && s_[k + 1] == '=') return false;
        return k == 0 || std::string_view("=<>!~").find(s_[k - 1]) == std::string_view::npos;
    }

    /// Past the group that opens here: ( ) { } with what is nested in them, or quotes.
    Result<std::size_t> past_group() const {
        std::string open;
        for (std::size_t k = at; k < s_.size(); ++k) {
            const char c = s_[k];
            if (c == '\'' || c == '"')
                k = std::min(s_.find(c, k + 1), s_.size() - 1);
            else if (c == '(' || c == '{')
                open += c;
            else if (c == ')' || c == '}') {
                if (open.empty() || (open.back() == '(') != (c == ')')) return wrong(fmt::format("this '{}' closes nothing", c), k);
                open.pop_back();
            }
            if (open.empty()) return k + 1;
        }
        return wrong(fmt::format("this '{}' is not closed", s_[at]), at);
    }
    bool opens() const { return here() == '(' || here() == '{' || here() == '\'' || here() == '"'; }

    /// Past what ends at a blank, a comma or a parenthesis that closes nothing here.
    Result<std::size_t> past_value() const {
        Cursor c = *this;
        while (!c.done() && !blank(c.here()) && c.here() != ',' && c.here() != ')' && !c.gives(c.at)) {
            if (!c.opens()) {
                ++c.at;
                continue;
            }
            auto end = c.past_group();
            if (!end) return end;
            c.at = *end;
        }
        return c.at;
    }

    /// Past what ends where the next pair begins.
    Result<std::size_t> past_whole() const {
        Cursor c = *this;
        while (!c.done()) {
            if (c.gives(c.at)) return name_before(c.at);
            if (!c.opens()) {
                ++c.at;
                continue;
            }
            auto end = c.past_group();
            if (!end) return end;
            c.at = *end;
        }
        return c.at;
    }

private:
    /// Where the name begins that stands before the '=' at k: "a" or "f(x, y)".
    std::size_t name_before(std::size_t k) const {
        const auto back_over = [&](auto&& is) {
            while (k > at && is(s_[k - 1])) --k;
        };
        back_over(blank);
        if (k > at && s_[k - 1] == ')') {
            back_over([](char c) { return c != '('; });
            if (k > at) --k;
        }
        back_over(in_name);
        return k;
    }
};

Word word(std::size_t from, std::size_t to, Word::Kind kind = Word::Kind::plain) {
    return {kind, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to - from)};
}

/// The text between, without blanks about it; a formula without the braces or quotes it stands in.
Word value_word(std::string_view s, std::size_t from, std::size_t to) {
    while (to > from && (blank(s[to - 1]) || s[to - 1] == ',')) --to;
    if (to - from < 2) return word(from, to);
    const char open = s[from], close = s[to - 1];
    const auto inside = s.substr(from + 1, to - from - 2);
    if (open == '"' && close == '"' && inside.find('"') == std::string_view::npos) return word(from + 1, to - 1, Word::Kind::quoted);
    const bool quoted = open == '\'' && close == '\'' && inside.find('\'') == std::string_view::npos;
    const bool braced = open == '{' && close == '}' && inside.find_first_of("{}") == std::string_view::npos;
    return quoted || braced ? word(from + 1, to - 1, Word::Kind::formula) : word(from, to);
}

Result<Word> value_here(Cursor& c, bool whole) {
    c.skip(" \t");
    const auto from = c.at;
    const auto end = whole ? c.past_whole() : c.past_value();
    if (!end) return end.error();
    c.at = *end;
    const Word value = value_word(c.text(), from, c.at);
    if (value.size == 0) return c.wrong("'=' without a value behind it", from > 0 ? from - 1 : 0);
    return value;
}

/// Counts the parentheses that part words: each must have its other.
Result<void> skip_separators(Cursor& c, std::vector<std::size_t>& open) {
    for (; !c.done() && (blank(c.here()) || c.here() == ',' || c.here() == '(' || c.here() == ')'); ++c.at) {
        if (c.here() == '(') open.push_back(c.at);
        if (c.here() != ')') continue;
        if (open.empty()) return c.wrong("this ')' closes nothing", c.at);
        open.pop_back();
    }
    return {};
}

Result<Word> plain_or_group(Cursor& c) {
    const auto from = c.at;
    if (c.opens()) {
        const auto end = c.past_group();
        if (!end) return end.error();
        c.at = *end;
        return value_word(c.text(), from, c.at);
    }
    while (!c.done() && !blank(c.here()) && c.here() != ',' && c.here() != ')' && !c.opens() && !c.gives(c.at)) ++c.at;
    return word(from, c.at);
}

}  // namespace

const Named* Statement::find(std::string_view name) const {
    for (const auto& pair : named)
        if (text(pair.name) == name) return &pair;
    return nullptr;
}

Result<Statement> element_statement(Line line, bool (*whole)(char, std::string_view)) {
    Statement s{std::move(line), {}, {}};
    Cursor c(s.line);
    std::vector<std::size_t> open;
    while (true) {
        if (const auto ok = skip_separators(c, open); !ok) return ok.error();
        if (c.done()) break;
        if (c.gives(c.at)) return c.wrong("'=' without a name before it", c.at);
        const auto first = plain_or_group(c);
        if (!first) return first.error();
        const auto after = c.at;
        c.skip(" \t");
        if (!c.gives(c.at)) {
            c.at = after;
            s.words.push_back(*first);
            continue;
        }
        ++c.at;
        const auto value = value_here(c, whole && whole(s.line.text[0], s.text(*first)));
        if (!value) return value.error();
        s.named.push_back({*first, *value});
    }
    if (!open.empty()) return c.wrong("this '(' is not closed", open.back());
    return s;
}

Result<Statement> assignments(Line line) {
    Statement s{std::move(line), {}, {}};
    Cursor c(s.line);
    while (!c.done() && !blank(c.here())) ++c.at;
    s.words.push_back(word(0, c.at));
    for (c.skip(" \t,"); !c.done(); c.skip(" \t,")) {
        const auto from = c.at;
        while (!c.done() && in_name(c.here())) ++c.at;
        auto to = c.at;
        c.skip(" \t");
        if (c.here() == '(') {
            const auto end = c.past_group();
            if (!end) return end.error();
            to = c.at = *end;
            c.skip(" \t");
        }
        if (!c.gives(c.at) || to == from) return c.wrong("expected name=value here", from);
        ++c.at;
        const auto value = value_here(c, true);
        if (!value) return value.error();
        s.named.push_back({word(from, to), *value});
    }
    return s;
}

Result<Statement> command_statement(Line line) {
    Statement s{std::move(line), {}, {}};
    Cursor c(s.line);
    for (c.skip(" \t,"); !c.done(); c.skip(" \t,")) {
        const auto from = c.at;
        while (!c.done()) {
            if (c.opens()) {
                const auto end = c.past_group();
                if (!end) return end.error();
                c.at = *end;
            } else if (c.gives(c.at) && c.at > from) {
                ++c.at;
                c.skip(" \t");
                continue;
            } else if (blank(c.here())) {  // a blank before '=' is not the word's end
                const auto end = c.at;
                c.skip(" \t");
                if (c.gives(c.at)) continue;
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

}  // namespace corpuscle::circuit
