#pragma once
// Sparse linear equations of one pattern and many values, by SuiteSparse's KLU. The only files that include it.

#include <complex>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace corpuscle::circuit {

/// Which places of a square matrix may differ from zero, column by column.
class Pattern {
    int size_;
    std::vector<int> begin_, rows_;

public:
    /// entries: row and column, in any order, some more than once.
    Pattern(int size, std::vector<std::pair<int, int>> entries);
    int size() const { return size_; }
    std::size_t entries() const { return rows_.size(); }
    /// Where the value of this place stands among all values.
    std::size_t place(int row, int column) const;
    std::span<const int> begin() const { return begin_; }
    std::span<const int> rows() const { return rows_; }
};

/// Why a matrix could not be factored: this unknown's column depends on others.
struct Singular {
    int column = -1;
};

class Elimination;

/// T: double or std::complex<double>.
template <class T>
class Solver {
    struct Held;
    std::unique_ptr<Held> held_;

public:
    explicit Solver(const Pattern&);
    ~Solver();
    Solver(Solver&&) noexcept;

    /// Factors the matrix of these values, along the pivots of the last one if they still serve. False: it is singular, see where().
    bool factor(std::span<const T> values);
    Singular where() const;
    /// Takes the pivots of this matrix for good and writes their elimination out as a list, for the many like it that follow; one that
    /// they do not serve is still factored anew. Only of doubles, and not of a very large one: then nothing changes.
    void settle(std::span<const T> values);
    const Elimination* list() const;  ///< null: none was written out
    long strayed() const;             ///< matrices since then that the list did not serve
    /// Of the last matrix along the list, its largest multiplier: where it is large, an answer is worth a look. 0: it went another way.
    double growth() const;
    bool factor_anew(std::span<const T> values);           ///< with pivots of its own, whatever list there is; counts as strayed
    void solve(std::span<T> right_side) const;             ///< A x = b, in place
    void solve_transposed(std::span<T> right_side) const;  ///< A^T x = b (no conjugate)
};

extern template class Solver<double>;
extern template class Solver<std::complex<double>>;

}  // namespace corpuscle::circuit
