#include "reproduction/data/study_expression.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "circuit/expression/expression_operations.hpp"
#include "circuit/expression/spice_number.hpp"
#include "reproduction/data/study_functions.hpp"

namespace corpuscle {
namespace {

struct StudyOperator {
    std::string_view text, function;  ///< the name that call_study_function has for it
    int level;                        ///< a higher level binds more tightly
};
// An operator that begins with another one must precede it.
constexpr StudyOperator study_operators[] = {{"||", "||", 1}, {"&&", "&&", 2}, {"==", "==", 3}, {"!=", "!=", 3},
                                             {"<=", "<=", 4}, {">=", ">=", 4}, {"<", "<", 4},   {">", ">", 4},
                                             {"+", "+", 5},   {"-", "-", 5},   {"*", "*", 6},   {"/", "/", 6}};

/// Reads an expression and computes its value on the way. After an error the rest of the text is skipped, and the value has no meaning.
class StudyExpressionReader {
    std::string_view text_;
    const SourceLocation& location_;
    const StudyLookup& lookup_;
    std::size_t at_ = 0;
    std::optional<Error> error_;

public:
    StudyExpressionReader(std::string_view text, const SourceLocation& location, const StudyLookup& lookup)
        : text_(text), location_(location), lookup_(lookup) {}

    Result<StudyValue> read() {
        auto value = choice();
        skip_blanks();
        if (at_ < text_.size()) fail(fmt::format("expected an operator or the end, not '{}'", text_.substr(at_, 12)));
        if (error_) return *error_;
        return value;
    }

private:
    StudyValue fail(const std::string& message) {
        if (!error_) error_ = bad_input(fmt::format("'{}': {}", text_, message), location_);
        at_ = text_.size();
        return 0.0;
    }
    StudyValue value_or_fail(Result<StudyValue> value) {
        if (value) return std::move(*value);
        if (!value.error().location.file.empty() && !error_) error_ = value.error();  // the definition of a name has the error
        return fail(value.error().message);
    }
    StudyValue call(std::string_view name, const std::vector<StudyValue>& arguments) {
        if (error_) return 0.0;
        return value_or_fail(call_study_function(name, arguments));
    }

    std::string text_here() const { return at_ < text_.size() ? fmt::format("'{}'", text_.substr(at_, 12)) : "the end"; }
    void skip_blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
    }
    bool take(char c) {
        skip_blanks();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    void expect(char c) {
        if (!take(c)) fail(fmt::format("expected '{}' before {}", c, text_here()));
    }
    static bool in_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
    std::string name_here() {
        skip_blanks();
        const auto from = at_;
        while (at_ < text_.size() && in_name(text_[at_])) ++at_;
        return std::string(text_.substr(from, at_ - from));
    }
    const StudyOperator* peek_operator() {
        skip_blanks();
        for (const auto& candidate : study_operators)
            if (text_.substr(at_).starts_with(candidate.text)) return &candidate;
        return nullptr;
    }

    /// c ? a : b
    StudyValue choice() {
        auto condition = chain(1);
        if (!take('?')) return condition;
        const auto yes = choice();
        expect(':');
        const auto no = choice();
        if (!std::holds_alternative<double>(condition)) return fail("the condition before '?' must be a number");
        return std::get<double>(condition) != 0 ? yes : no;
    }

    /// Binary operators of this level and higher ones, from left to right.
    StudyValue chain(int level) {
        auto left = signed_value();
        for (const auto* found = peek_operator(); found && found->level >= level; found = peek_operator()) {
            at_ += found->text.size();
            const auto right = chain(found->level + 1);
            left = call(found->function, {left, right});
        }
        return left;
    }

    StudyValue signed_value() {
        if (take('-')) return call("-", {signed_value()});
        if (take('!')) return call("!", {signed_value()});
        return postfix(operand());
    }

    StudyValue operand() {
        skip_blanks();
        if (take('(')) {
            auto value = choice();
            expect(')');
            return value;
        }
        if (take('[')) return list();
        if (const auto number = circuit::parse_leading_number(text_.substr(at_))) {
            at_ += number->length;
            return number->value;
        }
        const auto name = name_here();
        if (name.empty()) return fail(fmt::format("expected a value before {}", text_here()));
        if (is_result_kind(name) && at_ < text_.size() && text_[at_] == '[')
            return select(value_or_fail(lookup_("run")), name);  // of the only run, which has no name
        if (at_ < text_.size() && text_[at_] == '(') return call(name, arguments({}));
        return value_or_fail(lookup_(name));
    }

    StudyValue list() {
        StudyList out;
        do {
            const auto value = choice();
            if (!std::holds_alternative<double>(value)) return fail("the elements of a list must be numbers");
            out.push_back(std::get<double>(value));
        } while (take(','));
        expect(']');
        return out;
    }

    /// The arguments in parentheses, after those that are given.
    std::vector<StudyValue> arguments(std::vector<StudyValue> out) {
        expect('(');
        if (take(')')) return out;
        do out.push_back(choice());
        while (take(','));
        expect(')');
        return out;
    }

    /// .name, .name(arguments) and .kind[name], as often as they follow.
    StudyValue postfix(StudyValue value) {
        while (take('.')) {
            const auto name = name_here();
            if (at_ < text_.size() && text_[at_] == '[')
                value = select(value, name);
            else if (at_ < text_.size() && text_[at_] == '(')
                value = call(name, arguments({value}));
            else
                value = call(name, {value});
        }
        return value;
    }

    StudyValue select(const StudyValue& from, std::string_view kind) {
        const auto close = text_.find(']', at_);
        if (error_ || close == std::string_view::npos) return fail("this '[' is not closed");
        const std::string name(text_.substr(at_ + 1, close - at_ - 1));
        at_ = close + 1;
        return value_or_fail(select_result(from, kind, name));
    }
};

/// The position of the colon before the format in "expression:format"; npos without a format.
std::size_t format_colon(std::string_view field) {
    const auto colon = field.rfind(':');
    if (colon == std::string_view::npos) return colon;
    return field.find_first_not_of("+.0123456789efg", colon + 1) == std::string_view::npos ? colon : std::string_view::npos;
}

/// The value of "expression:format" as text.
Result<std::string> field_text(std::string_view field, const SourceLocation& location, const StudyLookup& lookup) {
    const auto colon = format_colon(field);
    const auto value = TRY(evaluate_study_expression(field.substr(0, colon), location, lookup));
    const std::string format(colon == std::string_view::npos ? "" : field.substr(colon + 1));
    if (const auto* number = std::get_if<double>(&value)) return fmt::format(fmt::runtime("{:" + format + "}"), *number);
    if (const auto* word = std::get_if<std::string>(&value)) return *word;
    return bad_input(fmt::format("{{{}}} is {}; a text can contain only numbers and texts", field, kind_of(value).name), location);
}

}  // namespace

Result<StudyValue> evaluate_study_expression(std::string_view text, const SourceLocation& location, const StudyLookup& lookup) {
    return StudyExpressionReader(text, location, lookup).read();
}

Result<std::string> fill_study_text(std::string_view text, const SourceLocation& location, const StudyLookup& lookup) {
    std::string out;
    for (auto brace = text.find_first_of("{}"); brace != std::string_view::npos; brace = text.find_first_of("{}")) {
        out += text.substr(0, brace);
        if (text.substr(brace, 2) == "{{" || text.substr(brace, 2) == "}}") {
            out += text[brace];
            text.remove_prefix(brace + 2);
            continue;
        }
        const auto close = text.find('}', brace);
        if (text[brace] == '}' || close == std::string_view::npos)
            return bad_input("this text has a '{' without '}' or the reverse; write {{ or }} for a brace", location);
        const auto value = field_text(text.substr(brace + 1, close - brace - 1), location, lookup);
        if (!value) return value;
        out += *value;
        text.remove_prefix(close + 1);
    }
    return out += text;
}

}  // namespace corpuscle
