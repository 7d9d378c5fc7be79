#include "core/text/aligned_table.hpp"

#include <algorithm>
#include <numeric>
#include <sstream>
#include <string_view>

#include "core/text/printable.hpp"

namespace corpuscle {
namespace {

constexpr std::size_t max_table_width = 100;  // columns; in wider tables the heading has several lines

/// True for a number, or for a mean with its standard deviation: "9.4 +- 1.1".
bool is_number(std::string_view cell) {
    if (const auto sign = cell.find(" +- "); sign != cell.npos) return is_number(cell.substr(0, sign)) && is_number(cell.substr(sign + 4));
    return !cell.empty() && cell.find_first_not_of("0123456789.-+e") == std::string::npos;
}

/// Splits a heading at blanks and after hyphens: "Victor-", "Purpura".
std::vector<std::string> split_heading(const std::string& heading) {
    std::vector<std::string> out;
    std::istringstream input(heading);
    for (std::string word; input >> word;) {
        const auto hyphen = word.find('-', 2);
        if (hyphen != word.npos && hyphen + 2 < word.size())
            out.push_back(word.substr(0, hyphen + 1)), out.push_back(word.substr(hyphen + 1));
        else
            out.push_back(word);
    }
    return out;
}

/// Breaks the heading (the first row) of a table that is too wide into several rows. Returns the number of rows of the heading.
std::size_t wrap_heading(TableRows& rows) {
    if (rows.size() < 2) return 1;
    std::vector<std::size_t> widths(rows[0].size());
    std::size_t total = 0;
    for (std::size_t c = 0; c < rows[0].size(); ++c) {
        for (std::size_t r = 1; r < rows.size(); ++r)
            if (c < rows[r].size()) widths[c] = std::max(widths[c], columns_of(rows[r][c]));
        total += std::max(widths[c], columns_of(rows[0][c])) + (c ? 2 : 0);
    }
    if (total <= max_table_width) return 1;
    TableRows lines;
    for (std::size_t c = 0; c < rows[0].size(); ++c) {
        std::vector<std::string> parts;
        for (const auto& word : split_heading(rows[0][c])) {
            const bool joined = !parts.empty() && parts.back().ends_with('-');
            if (!parts.empty() && columns_of(parts.back()) + (joined ? 0 : 1) + columns_of(word) <= widths[c])
                parts.back() += (joined ? "" : " ") + word;
            else
                parts.push_back(word);
        }
        while (lines.size() < parts.size()) lines.emplace_back(rows[0].size());
        for (std::size_t k = 0; k < parts.size(); ++k) lines[k][c] = parts[k];
    }
    rows.erase(rows.begin());
    rows.insert(rows.begin(), lines.begin(), lines.end());
    return std::max<std::size_t>(lines.size(), 1);
}

/// Splits the columns of a table into blocks that fit a terminal. `widths`, `numeric`: for each column, its width and whether its cells are
/// numbers. Each block has the indexes of its columns. It begins with the text columns before the first numeric one, which name the rows.
std::vector<std::vector<std::size_t>> blocks_of(const std::vector<std::size_t>& widths, const std::vector<bool>& numeric) {
    const auto indices = [](std::size_t from, std::size_t to) {
        std::vector<std::size_t> out(to - from);
        std::iota(out.begin(), out.end(), from);
        return out;
    };
    // Width of the columns from `from` to `to` - 1 with two blanks after each. The last one needs none, so the limits below are
    // max_table_width + 2.
    const auto total_width = [&](std::size_t from, std::size_t to) {
        return std::accumulate(widths.begin() + static_cast<std::ptrdiff_t>(from), widths.begin() + static_cast<std::ptrdiff_t>(to),
                               std::size_t{0}, [](std::size_t total, std::size_t w) { return total + w + 2; });
    };
    const auto name_columns = static_cast<std::size_t>(std::find(numeric.begin(), numeric.end(), true) - numeric.begin());
    if (total_width(0, widths.size()) <= max_table_width + 2 || total_width(0, name_columns) > max_table_width / 2)
        return {indices(0, widths.size())};
    std::vector<std::vector<std::size_t>> blocks;
    for (std::size_t c = name_columns; c < widths.size();) {
        auto end = c + 1;
        while (end < widths.size() && total_width(0, name_columns) + total_width(c, end + 1) <= max_table_width + 2) ++end;
        auto block = indices(0, name_columns);
        for (; c < end; ++c) block.push_back(c);
        blocks.push_back(std::move(block));
    }
    return blocks;
}

}  // namespace

std::string format_table(const TableRows& raw_rows, bool has_heading) {
    auto rows = raw_rows;
    for (auto& row : rows)
        for (auto& cell : row) cell = printable(cell);
    const auto heading_rows = has_heading ? wrap_heading(rows) : 0;
    std::vector<std::size_t> widths;
    std::vector<bool> numeric;
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t c = 0; c < rows[r].size(); ++c) {
            if (widths.size() <= c) widths.push_back(0), numeric.push_back(true);
            widths[c] = std::max(widths[c], columns_of(rows[r][c]));
            if (r >= heading_rows && !rows[r][c].empty() && !is_number(rows[r][c])) numeric[c] = false;
        }
    std::string text;
    for (const auto& block : blocks_of(widths, numeric)) {
        text += text.empty() ? "" : "\n";
        for (const auto& row : rows) {
            std::string line;
            for (const auto c : block) {
                if (c >= row.size()) continue;
                const std::string pad(widths[c] - columns_of(row[c]), ' ');
                line += (c ? "  " : "") + (numeric[c] ? pad + row[c] : row[c] + pad);
            }
            line.erase(line.find_last_not_of(' ') + 1);
            text += line + "\n";
        }
    }
    return text;
}

}  // namespace corpuscle
