// An elimination with fixed pivots solves its matrix and similar matrices; for other matrices the solver factors anew.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "circuit/solve/linear/elimination.hpp"
#include "circuit/solve/linear/matrix.hpp"

namespace corpuscle::circuit {
namespace {

struct SparseMatrix {
    SparsityPattern pattern;
    std::vector<double> values;

    /// Product of a row and x.
    double times(int row, const std::vector<double>& x) const {
        double sum = 0;
        for (int column = 0; column < pattern.size(); ++column)
            for (int e = pattern.column_begin()[static_cast<std::size_t>(column)];
                 e < pattern.column_begin()[static_cast<std::size_t>(column) + 1]; ++e)
                if (pattern.rows()[static_cast<std::size_t>(e)] == row)
                    sum += values[static_cast<std::size_t>(e)] * x[static_cast<std::size_t>(column)];
        return sum;
    }
};

/// The matrix of a circuit: conductances over seven decades between random nodes, and voltage sources, whose rows have 0 on the diagonal
/// and 1 off it.
SparseMatrix random_circuit(std::mt19937& generator, int nodes, int sources) {
    std::vector<std::tuple<int, int, double>> all;
    std::uniform_real_distribution<double> decade(-12, -5);
    const auto node = [&] { return static_cast<int>(generator() % static_cast<unsigned>(nodes)); };
    const auto add = [&](int row, int column, double value) { all.emplace_back(row, column, value); };
    for (int k = 0; k < nodes; ++k) add(k, k, std::pow(10, decade(generator)));
    for (int k = 0; k < 3 * nodes; ++k) {
        const int a = node(), b = node();
        if (a == b) continue;
        const double g = std::pow(10, decade(generator)), m = std::pow(10, decade(generator));
        add(a, a, g), add(b, b, g), add(a, b, -g), add(b, a, -g), add(a, b, m);
    }
    for (int k = 0; k < sources; ++k) add(k, nodes + k, 1), add(nodes + k, k, 1), add(nodes + k, nodes + k, 0);
    std::vector<std::pair<int, int>> entries;
    for (const auto& [row, column, value] : all) entries.emplace_back(row, column);
    SparseMatrix out{SparsityPattern(nodes + sources, entries), {}};
    out.values.resize(out.pattern.entries());
    for (const auto& [row, column, value] : all) out.values[out.pattern.entry_index(row, column)] += value;
    return out;
}

/// Multiplies the matrix by a random x, solves, and expects the product again.
void expect_solution(LinearSolver<double>& solver, const SparseMatrix& m, std::mt19937& generator) {
    const auto n = static_cast<std::size_t>(m.pattern.size());
    std::vector<double> x(n), b(n), size(n);
    for (double& v : x) v = std::normal_distribution<double>()(generator);
    for (std::size_t row = 0; row < n; ++row) b[row] = m.times(static_cast<int>(row), x);
    ASSERT_TRUE(solver.factor(m.values));
    auto found = b;
    solver.solve(found);
    for (std::size_t row = 0; row < n; ++row) {
        double scale = 0;
        for (std::size_t c = 0; c < n; ++c)
            for (int e = m.pattern.column_begin()[c]; e < m.pattern.column_begin()[c + 1]; ++e)
                if (m.pattern.rows()[static_cast<std::size_t>(e)] == static_cast<int>(row))
                    scale += std::abs(m.values[static_cast<std::size_t>(e)] * found[c]);
        EXPECT_NEAR(m.times(static_cast<int>(row), found), b[row], 1e-9 * scale) << "row " << row << " of " << n;
    }
}

TEST(Elimination, SolvesItsMatrixAndSimilarMatrices) {
    std::mt19937 generator(1);
    for (int round = 0; round < 100; ++round) {
        const int nodes = 1 + static_cast<int>(generator() % 40),
                  sources = static_cast<int>(generator() % static_cast<unsigned>(nodes)) / 4;
        auto m = random_circuit(generator, nodes, sources);
        LinearSolver<double> solver(m.pattern);
        solver.fix_pivot_order(m.values);
        expect_solution(solver, m, generator);
        for (int other = 0; other < 5; ++other) {
            for (double& v : m.values)
                if (std::abs(v) != 1) v *= std::exp(0.3 * std::normal_distribution<double>()(generator));
            expect_solution(solver, m, generator);
        }
        EXPECT_EQ(solver.fallback_count(), 0);
    }
}

TEST(Elimination, AMatrixUnsuitableForThePivotOrderIsFactoredAgain) {
    SparseMatrix m{SparsityPattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}}), {1, 1e-3, 1e-3, 1}};
    LinearSolver<double> solver(m.pattern);
    solver.fix_pivot_order(m.values);
    std::mt19937 generator(2);
    expect_solution(solver, m, generator);
    EXPECT_EQ(solver.fallback_count(), 0);
    m.values = {1e-20, 1, 1, 1e-20};
    expect_solution(solver, m, generator);
    EXPECT_EQ(solver.fallback_count(), 1);
    m.values = {2, 1e-3, 1e-3, 3};
    expect_solution(solver, m, generator);
    EXPECT_EQ(solver.fallback_count(), 1);
}

TEST(Elimination, AnArrowMatrixHasNoFillIn) {
    // no fill-in, because the dense row and column are last
    std::vector<std::pair<int, int>> entries;
    for (int k = 0; k < 10; ++k) entries.insert(entries.end(), {{k, k}, {k, 9}, {9, k}});
    const SparsityPattern pattern(10, entries);
    std::vector<int> order(10);
    for (int k = 0; k < 10; ++k) order[static_cast<std::size_t>(k)] = k;
    const std::vector<double> ones(pattern.entries(), 1);
    const auto elimination = Elimination::make(pattern, order, order, ones, 9);
    ASSERT_TRUE(elimination);
    EXPECT_EQ(elimination->slots(), pattern.entries());
    EXPECT_EQ(elimination->multiplications(), 9U);
    EXPECT_FALSE(Elimination::make(pattern, order, order, ones, 8)) << "more multiplications than allowed";
}

TEST(Elimination, ALongChainIsListedWithoutFillIn) {
    constexpr int n = 100'000;
    std::vector<std::pair<int, int>> entries;
    for (int k = 0; k < n; ++k) {
        entries.emplace_back(k, k);
        if (k > 0) entries.insert(entries.end(), {{k, k - 1}, {k - 1, k}});
    }
    SparseMatrix m{SparsityPattern(n, entries), {}};
    for (std::size_t column = 0; column < n; ++column)
        for (int e = m.pattern.column_begin()[column]; e < m.pattern.column_begin()[column + 1]; ++e)
            m.values.push_back(m.pattern.rows()[static_cast<std::size_t>(e)] == static_cast<int>(column) ? 2.5 : -1);
    std::vector<int> order(n);
    std::iota(order.begin(), order.end(), 0);
    auto elimination = Elimination::make(m.pattern, order, order, m.values, n);
    ASSERT_TRUE(elimination);
    EXPECT_EQ(elimination->slots(), m.pattern.entries());
    ASSERT_TRUE(elimination->factor(m.values));
    std::vector<double> x(n, 1.0);
    elimination->solve(x);
    for (std::size_t k : {0, 1, n / 2, n - 1}) EXPECT_NEAR(m.times(static_cast<int>(k), x), 1, 1e-12) << k;
}

TEST(Elimination, ReportsElementGrowthAndRejectsAMatrixThatNeedsOtherPivots) {
    const SparsityPattern pattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
    LinearSolver<double> solver(pattern);
    solver.fix_pivot_order(std::vector<double>{1, 0.5, 0.5, 1});
    const std::vector<double> grown = {1e-6, 0.5, 0.5, 1e-6};  // both diagonal pivots are small
    ASSERT_TRUE(solver.factor(grown));
    EXPECT_GT(solver.growth(), 1e5);
    EXPECT_EQ(solver.fallback_count(), 0);
    ASSERT_TRUE(solver.factor_with_new_pivots(grown));
    EXPECT_EQ(solver.growth(), 0);
    EXPECT_EQ(solver.fallback_count(), 1);
    std::vector<double> b = {1, 2};
    solver.solve(b);
    EXPECT_NEAR(1e-6 * b[0] + 0.5 * b[1], 1, 1e-15);
    EXPECT_NEAR(0.5 * b[0] + 1e-6 * b[1], 2, 1e-15);
}

}  // namespace
}  // namespace corpuscle::circuit
