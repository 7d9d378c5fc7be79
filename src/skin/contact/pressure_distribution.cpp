#include "skin/contact/indenters.hpp"

#include <algorithm>

#include "core/number/elementary.hpp"

namespace corpuscle {
namespace {

constexpr double pi = 3.141592653589793;

// Integrals over a circular arc. They do not use the C library's mathematics, so the results have the same bits on every machine.

/// arcsin u for |u| <= 1/2, where z must be u^2; error below 1e-9. It is the Taylor series, evaluated in three independent parts.
double small_arcsine(double u, double z) {
    const double z2 = z * z, z4 = z2 * z2;
    const double low = (1 + z * (1.0 / 6)) + z2 * (3.0 / 40 + z * (15.0 / 336));
    const double middle = (105.0 / 3456 + z * (945.0 / 42240)) + z2 * (10395.0 / 599040 + z * (135135.0 / 9676800));
    const double high = (2027025.0 / 175472640 + z * (34459425.0 / 3530096640)) + z2 * (0.00839033 + z * 0.0073125);
    return u * (low + z4 * (middle + z4 * high));
}

/// arcsin u; for u outside [-1, 1] the value at -1 or 1.
double arcsine(double u) {
    constexpr double half_pi = 1.5707963267948966;
    const double magnitude = num::abs(u);
    if (magnitude >= 1) return u > 0 ? half_pi : -half_pi;
    if (magnitude <= 0.5) return small_arcsine(u, u * u);
    const double z = 0.5 * (1 - magnitude), angle = half_pi - 2 * small_arcsine(num::sqrt(z), z);
    return u > 0 ? angle : -angle;
}

/// Twice the area below the half circle sqrt(1 - t^2) between t = 0 and t = u, for |u| <= 1; negative for u < 0.
double arc_area(double u) {
    const double square = 1 - u * u;
    return arcsine(u) + (square > 0 ? u * num::sqrt(square) : 0);
}

/// PressureDistribution::column() of a round contact of radius a. The pressure is integrated exactly along y, on the chord at x, and by
/// two-point Gauss quadrature along x. The integral along a full chord is a polynomial of x (constant or of degree 2), for which this
/// quadrature is exact. So the fractions of all cells add up to 1. Let c be half the length of the chord. chord(y / c) times
/// chord.scale(c^2) is the integral of the pressure from the middle of the chord to y.
template <class Chord>
void round_column(double a, double x0, double side, std::span<const double> y, double* fractions, Chord&& chord) {
    constexpr double gauss_points[] = {-0.5773502691896257, 0.5773502691896257};
    const std::size_t cells = y.size() - 1;
    std::fill(fractions, fractions + cells, 0.0);
    const double from = std::max(x0, -a), to = std::min(x0 + side, a);
    if (!(to > from)) return;
    for (const double point : gauss_points) {
        const double x = 0.5 * (from + to) + 0.5 * (to - from) * point, square = a * a - x * x;  // square: c^2
        if (!(square > 0)) continue;
        const double per_half = 1 / num::sqrt(square), scale = 0.5 * (to - from) * chord.scale(square);
        double below = chord(y[0] * per_half);
        for (std::size_t c = 0; c < cells; ++c) {
            const double above = chord(y[c + 1] * per_half);
            fractions[c] += scale * (above - below);
            below = above;
        }
    }
}

/// Tangential over normal displacement by equal forces, (2 - nu) / (2 - 2 nu), for incompressible skin.
constexpr double tangential_compliance = 1.5;

/// Pressure p per force F: p/F = 1/(2 pi a^2) (1 - r^2/a^2)^(-1/2) at distance r from the centre. Its integral along a chord is an arcsine.
class FlatPressure final : public PressureDistribution {
    double a_, per_metre_;  // m; normal force by which the punch sinks in, N/m
    struct Chord {
        double a;
        double operator()(double u) const { return arcsine(u); }
        double scale(double) const { return 1 / (2 * pi * a); }
    };

public:
    explicit FlatPressure(const ContactParams& p) : a_(p.radius), per_metre_(2 * p.radius * p.E_star) {}
    double size(double) const override { return a_; }
    double stuck_force(double force, double displacement) const override {
        return std::max(0.0, force - per_metre_ / tangential_compliance * displacement);
    }
    HalfBox box(double a) const override { return {a, a}; }
    void column(double a, double, double x0, double side, std::span<const double> y, double* fractions) const override {
        round_column(a, x0, side, y, fractions, Chord{a});
    }
};

/// x^(1/3) for x > 0, by Newton's method: accurate to a few units in the last place, and the same on every machine.
double cube_root(double x) {
    double r = num::exp(num::log(x) * (1.0 / 3));
    for (int k = 0; k < 2; ++k) r -= (r * r * r - x) / (3 * r * r);
    return r;
}

/// Pressure p per force F: p/F = 3/(2 pi a^3) (a^2 - r^2)^(1/2) at distance r from the centre. Its integral along a chord of half length c
/// is c^2/2 times arc_area(), apart from the constant factor.
class SpherePressure final : public PressureDistribution {
    double radius_, per_newton_;  // m; a^3 / F, m3/N
    struct Chord {
        double a;
        double operator()(double u) const { return arc_area(std::clamp(u, -1.0, 1.0)); }
        double scale(double square) const { return 3 / (4 * pi * a * a * a) * square; }
    };

public:
    explicit SpherePressure(const ContactParams& p) : radius_(p.radius), per_newton_(3 * p.radius / (4 * p.E_star)) {}
    double size(double force) const override { return cube_root(per_newton_ * force); }
    double stuck_force(double force, double displacement) const override {  // it sinks in by a^2 / R
        const double a = size(force), square = a * a - displacement * radius_ / tangential_compliance;
        return square > 0 ? square * num::sqrt(square) / per_newton_ : 0;
    }
    HalfBox box(double a) const override { return {a, a}; }
    void column(double a, double, double x0, double side, std::span<const double> y, double* fractions) const override {
        round_column(a, x0, side, y, fractions, Chord{a});
    }
};

/// Coordinates along and across a direction, in degrees from the x axis. Each cell is treated as if it were rotated with the direction.
struct Rotation {
    double c, s;  // cosine and sine
    explicit Rotation(double degrees) : c(num::cos_turns(degrees / 360)), s(num::sin_turns(degrees / 360)) {}
    double along(double x, double y) const { return x * c + y * s; }
    double across(double x, double y) const { return y * c - x * s; }
};

/// The length of the intersection of [from, to] and [low, high].
double overlap(double from, double to, double low, double high) { return std::max(0.0, std::min(to, high) - std::max(from, low)); }

/// The contact of an edge of length L; its size b is half its width. Pressure p per force F: p/F = 2/(pi b L) (1 - d^2/b^2)^(1/2) at
/// distance d from the centre line, constant along the edge.
class EdgePressure final : public PressureDistribution {
    double half_length_, per_newton_;  // L / 2, m; b^2 / F, m2/N
    Rotation rotation_;

public:
    explicit EdgePressure(const ContactParams& p)
        : half_length_(0.5 * p.length), per_newton_(4 * p.edge_radius / (pi * p.length * p.E_star)), rotation_(p.angle) {}
    double size(double force) const override { return num::sqrt(per_newton_ * force); }
    HalfBox box(double b) const override {
        const double c = num::abs(rotation_.c), s = num::abs(rotation_.s);
        return {half_length_ * c + b * s, half_length_ * s + b * c};
    }
    void column(double b, double, double x0, double side, std::span<const double> y, double* fractions) const override {
        const double half = 0.5 * side, x = x0 + half;
        for (std::size_t c = 0; c + 1 < y.size(); ++c) {
            const double middle = y[c] + half, along = rotation_.along(x, middle), across = rotation_.across(x, middle);
            fractions[c] = 0;
            const double covered_length = overlap(along - half, along + half, -half_length_, half_length_);
            if (covered_length == 0 || num::abs(across) >= b + half) continue;
            const auto arc = [b](double d) { return arc_area(std::clamp(d / b, -1.0, 1.0)); };
            fractions[c] = covered_length * (arc(across + half) - arc(across - half));
        }
    }
};

/// Uniform pressure on the ridges of a grating within a round patch.
class GratingPressure final : public PressureDistribution {
    double radius_, period_, ridge_, side_;  // m; ridge_: width of a ridge; side_: side of a cell
    Rotation rotation_;

    /// Total width of the ridges between 0 and d, m; a ridge begins at 0.
    double ridges(double d) const {
        const double periods = std::floor(d / period_);
        return periods * ridge_ + std::min(d - periods * period_, ridge_);
    }

public:
    GratingPressure(const ContactParams& p, double side)
        : radius_(p.radius), period_(p.period), ridge_(p.ridge), side_(side), rotation_(p.angle) {}
    double size(double) const override { return radius_; }
    HalfBox box(double radius) const override { return {radius + 0.5 * side_, radius + 0.5 * side_}; }
    void column(double radius, double shift, double x0, double side, std::span<const double> y, double* fractions) const override {
        const double half = 0.5 * side, x = x0 + half, reach = radius + half;
        for (std::size_t c = 0; c + 1 < y.size(); ++c) {
            const double middle = y[c] + half, square = x * x + middle * middle;
            fractions[c] = 0;
            if (square >= reach * reach) continue;
            const double inside = std::min(1.0, (reach - num::sqrt(square)) / side);  // fraction of the cell that is in the patch
            const double along = rotation_.along(x, middle) - shift;
            fractions[c] = inside * (ridges(along + half) - ridges(along - half));
        }
    }
};

}  // namespace

std::unique_ptr<PressureDistribution> make_pressure_distribution(const Indenter& indenter, const ContactParams& p, double side) {
    if (indenter.name == "flat") return std::make_unique<FlatPressure>(p);
    if (indenter.name == "sphere") return std::make_unique<SpherePressure>(p);
    if (indenter.name == "edge") return std::make_unique<EdgePressure>(p);
    return std::make_unique<GratingPressure>(p, side);
}

}  // namespace corpuscle
