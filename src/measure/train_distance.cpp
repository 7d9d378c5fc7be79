#include "measure/train_distance.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "signal/elementary.hpp"

namespace corpuscle {
namespace {

/// The saving of an alignment, compared with removing all spikes of one train and adding all spikes of the other: 2 - q |dt| for each
/// move. The best saving is computed in a table with a row for each spike of a and a column for each spike of b. In a row only the columns
/// are computed in which a move saves something. Columns before these keep their value; columns after these have the last value.
class Savings {
    std::span<const double> a_, b_;
    double q_;
    std::vector<double> best_;  // best_[j]: the best saving for a[0 .. i) and b[0 .. j); valid up to known_
    std::size_t known_ = 0;

public:
    enum Choice : unsigned char { skip_a, skip_b, move };
    struct RowRange {
        std::size_t from = 0, to = 0;  // the columns of b, [from, to)
        std::size_t cells = 0;         // in all earlier rows
    };
    /// The state on which the rows from `row` on depend.
    struct Checkpoint {
        std::size_t row, from, known;
        std::vector<double> best;  // for [from, known]
    };

    Savings(std::span<const double> a, std::span<const double> b, double q) : a_(a), b_(b), q_(q), best_(b.size() + 1) {}

    /// The saving of moving a[i] to b[j]; negative if the move costs more than removing and adding a spike.
    double saved(std::size_t i, std::size_t j) const { return 2 - q_ * std::abs(a_[i] - b_[j]); }

    /// The columns of each row in which a move may save something.
    std::vector<RowRange> rows() const {
        std::vector<RowRange> all(a_.size());
        std::size_t from = 0, to = 0, cells = 0;
        for (std::size_t i = 0; i < a_.size(); ++i) {
            while (from < b_.size() && b_[from] <= a_[i] && saved(i, from) <= 0) ++from;
            to = std::max(to, from);
            while (to < b_.size() && (b_[to] <= a_[i] || saved(i, to) > 0)) ++to;
            all[i] = {from, to, cells};
            cells += to - from;
        }
        return all;
    }

    /// Computes row i, and appends the choice in each of its columns to `choices` unless this is null.
    void process_row(std::size_t i, const RowRange& row, std::vector<Choice>* choices) {
        if (row.from == row.to) return;
        while (known_ < row.to) best_[known_ + 1] = best_[known_], ++known_;
        double diagonal = best_[row.from];  // of the row above
        for (std::size_t j = row.from; j < row.to; ++j) {
            const double above = best_[j + 1], moved = diagonal + saved(i, j);
            diagonal = above;
            const Choice choice = moved > above && moved > best_[j] ? move : above >= best_[j] ? skip_a : skip_b;
            best_[j + 1] = choice == move ? moved : choice == skip_a ? above : best_[j];
            if (choices) choices->push_back(choice);
        }
    }

    Checkpoint checkpoint(std::size_t row, std::size_t from) const {
        const auto begin = best_.begin() + static_cast<std::ptrdiff_t>(std::min(from, known_));
        return {row, std::min(from, known_), known_, {begin, best_.begin() + static_cast<std::ptrdiff_t>(known_) + 1}};
    }
    void restore(const Checkpoint& saved_state) {
        known_ = saved_state.known;
        std::copy(saved_state.best.begin(), saved_state.best.end(), best_.begin() + static_cast<std::ptrdiff_t>(saved_state.from));
    }

    double total() const { return best_[known_]; }
};

constexpr std::size_t max_choices = std::size_t{1} << 22;  // stored at the same time

/// Collects the moves of rows [from, to), whose choices are in memory, in descending order. `j` is the column that the later rows have
/// reached.
void trace_back(std::span<const Savings::RowRange> rows, std::size_t from, std::size_t to, const std::vector<Savings::Choice>& choices,
                std::size_t& j, std::vector<SpikePair>& moved) {
    for (std::size_t i = to; i-- > from;)
        for (j = std::min(j, rows[i].to); j > rows[i].from;) {
            const auto choice = choices[rows[i].cells - rows[from].cells + j - 1 - rows[i].from];
            if (choice == Savings::skip_a) break;
            --j;
            if (choice == Savings::skip_b) continue;
            moved.push_back({i, j});
            break;
        }
}

Result<Alignment> align(std::span<const double> a, std::span<const double> b, double q, bool with_moves) {
    Savings savings(a, b, q);
    const auto rows = savings.rows();
    const std::size_t cells = rows.empty() ? 0 : rows.back().cells + rows.back().to - rows.back().from;
    if (cells > (with_moves ? max_candidates() / 4 : max_candidates()))
        return bad_input(
            fmt::format("at a cost of {:g} per second, {} and {} spikes have {} pairs within reach of each other; raise the cost", q,
                        a.size(), b.size(), cells));
    // Only the choices of one block of rows are in memory, at most max_choices. Those of earlier blocks are computed again from their
    // checkpoints.
    std::vector<Savings::Choice> choices;
    std::vector<Savings::Checkpoint> blocks;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (with_moves && (blocks.empty() || rows[i].cells + rows[i].to - rows[i].from - rows[blocks.back().row].cells > max_choices))
            blocks.push_back(savings.checkpoint(i, rows[i].from)), choices.clear();
        savings.process_row(i, rows[i], with_moves ? &choices : nullptr);
    }
    Alignment out{static_cast<double>(a.size() + b.size()) - savings.total(), {}};
    std::size_t j = b.size(), end = rows.size();
    for (auto block = blocks.rbegin(); block != blocks.rend(); end = block->row, ++block) {
        if (block != blocks.rbegin()) {
            savings.restore(*block), choices.clear();
            for (std::size_t i = block->row; i < end; ++i) savings.process_row(i, rows[i], &choices);
        }
        trace_back(rows, block->row, end, choices, j, out.moved);
    }
    std::reverse(out.moved.begin(), out.moved.end());
    return out;
}

}  // namespace

Result<double> victor_purpura(std::span<const double> a, std::span<const double> b, double q) {
    const auto aligned = align(a, b, q, false);
    if (!aligned) return aligned.error();
    return aligned->distance;
}

Result<Alignment> align_trains(std::span<const double> a, std::span<const double> b, double q) { return align(a, b, q, true); }

double van_rossum_squared(std::span<const double> a, std::span<const double> b, double tau) {
    // Spikes of a have sign +1, those of b -1. The sum runs over all pairs: sign * sign * e^(-|dt|/tau). `before` is the sum of a spike
    // with all earlier ones. Each spike therefore adds 1 and twice its sign times `before`.
    double sum = 0, before = 0, last = 0;
    for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
        const bool of_a = j == b.size() || (i < a.size() && a[i] <= b[j]);
        const double t = of_a ? a[i++] : b[j++], sign = of_a ? 1 : -1;
        before *= num::exp((last - t) / tau);
        last = t;
        sum += 1 + 2 * sign * before;
        before += sign;
    }
    return std::max(sum, 0.0);
}

}  // namespace corpuscle
