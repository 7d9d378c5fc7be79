// The elimination of large matrices in dense fronts: its kernels, its solutions, and circuits that use it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "circuit/lanes/front_kernels.hpp"
#include "circuit/solve/linear/matrix.hpp"
#include "circuit/transient_runner.hpp"

namespace corpuscle::circuit {
namespace {

/// A dense matrix as the kernels expect it: columns at a stride, aligned.
struct DenseFront {
    struct alignas(64) Line {
        double values[8];
    };
    std::size_t size, pivots, stride;
    std::vector<Line> storage;
    std::vector<double> inverse_pivot;

    DenseFront(std::size_t n, std::size_t eliminated, bool symmetric)
        : size(n), pivots(eliminated), stride((n + lanes::front_padding + 7) / 8 * 8), inverse_pivot(eliminated) {
        storage.resize((stride * size + 2 * lanes::front_block * stride) / 8);
        std::mt19937 generator(3);
        for (std::size_t j = 0; j < size; ++j)
            for (std::size_t i = 0; i < size; ++i)
                at(i, j) = symmetric && i < j ? at(j, i) : std::normal_distribution<double>()(generator) + (i == j ? 20 : 0);
        for (std::size_t j = 0; symmetric && j < size; ++j)
            for (std::size_t i = 0; i < j; ++i) at(i, j) = at(j, i);
    }
    double* values() { return storage.data()->values; }
    double& at(std::size_t i, std::size_t j) { return values()[i + j * stride]; }
    lanes::Front front(bool symmetric) {
        double* const rows = values() + stride * size;
        return {values(), size, stride, pivots, symmetric, inverse_pivot.data(), rows, rows + lanes::front_block * stride};
    }
};

TEST(FrontKernels, ComputeTheBitsOfPlainEliminationWithEveryInstructionSet) {
    for (const auto& [size, pivots] : {std::pair<std::size_t, std::size_t>{1, 1}, {5, 2}, {37, 21}, {61, 61}, {90, 33}})
        for (const bool symmetric : {false, true})
            for (const auto set : instruction_sets()) {
                DenseFront found(size, pivots, symmetric), expected = found;
                lanes::front_kernel_table(set).factor(found.front(symmetric));
                for (std::size_t p = 0; p < pivots; ++p) {
                    const double inverse = 1 / expected.at(p, p);
                    std::vector<double> upper(size);
                    for (std::size_t j = p + 1; j < size; ++j) upper[j] = symmetric ? expected.at(j, p) : expected.at(p, j);
                    for (std::size_t i = p + 1; i < size; ++i) expected.at(i, p) *= inverse;
                    for (std::size_t j = p + 1; j < size; ++j) {
                        // Columns of a later block get D L, whose last bit may differ from the number before the division.
                        const bool later_block = j / lanes::front_block != p / lanes::front_block || j >= pivots;
                        const double factor = symmetric && later_block ? expected.at(p, p) * expected.at(j, p) : upper[j];
                        for (std::size_t i = symmetric ? j : p + 1; i < size; ++i) expected.at(i, j) -= expected.at(i, p) * factor;
                    }
                }
                for (std::size_t j = 0; j < size; ++j)
                    for (std::size_t i = symmetric ? j : 0; i < size; ++i)
                        ASSERT_EQ(found.at(i, j), expected.at(i, j)) << name_of(set) << ", row " << i << ", column " << j << " of " << size;
            }
}

/// Conductances of a mesh of side x side nodes, a voltage source at its corner, and one between two of its nodes if `has_bridge`. `skew`
/// makes each conductance different in the two directions.
struct MeshMatrix {
    SparsityPattern pattern;
    std::vector<double> values;

    static MeshMatrix make(int side, bool has_bridge, double skew) {
        std::vector<std::tuple<int, int, double>> all;
        const int n = side * side;
        const auto add = [&](int row, int column, double value) { all.emplace_back(row, column, value); };
        const auto join = [&](int a, int b) {
            const double g = 1 + 0.3 * std::sin(a + 2 * b);
            add(a, a, g), add(b, b, g), add(a, b, -g * (1 + skew)), add(b, a, -g * (1 - skew));
        };
        for (int k = 0; k < n; ++k) add(k, k, 0.1);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x + 1 < side; ++x) join(y * side + x, y * side + x + 1), join(x * side + y, (x + 1) * side + y);
        const auto source = [&](int plus, int minus, int branch) {
            add(plus, branch, 1), add(branch, plus, 1), add(branch, branch, 0);
            if (minus >= 0) add(minus, branch, -1), add(branch, minus, -1);
        };
        source(0, -1, n);
        if (has_bridge) source(n / 2, n - 1, n + 1);
        std::vector<std::pair<int, int>> entries;
        for (const auto& [row, column, value] : all) entries.emplace_back(row, column);
        MeshMatrix out{SparsityPattern(n + 1 + has_bridge, entries), {}};
        out.values.resize(out.pattern.entries());
        for (const auto& [row, column, value] : all) out.values[out.pattern.entry_index(row, column)] += value;
        return out;
    }
    /// The largest difference between A x and b.
    double residual(const std::vector<double>& x, std::vector<double> b) const {
        pattern.for_each_entry([&](std::size_t e, std::size_t row, std::size_t column) { b[row] -= values[e] * x[column]; });
        return std::abs(*std::ranges::max_element(b, {}, [](double r) { return std::abs(r); }));
    }
};

TEST(FrontElimination, SolvesMeshesWithAndWithoutSymmetryAndSources) {
    for (const bool has_bridge : {false, true})
        for (const double skew : {0.0, 0.2}) {
            auto m = MeshMatrix::make(56, has_bridge, skew);
            LinearSolver<double> solver(m.pattern);
            solver.fix_pivot_order(m.values);
            EXPECT_EQ(solver.elimination(), nullptr) << "the list is too long";
            for (const double factor : {1.0, 0.01}) {
                for (double& v : m.values)
                    if (std::abs(v) != 1) v *= factor;
                ASSERT_TRUE(solver.factor(m.values));
                EXPECT_EQ(solver.fallback_count(), 0);
                EXPECT_GT(solver.growth(), 0) << "the fronts are used";
                std::vector<double> b;
                for (int k = 0; k < m.pattern.size(); ++k) b.push_back(std::sin(k));
                auto x = b;
                solver.solve(x);
                EXPECT_LT(m.residual(x, b), 1e-11);
            }
        }
}

TEST(FrontElimination, AMatrixUnsuitableForThePivotOrderIsFactoredAgain) {
    constexpr int side = 56, nodes = side * side;
    auto m = MeshMatrix::make(side, false, 0);
    LinearSolver<double> solver(m.pattern);
    solver.fix_pivot_order(m.values);
    // The pivots of this matrix connect pairs of neighbours, but for the pair at the source.
    m.pattern.for_each_entry([&](std::size_t e, std::size_t row, std::size_t column) {
        if (row < nodes && column < nodes) m.values[e] = row == column ? (row < 2 ? 5 : 1e-12) : row / 2 == column / 2 ? 5 : 0.01;
    });
    ASSERT_TRUE(solver.factor(m.values));
    EXPECT_EQ(solver.fallback_count(), 1);
    EXPECT_EQ(solver.growth(), 0) << "the fronts are not used";
    const std::vector<double> b(nodes + 1, 1.0);
    auto x = b;
    solver.solve(x);
    EXPECT_LT(m.residual(x, b), 1e-12);
    // A value where the order assumes a zero.
    m = MeshMatrix::make(side, false, 0);
    ASSERT_TRUE(solver.factor(m.values));
    EXPECT_EQ(solver.fallback_count(), 1);
    m.values[m.pattern.entry_index(nodes, nodes)] = -0.5;
    ASSERT_TRUE(solver.factor(m.values));
    EXPECT_EQ(solver.fallback_count(), 2);
    x = b;
    solver.solve(x);
    EXPECT_LT(m.residual(x, b), 1e-12);
}

TEST(LargeTransient, OfAMeshOfThreeThousandNodesFollowsItsModesAndKeepsItsCharge) {
    constexpr int side = 55;
    constexpr double R = 1e3, C = 1e-12, leak = 1e9, amplitude = 0.25, mean = 0.5;
    std::string text = "mesh\n";
    const auto mode = [&](int x, int y) {
        return std::cos(std::numbers::pi * (x + 0.5) / side) * std::cos(2 * std::numbers::pi * (y + 0.5) / side);
    };
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y) {
            text += fmt::format("c{0}_{1} n{0}_{1} 0 1p\nr{0}_{1} n{0}_{1} 0 1g\n.ic v(n{0}_{1})={2:.17g}\n", x, y,
                                mean + amplitude * mode(x, y));
            if (x > 0) text += fmt::format("rx{1}_{2} n{0}_{2} n{1}_{2} 1k\n", x - 1, x, y);
            if (y > 0) text += fmt::format("ry{2}_{1} n{2}_{0} n{2}_{1} 1k\n", y - 1, y, x);
        }
    const auto runner = TransientRunner::from_text(text + ".tran 1n 60n uic\n.end\n");
    const auto points = runner.run({.reltol = 1e-4, .all_reported = true});
    ASSERT_EQ(points.error, "");
    const auto rate = [](double part) { return 4 / (R * C) * std::pow(std::sin(std::numbers::pi * part / (2 * side)), 2); };
    const double t = points.t.back(), kept = std::exp(-t / (leak * C)), decay = std::exp(-t * (rate(1) + rate(2))) * kept;
    double total = 0;
    for (const int x : {0, 17, 54})
        for (const int y : {0, 30, 54}) {
            const auto u = static_cast<std::size_t>(runner.unknown(fmt::format("v(n{}_{})", x, y)));
            EXPECT_NEAR(points.x.back()[u], mean * kept + amplitude * mode(x, y) * decay, 2e-4) << x << ", " << y;
        }
    for (const double v : points.x.back()) total += v;
    EXPECT_NEAR(total / (side * side), mean * kept, 1e-6);
}

}  // namespace
}  // namespace corpuscle::circuit
