#include "measure/train_distance.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

/// Computes the saving of the best alignment of two trains a and b. The saving is the difference to the cost of removing all spikes of a
/// and adding all spikes of b. Each moved spike saves 2 - q |dt|, because it is neither removed nor added. The best saving is computed by
/// dynamic programming in a table with a row for each spike of a and a column for each spike of b, of which only the current row is stored.
/// In each row only those columns are computed in which a move saves something. The columns before them have the values of the row above;
/// the columns after them have the value of the last computed column.
class Savings {
    std::span<const double> a_, b_;
    double q_;                  // cost of moving a spike, 1/s
    std::vector<double> best_;  // after row i - 1: best_[j] is the best saving for the first i spikes of a and the first j of b
    std::size_t known_ = 0;     // best_[0 ... known_] are computed; the values after them are equal to best_[known_]

public:
    /// In the best alignment up to a cell of the table: a's spike is removed, b's spike is added, or a's spike is moved to b's.
    enum Choice : unsigned char { skip_a, skip_b, move };
    /// The columns of one row that are computed.
    struct RowRange {
        std::size_t from = 0, to = 0;  // columns [from, to): indices of spikes of b
        std::size_t cells = 0;         // number of cells computed in all earlier rows
    };
    /// The part of the state that is needed to compute row `row` and the rows after it.
    struct Checkpoint {
        std::size_t row, from, known;  // known: the value of known_
        std::vector<double> best;      // best_[from ... known]
    };

    Savings(std::span<const double> a, std::span<const double> b, double q) : a_(a), b_(b), q_(q), best_(b.size() + 1) {}

    /// The saving of moving a[i] to b[j]; negative if the move costs more than removing and adding a spike.
    double saved(std::size_t i, std::size_t j) const { return 2 - q_ * std::abs(a_[i] - b_[j]); }

    /// The columns of each row that must be computed. They increase from row to row, because both trains are in order of time.
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

    /// Computes row i from row i - 1, and appends the choice in each of its computed columns to `choices` unless this is null.
    void process_row(std::size_t i, const RowRange& row, std::vector<Choice>* choices) {
        if (row.from == row.to) return;
        while (known_ < row.to) best_[known_ + 1] = best_[known_], ++known_;
        double diagonal = best_[row.from];  // value of the row above, one column to the left
        for (std::size_t j = row.from; j < row.to; ++j) {
            const double above = best_[j + 1], moved = diagonal + saved(i, j);
            diagonal = above;
            const Choice choice = moved > above && moved > best_[j] ? move : above >= best_[j] ? skip_a : skip_b;
            best_[j + 1] = choice == move ? moved : choice == skip_a ? above : best_[j];
            if (choices) choices->push_back(choice);
        }
    }

    /// The state before row `row`, whose first computed column is `from`.
    Checkpoint checkpoint(std::size_t row, std::size_t from) const {
        const auto begin = best_.begin() + static_cast<std::ptrdiff_t>(std::min(from, known_));
        return {row, std::min(from, known_), known_, {begin, best_.begin() + static_cast<std::ptrdiff_t>(known_) + 1}};
    }
    void restore(const Checkpoint& saved_state) {
        known_ = saved_state.known;
        std::copy(saved_state.best.begin(), saved_state.best.end(), best_.begin() + static_cast<std::ptrdiff_t>(saved_state.from));
    }

    /// The saving of the best alignment of the complete trains, after all rows.
    double total() const { return best_[known_]; }
};

// Upper bound on the choices that are stored at the same time, unless one row has more.
constexpr std::size_t max_choices = std::size_t{1} << 22;

/// Appends the moves of rows [from, to) to `moved`, from the last to the first. `choices` are the choices of exactly these rows. `j` is the
/// number of spikes of b that are not yet assigned to later rows; it is reduced by those of these rows.
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

/// The best alignment; without `with_moves` only its distance.
Result<Alignment> align(std::span<const double> a, std::span<const double> b, double q, bool with_moves) {
    Savings savings(a, b, q);
    const auto rows = savings.rows();
    const std::size_t cells = rows.empty() ? 0 : rows.back().cells + rows.back().to - rows.back().from;
    if (cells > (with_moves ? max_candidates() / 4 : max_candidates()))
        return bad_input(
            fmt::format("at a cost of {:g} per second, trains of {} and {} spikes have {} pairs that could be moved to each other, too "
                        "many to examine; raise the cost",
                        q, a.size(), b.size(), cells));
    // The rows are divided into blocks, and only the choices of one block are in memory. The choices of all blocks but the last are
    // computed again, from a checkpoint at the block's first row, when their moves are collected.
    std::vector<Savings::Choice> choices;
    std::vector<Savings::Checkpoint> blocks;  // at the first row of each block
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (with_moves && (blocks.empty() || rows[i].cells + rows[i].to - rows[i].from - rows[blocks.back().row].cells > max_choices))
            blocks.push_back(savings.checkpoint(i, rows[i].from)), choices.clear();
        savings.process_row(i, rows[i], with_moves ? &choices : nullptr);
    }
    Alignment out{static_cast<double>(a.size() + b.size()) - savings.total(), {}};
    std::size_t j = b.size(), end = rows.size();
    for (auto block = blocks.rbegin(); block != blocks.rend(); end = block->row, ++block) {
        if (block != blocks.rbegin()) {  // the choices of the last block are still in memory
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
    const auto aligned = TRY(align(a, b, q, false));
    return aligned.distance;
}

Result<Alignment> align_trains(std::span<const double> a, std::span<const double> b, double q) { return align(a, b, q, true); }

double van_rossum_squared(std::span<const double> a, std::span<const double> b, double tau) {
    // Spikes of a have sign +1, those of b -1. The result is the sum of sign_k sign_l e^(-|t_k - t_l|/tau) over all pairs (k, l) of spikes
    // of both trains, which are visited together in order of time. `before` is the sum of sign_l e^(-(t - t_l)/tau) over the earlier spikes
    // l. Each spike therefore adds 1 (its pair with itself) and 2 sign `before` (its pairs with the earlier spikes, in both orders).
    double sum = 0, before = 0, last = 0;  // last: time of the spike before, s
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
