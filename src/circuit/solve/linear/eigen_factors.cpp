// SparseFactors by Eigen's SparseLU. Only this file includes Eigen, and only builds without KLU compile it (web/engine/CMakeLists.txt).

#include <Eigen/OrderingMethods>
#include <Eigen/SparseLU>

#include "circuit/solve/linear/matrix.hpp"

namespace corpuscle::circuit {
namespace {

/// AMD as SparseLU wants it: a permutation with the new number of each column. Eigen's AMDOrdering gives its inverse.
struct ColumnOrdering {
    using PermutationType = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
    template <class Matrix>
    void operator()(const Matrix& matrix, PermutationType& order) const {
        PermutationType inverse;
        Eigen::AMDOrdering<int>()(matrix, inverse);
        order = inverse.inverse();
    }
};

}  // namespace

/// Rows are scaled by their largest entries, and a pivot on the diagonal is preferred, as in KLU.
template <class T>
struct SparseFactors<T>::Impl {
    using Matrix = Eigen::SparseMatrix<T, Eigen::ColMajor, int>;
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    static constexpr double diagonal_preference = 1e-3;  // relative to the largest entry of the column

    const SparsityPattern& pattern;
    Matrix matrix;
    Eigen::SparseLU<Matrix, ColumnOrdering> factors;
    std::vector<double> scale;  // of each row

    explicit Impl(const SparsityPattern& p) : pattern(p), matrix(p.size(), p.size()), scale(static_cast<std::size_t>(p.size())) {
        std::vector<Eigen::Triplet<T>> entries;
        p.for_each_entry([&](std::size_t, std::size_t row, std::size_t column) {
            entries.emplace_back(static_cast<int>(row), static_cast<int>(column), T(1));
        });
        matrix.setFromTriplets(entries.begin(), entries.end());
        matrix.makeCompressed();
        factors.setPivotThreshold(diagonal_preference);
        if (p.size() > 0) factors.analyzePattern(matrix);
    }
    void set_values(std::span<const T> values) {
        std::fill(scale.begin(), scale.end(), 0.0);
        pattern.for_each_entry(
            [&](std::size_t e, std::size_t row, std::size_t) { scale[row] = std::max(scale[row], std::abs(values[e])); });
        for (double& s : scale) s = s > 0 ? 1 / s : 1;
        pattern.for_each_entry([&](std::size_t e, std::size_t row, std::size_t) { matrix.valuePtr()[e] = scale[row] * values[e]; });
    }
};

template <class T>
SparseFactors<T>::SparseFactors(const SparsityPattern& p) : impl_(std::make_unique<Impl>(p)) {}
template <class T>
SparseFactors<T>::~SparseFactors() = default;
template <class T>
SparseFactors<T>::SparseFactors(SparseFactors&&) noexcept = default;

template <class T>
bool SparseFactors<T>::has_analysis() const {
    return impl_->pattern.size() > 0;
}
/// Without an estimate; the length of the list of operations tells it later.
template <class T>
double SparseFactors<T>::estimated_operations() const {
    return 0;
}
/// SparseLU has no factorization with given pivots.
template <class T>
bool SparseFactors<T>::refactor(std::span<const T>) {
    return false;
}

template <class T>
bool SparseFactors<T>::factor(std::span<const T> values) {
    for (const T& value : values)
        if (!std::isfinite(std::abs(value))) return false;
    impl_->set_values(values);
    impl_->factors.factorize(impl_->matrix);
    return impl_->factors.info() == Eigen::Success;
}

template <class T>
void SparseFactors<T>::clear() {}

template <class T>
int SparseFactors<T>::singular_column() const {
    return -1;
}

template <class T>
PivotOrder SparseFactors<T>::pivot_order() const {
    const int size = impl_->pattern.size();
    PivotOrder out{std::vector<int>(static_cast<std::size_t>(size)), std::vector<int>(static_cast<std::size_t>(size)), {0, size}};
    for (int k = 0; k < size; ++k) {
        // A permutation of Eigen has the new number of each row or column.
        out.rows[static_cast<std::size_t>(impl_->factors.rowsPermutation().indices()[k])] = k;
        out.columns[static_cast<std::size_t>(impl_->factors.colsPermutation().indices()[k])] = k;
    }
    return out;
}

template <class T>
void SparseFactors<T>::solve(std::span<T> b) const {
    Eigen::Map<typename Impl::Vector> x(b.data(), impl_->pattern.size());
    for (std::size_t row = 0; row < b.size(); ++row) b[row] *= impl_->scale[row];
    x = impl_->factors.solve(typename Impl::Vector(x));
}

template <class T>
void SparseFactors<T>::solve_transposed(std::span<T> b) const {
    Eigen::Map<typename Impl::Vector> x(b.data(), impl_->pattern.size());
    x = impl_->factors.transpose().solve(typename Impl::Vector(x));
    for (std::size_t row = 0; row < b.size(); ++row) b[row] *= impl_->scale[row];
}

template class SparseFactors<double>;
template class SparseFactors<std::complex<double>>;

std::vector<int> minimum_degree_order(std::span<const int> column_begin, std::span<const int> rows) {
    const auto size = static_cast<int>(column_begin.size()) - 1;
    Eigen::SparseMatrix<double, Eigen::ColMajor, int> matrix(size, size);
    std::vector<Eigen::Triplet<double>> entries;
    for (int column = 0; column < size; ++column)
        for (int e = column_begin[static_cast<std::size_t>(column)]; e < column_begin[static_cast<std::size_t>(column) + 1]; ++e)
            entries.emplace_back(rows[static_cast<std::size_t>(e)], column, 1.0);
    matrix.setFromTriplets(entries.begin(), entries.end());
    ColumnOrdering::PermutationType order;
    Eigen::AMDOrdering<int>()(matrix, order);
    return {order.indices().data(), order.indices().data() + size};
}

}  // namespace corpuscle::circuit
