// The flat list of an elimination solves its matrix and similar matrices; for other matrices the solver falls back to a new factorization.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "circuit/solve/elimination.hpp"
#include "circuit/solve/matrix.hpp"

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

/// Conductances over seven decades between random nodes, and rows of voltage sources with 0 on the diagonal and 1 off it.
SparseMatrix random_circuit(std::mt19937& chance, int nodes, int sources) {
    std::vector<std::tuple<int, int, double>> all;
    std::uniform_real_distribution<double> decade(-12, -5);
    const auto node = [&] { return static_cast<int>(chance() % static_cast<unsigned>(nodes)); };
    const auto add = [&](int row, int column, double value) { all.emplace_back(row, column, value); };
    for (int k = 0; k < nodes; ++k) add(k, k, std::pow(10, decade(chance)));
    for (int k = 0; k < 3 * nodes; ++k) {
        const int a = node(), b = node();
        if (a == b) continue;
        const double g = std::pow(10, decade(chance)), m = std::pow(10, decade(chance));
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

void solves(LinearSolver<double>& solver, const SparseMatrix& m, std::mt19937& chance) {
    const auto n = static_cast<std::size_t>(m.pattern.size());
    std::vector<double> x(n), b(n), size(n);
    for (double& v : x) v = std::normal_distribution<double>()(chance);
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

TEST(Elimination, SolvesItsMatrixAndSimilarOnes) {
    std::mt19937 chance(1);
    for (int round = 0; round < 100; ++round) {
        const int nodes = 1 + static_cast<int>(chance() % 40), sources = static_cast<int>(chance() % static_cast<unsigned>(nodes)) / 4;
        auto m = random_circuit(chance, nodes, sources);
        LinearSolver<double> solver(m.pattern);
        solver.fix_pivot_order(m.values);
        solves(solver, m, chance);
        for (int other = 0; other < 5; ++other) {
            for (double& v : m.values)
                if (std::abs(v) != 1) v *= std::exp(0.3 * std::normal_distribution<double>()(chance));
            solves(solver, m, chance);
        }
        EXPECT_EQ(solver.fallback_count(), 0);
    }
}

TEST(Elimination, AMatrixThatItsPivotsDoNotServeIsFactoredAnew) {
    SparseMatrix m{SparsityPattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}}), {1, 1e-3, 1e-3, 1}};
    LinearSolver<double> solver(m.pattern);
    solver.fix_pivot_order(m.values);
    std::mt19937 chance(2);
    solves(solver, m, chance);
    EXPECT_EQ(solver.fallback_count(), 0);
    m.values = {1e-20, 1, 1, 1e-20};
    solves(solver, m, chance);
    EXPECT_EQ(solver.fallback_count(), 1);
    m.values = {2, 1e-3, 1e-3, 3};
    solves(solver, m, chance);
    EXPECT_EQ(solver.fallback_count(), 1);
}

TEST(Elimination, DoesNoMoreThanItsFillAsksFor) {
    // an arrow matrix: no fill-in if the dense row and column are last
    std::vector<std::pair<int, int>> entries;
    for (int k = 0; k < 10; ++k) entries.insert(entries.end(), {{k, k}, {k, 9}, {9, k}});
    const SparsityPattern pattern(10, entries);
    std::vector<int> order(10);
    for (int k = 0; k < 10; ++k) order[static_cast<std::size_t>(k)] = k;
    const std::vector<double> ones(pattern.entries(), 1);
    const Elimination list(pattern, order, order, ones);
    EXPECT_EQ(list.slots(), pattern.entries());
    EXPECT_EQ(list.multiplications(), 9U);
}

TEST(Elimination, ReportsElementGrowthAndRejectsAMatrixThatNeedsOtherPivots) {
    const SparsityPattern pattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
    LinearSolver<double> solver(pattern);
    solver.fix_pivot_order(std::vector<double>{1, 0.5, 0.5, 1});
    const std::vector<double> grown = {1e-6, 0.5, 0.5, 1e-6};  // now both diagonal pivots are small
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
