#include "io/python_literal.hpp"

#include <charconv>

namespace corpuscle {
namespace {

class Parser {
    std::string_view text_;
    std::size_t at_ = 0;

    void pass_blanks() {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    }

    bool pass(std::string_view word) {
        pass_blanks();
        if (!text_.substr(at_).starts_with(word)) return false;
        at_ += word.size();
        return true;
    }

    std::optional<Python> quoted(char quote) {
        const auto end = text_.find(quote, at_);
        if (end == std::string_view::npos) return {};
        Python out{Python::text, std::string(text_.substr(at_, end - at_))};
        at_ = end + 1;
        return out;
    }

    std::optional<Python> whole_number() {
        Python out{Python::integer};
        const auto [end, status] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), out.number);
        if (status != std::errc{}) return {};
        at_ = static_cast<std::size_t>(end - text_.data());
        pass("L");  // Python 2
        return out;
    }

    /// Values and commas up to `close`; a dictionary has a colon in each pair.
    std::optional<Python> several(Python::Kind kind, std::string_view close, int depth) {
        Python out{kind};
        while (!pass(close)) {
            if (!out.items.empty() && !pass(kind == Python::dictionary && out.items.size() % 2 ? ":" : ",")) return {};
            if (pass(close)) break;  // a comma before the end
            auto item = value(depth + 1);
            if (!item) return {};
            out.items.push_back(*std::move(item));
        }
        return out;
    }

    std::optional<Python> any(int depth) {
        if (depth > 8) return {};
        if (pass("'")) return quoted('\'');
        if (pass("\"")) return quoted('"');
        if (pass("True")) return Python{Python::truth, {}, 1};
        if (pass("False")) return Python{Python::truth};
        if (pass("(")) return several(Python::list, ")", depth);
        if (pass("[")) return several(Python::list, "]", depth);
        if (pass("{")) return several(Python::dictionary, "}", depth);
        return whole_number();
    }

public:
    explicit Parser(std::string_view text) : text_(text) {}

    std::optional<Python> value(int depth) {
        pass_blanks();
        const auto from = at_;
        auto out = any(depth);
        if (out) out->source = text_.substr(from, at_ - from);
        return out;
    }

    bool ended() {
        pass_blanks();
        return at_ == text_.size();
    }
};

}  // namespace

std::optional<Python> parse_python(std::string_view text) {
    Parser parser(text);
    auto out = parser.value(0);
    return parser.ended() ? out : std::nullopt;
}

}  // namespace corpuscle
