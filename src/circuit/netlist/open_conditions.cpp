#include "circuit/netlist/open_conditions.hpp"

#include <algorithm>

#include "core/text/ascii_text.hpp"

namespace corpuscle::circuit {
namespace {

constexpr std::size_t max_condition_depth = 200;  // of nested .if

/// Writes == for each single = of a condition; ngspice accepts both.
void double_equals(LogicalLine& line) {
    constexpr std::size_t max_length = 10000;  // characters; the time grows with the square of the length
    if (line.text.size() > max_length) return;
    for (std::size_t k = 1; k + 1 < line.text.size(); ++k) {
        constexpr std::string_view operators = "=<>!";
        const auto is_operator = [&](std::size_t n) { return operators.find(line.text[n]) != std::string_view::npos; };
        if (line.text[k] != '=' || is_operator(k - 1) || is_operator(k + 1)) continue;
        const auto after = line.location(k + 1);
        line.text.insert(k, 1, '=');
        for (auto& segment : line.segments)
            if (segment.at > k) ++segment.at;
        const auto next = std::ranges::upper_bound(line.segments, k + 2, {}, &LogicalLine::Segment::at);
        line.segments.insert(
            next, {static_cast<std::uint32_t>(k + 2), static_cast<std::uint32_t>(after.line), static_cast<std::uint32_t>(after.column)});
        ++k;
    }
}

/// ".if", ".elseif" or ".else", with which the line begins.
std::string_view word_of(const LogicalLine& line) {
    constexpr std::string_view words[] = {".elseif", ".else", ".if"};
    const auto begin = lower(std::string_view(line.text).substr(0, words[0].size()));
    return *std::ranges::find_if(words, [&](std::string_view word) { return begin.starts_with(word); });
}

}  // namespace

Result<void> OpenConditions::check_closed() const {
    if (open_.size() > file_begin_) return error_at(open_.back().location, ".if is not closed by .endif");
    return {};
}

Result<void> OpenConditions::begin_branch(LogicalLine line, SubcktDef& body, std::deque<Statement>& statements) {
    const auto word = word_of(line);
    const bool is_if = word == ".if", is_else = word == ".else";
    if (is_if) {
        if (open_.size() >= max_condition_depth)
            return error_at(line.location(), ".if is nested deeper than the limit of {}", max_condition_depth);
        const int outer = branch();
        open_.push_back({outer, -1, false, line.location()});
    } else if (open_.size() <= file_begin_) {
        return error_at(line.location(), "{} without .if", word);
    } else if (open_.back().has_else) {
        return error_at(line.location(), "{} after .else", word);
    }
    auto& open = open_.back();
    open.has_else = is_else;
    const auto from = std::min(line.text.find_first_not_of(" \t", word.size()), line.text.size());
    if (!is_else) {
        double_equals(line);
        if (from == line.text.size()) return error_at(line.location(from), "{}: expected a condition, such as {} (x > 1)", word, word);
    }
    const Statement& s = statements.emplace_back(Statement{std::move(line), {}, {}});
    Condition condition{open.outer, open.branch, &s};
    if (!is_else)
        condition.text =
            WordRef{&s, {Word::Kind::expression, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(s.line.text.size() - from)}};
    body.conditions.push_back(std::move(condition));
    open.branch = static_cast<int>(body.conditions.size()) - 1;
    return {};
}

Result<void> OpenConditions::close(SourceLocation location) {
    if (open_.size() <= file_begin_) return error_at(std::move(location), ".endif without .if");
    open_.pop_back();
    return {};
}

}  // namespace corpuscle::circuit
