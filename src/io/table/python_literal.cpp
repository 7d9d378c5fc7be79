#include "io/table/python_literal.hpp"

#include <charconv>

namespace corpuscle {
namespace {

class Parser {
    std::string_view text_;
    std::size_t at_ = 0;

    void skip_blanks() {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    }

    /// Moves past blanks, and past `word` if it comes next. Returns false if it does not.
    bool accept(std::string_view word) {
        skip_blanks();
        if (!text_.substr(at_).starts_with(word)) return false;
        at_ += word.size();
        return true;
    }

    /// Parses the rest of a string, after its first quote. Escapes are not supported.
    std::optional<PythonLiteral> quoted(char quote) {
        const auto end = text_.find(quote, at_);
        if (end == std::string_view::npos) return {};
        PythonLiteral out{PythonLiteral::text, std::string(text_.substr(at_, end - at_))};
        at_ = end + 1;
        return out;
    }

    std::optional<PythonLiteral> integer() {
        PythonLiteral out{PythonLiteral::integer};
        const auto [end, status] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), out.number);
        if (status != std::errc{}) return {};
        at_ = static_cast<std::size_t>(end - text_.data());
        accept("L");  // Python 2 writes long integers as 12L
        return out;
    }

    /// Parses values separated by commas up to the bracket `close`. A dictionary has a colon after each key.
    std::optional<PythonLiteral> sequence(PythonLiteral::Kind kind, std::string_view close, int depth) {
        PythonLiteral out{kind};
        while (!accept(close)) {
            if (!out.items.empty() && !accept(kind == PythonLiteral::dictionary && out.items.size() % 2 ? ":" : ",")) return {};
            if (accept(close)) break;  // a trailing comma
            auto item = value(depth + 1);
            if (!item) return {};
            out.items.push_back(*std::move(item));
        }
        return out;
    }

    /// `depth` is the number of brackets around the literal.
    std::optional<PythonLiteral> literal(int depth) {
        if (depth > 8) return {};
        if (accept("'")) return quoted('\'');
        if (accept("\"")) return quoted('"');
        if (accept("True")) return PythonLiteral{PythonLiteral::boolean, {}, 1};
        if (accept("False")) return PythonLiteral{PythonLiteral::boolean};
        if (accept("(")) return sequence(PythonLiteral::list, ")", depth);
        if (accept("[")) return sequence(PythonLiteral::list, "]", depth);
        if (accept("{")) return sequence(PythonLiteral::dictionary, "}", depth);
        return integer();
    }

public:
    explicit Parser(std::string_view text) : text_(text) {}

    /// Parses a literal and stores its text.
    std::optional<PythonLiteral> value(int depth) {
        skip_blanks();
        const auto from = at_;
        auto out = literal(depth);
        if (out) out->source = text_.substr(from, at_ - from);
        return out;
    }

    bool ended() {
        skip_blanks();
        return at_ == text_.size();
    }
};

}  // namespace

std::optional<PythonLiteral> parse_python_literal(std::string_view text) {
    Parser parser(text);
    auto out = parser.value(0);
    return parser.ended() ? out : std::nullopt;
}

}  // namespace corpuscle
