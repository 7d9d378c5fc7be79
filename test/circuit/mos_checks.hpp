#pragma once
// Checks of properties that every MOS transistor has: slopes, conservation, symmetry.

#include <gtest/gtest.h>

#include <random>

#include "circuit/device/mos/mos_line.hpp"

namespace corpuscle::circuit {
extern const DeviceKind mos1_kind, ekv_kind;
}

namespace corpuscle::circuit::test {

/// One transistor with its own unknowns: drain, gate, source, bulk, then inner nodes.
class MosUnderTest final : DeviceSetup {
    Circuit circuit_;
    int count_ = 4;
    double kelvin_;
    std::unique_ptr<Device> device_;

    int node_unknown(int number) const override { return number - 1; }
    int branch_unknown(int) const override { return -1; }
    int add_unknown(std::string_view) override { return count_++; }
    double temperature(const Element&) const override { return kelvin_; }
    const Circuit& circuit() const override { return circuit_; }

public:
    /// Currents, charges and their slopes.
    struct Evaluation {
        std::vector<double> f, q, df, dq;
        double g(std::size_t row, std::size_t column) const { return df[row * f.size() + column]; }
        double c(std::size_t row, std::size_t column) const { return dq[row * f.size() + column]; }
    };

    MosUnderTest(const DeviceKind& kind, const std::string& type, const Values& card, const Values& size, double celsius = 27)
        : kelvin_(celsius + 273.15) {
        auto& model = circuit_.models.emplace_back();
        model.name = "card", model.type = type, model.values = card;
        Element element;
        element.name = "m1", element.letter = 'm', element.kind = &kind, element.nodes = {1, 2, 3, 4}, element.model = 0;
        element.values = size;
        auto made = kind.make(element, *this);
        EXPECT_TRUE(made) << (made ? "" : made.error().text());
        if (made) device_ = std::move(*made);
    }
    const Device& device() const { return *device_; }
    std::size_t unknowns() const { return static_cast<std::size_t>(count_); }
    Evaluation at(std::span<const double> v) const {
        const auto n = unknowns();
        Evaluation out{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n * n), std::vector<double>(n * n)};
        EXPECT_EQ(v.size(), n);
        device_->eval(v, {}, {out.f, out.q, out.df, out.dq});
        return out;
    }
    Evaluation at(std::initializer_list<double> v) const { return at(std::span(v.begin(), v.size())); }
    double info(std::initializer_list<double> v, std::string_view name) const {
        for (const auto& value : device_->operating_info(std::span(v.begin(), v.size())))
            if (value.name == name) return value.value;
        ADD_FAILURE() << "no " << name;
        return 0;
    }
};

inline double largest(const std::vector<double>& x) {
    double out = 0;
    for (const double each : x) out = std::max(out, std::abs(each));
    return out;
}

/// Random voltages of the unknowns within +-range. The bulk is not more than 0.4 V above or below an end, so that junctions conduct little.
class RandomVoltages {
    std::mt19937_64 random_{7};
    double range_, sign_;

public:
    RandomVoltages(double range, bool pmos) : range_(range), sign_(pmos ? -1 : 1) {}
    std::vector<double> next(std::size_t unknowns) {
        std::uniform_real_distribution<double> any(0, 1);
        std::vector<double> v(unknowns);
        v[0] = range_ * any(random_), v[1] = range_ * (1.4 * any(random_) - 0.4), v[2] = range_ * any(random_);
        if (any(random_) < 0.2) v[2] = v[0] + 0.05 * (any(random_) - 0.5);  // near v_ds = 0
        v[3] = std::min(v[0], v[2]) + (any(random_) < 0.5 ? 0 : 0.7 * any(random_) * (any(random_) < 0.3 ? 0.5 : -range_));
        if (unknowns > 4) v[4] = v[0] - 0.02 * any(random_);
        if (unknowns > 5) v[5] = v[2] + 0.02 * any(random_);
        for (double& x : v) x *= sign_;
        return v;
    }
};

/// Compares slopes with central differences. Where a boundary between two regions lies within the difference, the second derivative jumps,
/// and the difference is in error by that jump times its length.
inline void check_slopes(const MosUnderTest& mos, int points, double range, double tolerance = 3e-5) {
    const auto n = mos.unknowns();
    for (const bool pmos : {false, true}) {
        RandomVoltages voltages(range, pmos);
        for (int k = 0; k < points && !testing::Test::HasFailure(); ++k) {
            auto v = voltages.next(n);
            const auto here = mos.at(v);
            const double h = 1e-5, largest_g = largest(here.df), largest_c = largest(here.dq);
            for (std::size_t column = 0; column < n; ++column) {
                const double centre = v[column];
                v[column] = centre + h;
                const auto up = mos.at(v);
                v[column] = centre - h;
                const auto down = mos.at(v);
                v[column] = centre;
                for (std::size_t row = 0; row < n; ++row) {
                    EXPECT_NEAR(here.g(row, column), (up.f[row] - down.f[row]) / (2 * h), tolerance * largest_g + 1e-11)
                        << "df " << row << ' ' << column << " at point " << k << ", v = " << v[0] << ' ' << v[1] << ' ' << v[2] << ' '
                        << v[3];
                    EXPECT_NEAR(here.c(row, column), (up.q[row] - down.q[row]) / (2 * h), tolerance * largest_c)
                        << "dq " << row << ' ' << column << " at point " << k << ", v = " << v[0] << ' ' << v[1] << ' ' << v[2] << ' '
                        << v[3];
                }
            }
        }
    }
}

inline void check_conservation(const MosUnderTest& mos, int points, double range) {
    RandomVoltages voltages(range, false);
    for (int k = 0; k < points; ++k) {
        const auto v = voltages.next(mos.unknowns());
        const auto here = mos.at(v);
        const auto n = mos.unknowns();
        double f = 0, q = 0;
        for (std::size_t row = 0; row < n; ++row) {
            f += here.f[row], q += here.q[row];
            double g_row = 0, c_row = 0, g_column = 0, c_column = 0;
            for (std::size_t column = 0; column < n; ++column)
                g_row += here.g(row, column), c_row += here.c(row, column), g_column += here.g(column, row),
                    c_column += here.c(column, row);
            for (const double g : {g_row, g_column}) ASSERT_NEAR(g, 0, 1e-13 * largest(here.df));
            for (const double c : {c_row, c_column}) ASSERT_NEAR(c, 0, 1e-13 * largest(here.dq));
        }
        ASSERT_NEAR(f, 0, 1e-15 * largest(here.f));
        ASSERT_NEAR(q, 0, 1e-14 * largest(here.q));
    }
}

inline void check_exchange(const MosUnderTest& mos, int points, double range) {
    RandomVoltages voltages(range, false);
    for (int k = 0; k < points; ++k) {
        const auto v = voltages.next(4);
        const auto here = mos.at(v), there = mos.at({v[2], v[1], v[0], v[3]});
        constexpr std::size_t other[] = {2, 1, 0, 3};
        for (std::size_t row = 0; row < 4; ++row) {
            ASSERT_NEAR(here.f[row], there.f[other[row]], 1e-13 * largest(here.f));
            ASSERT_NEAR(here.q[row], there.q[other[row]], 1e-13 * largest(here.q));
        }
    }
}

inline void check_mirror(const MosUnderTest& nmos, const MosUnderTest& pmos, int points, double range) {
    RandomVoltages voltages(range, false);
    for (int k = 0; k < points; ++k) {
        const auto v = voltages.next(4);
        const auto n = nmos.at(v), p = pmos.at({-v[0], -v[1], -v[2], -v[3]});
        for (std::size_t row = 0; row < 4; ++row) {
            ASSERT_NEAR(n.f[row], -p.f[row], 1e-13 * largest(n.f));
            ASSERT_NEAR(n.q[row], -p.q[row], 1e-13 * largest(n.q));
        }
    }
}

/// True if Debian's ngspice can be started.
inline bool has_ngspice() { return std::system("ngspice --version > /dev/null 2>&1") == 0; }

}  // namespace corpuscle::circuit::test
