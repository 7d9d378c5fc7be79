#include "study/sweep/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "study/sweep/probability.hpp"

namespace corpuscle {
namespace {

constexpr int most_rounds = 6;
constexpr std::size_t most_influences = 60;

/// Numbers of the units that have the measure, with mean 0 and squares that sum to 1; or nothing, if they are all the same.
std::vector<double> standardised(std::span<const double> all, const std::vector<std::size_t>& units) {
    std::vector<double> out(units.size());
    double sum = 0, squares = 0;
    for (std::size_t k = 0; k < units.size(); ++k) sum += out[k] = all[units[k]];
    const double mean = sum / static_cast<double>(units.size());
    for (auto& x : out) x -= mean, squares += x * x;
    if (!(squares > 1e-24 * mean * mean * static_cast<double>(units.size()))) return {};
    for (auto& x : out) x /= std::sqrt(squares);
    return out;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// A x = b and the inverse's diagonal, A symmetric and positive; false if it is not.
bool solve(std::vector<std::vector<double>> A, std::vector<double>& b, std::vector<double>& diagonal) {
    const std::size_t n = b.size();
    for (std::size_t j = 0; j < n; ++j)  // Cholesky: A = L L^T
        for (std::size_t i = j; i < n; ++i) {
            double sum = A[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= A[i][k] * A[j][k];
            if (i == j && !(sum > 1e-12)) return false;
            A[i][j] = i == j ? std::sqrt(sum) : sum / A[j][j];
        }
    const auto forth = [&](std::vector<double>& v) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < i; ++k) v[i] -= A[i][k] * v[k];
            v[i] /= A[i][i];
        }
    };
    forth(b);
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= A[k][i] * b[k];
        b[i] /= A[i][i];
    }
    diagonal.assign(n, 0);
    for (std::size_t j = 0; j < n; ++j) {
        std::vector<double> unit(n);
        unit[j] = 1;
        forth(unit);
        diagonal[j] = product(unit, unit);
    }
    return true;
}

/// The plane through the factors that were taken.
struct Plane {
    std::vector<std::size_t> taken;
    std::vector<std::vector<double>> x;  ///< of each that was taken, standardised
    std::vector<double> slopes, diagonal, rest;

    bool lay(const std::vector<double>& y) {
        std::vector<std::vector<double>> A(x.size(), std::vector<double>(x.size()));
        slopes.resize(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            slopes[i] = product(x[i], y);
            for (std::size_t j = 0; j <= i; ++j) A[i][j] = A[j][i] = product(x[i], x[j]);
        }
        if (!solve(std::move(A), slopes, diagonal)) return false;
        rest = y;
        for (std::size_t i = 0; i < x.size(); ++i)
            for (std::size_t k = 0; k < y.size(); ++k) rest[k] -= slopes[i] * x[i][k];
        return true;
    }
};

struct Candidate {
    std::size_t factor;
    double chance;
    std::vector<double> x = {};
};

/// Those that Benjamini and Hochberg's procedure takes, the surest first.
void keep_discoveries(std::vector<Candidate>& all, std::size_t tried) {
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return std::pair(a.chance, a.factor) < std::pair(b.chance, b.factor); });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < all.size(); ++k)
        if (all[k].chance <= false_discoveries * static_cast<double>(k + 1) / static_cast<double>(tried)) kept = k + 1;
    all.resize(kept);
}

/// All at once; if that cannot be, one after another without those that are made of the ones before them. False: none was taken.
bool take(Plane& plane, std::vector<Candidate>&& found, std::size_t most, const std::vector<double>& y) {
    const auto before = plane.taken.size();
    if (before < most && found.size() > most - before) found.resize(most - before);
    for (auto& c : found) plane.taken.push_back(c.factor), plane.x.push_back(c.x);
    if (found.empty() || plane.lay(y)) return !found.empty();
    plane.taken.resize(before), plane.x.resize(before);
    for (auto& c : found) {
        plane.taken.push_back(c.factor), plane.x.push_back(std::move(c.x));
        if (!plane.lay(y)) plane.taken.pop_back(), plane.x.pop_back();
    }
    plane.lay(y);
    return plane.taken.size() > before;
}

}  // namespace

Sensitivity sensitivity_of(std::span<const double> measure, std::span<const SweepFactor> factors) {
    std::vector<std::size_t> units;
    for (std::size_t k = 0; k < measure.size(); ++k)
        if (std::isfinite(measure[k])) units.push_back(k);
    const auto n = static_cast<double>(units.size());
    Sensitivity out{units.size(), factors.size()};
    const auto y = units.size() < 8 ? std::vector<double>() : standardised(measure, units);
    if (y.empty()) return out;
    double mean = 0, squares = 0;
    for (const auto k : units) mean += measure[k] / n;
    for (const auto k : units) squares += (measure[k] - mean) * (measure[k] - mean);
    out.variance = squares / (n - 1);

    Plane plane;
    plane.rest = y;
    double left = 1;  // of the sum of squares
    for (int round = 0; round < most_rounds && plane.taken.size() < most_influences; ++round) {
        const double freedom = n - 2 - static_cast<double>(plane.taken.size());
        if (freedom < 4 || left < 1e-9) break;
        std::vector<Candidate> found;
        std::size_t tried = 0;
        for (std::size_t f = 0; f < factors.size(); ++f) {
            if (std::find(plane.taken.begin(), plane.taken.end(), f) != plane.taken.end()) continue;
            auto x = standardised(factors[f], units);
            if (x.empty()) continue;
            ++tried;
            const double r = std::clamp(product(x, plane.rest) / std::sqrt(left), -1.0, 1.0);
            const double chance = student_two_sided(freedom, r * std::sqrt(freedom / std::max(1 - r * r, 1e-300)));
            if (chance <= false_discoveries) found.push_back({f, chance, std::move(x)});
        }
        keep_discoveries(found, tried);
        const auto room = static_cast<std::size_t>(n / 4);  // a plane through as many factors as units explains anything
        if (!take(plane, std::move(found), std::min(room, most_influences), y)) break;
        left = product(plane.rest, plane.rest);
    }

    const double freedom = n - 1 - static_cast<double>(plane.taken.size()), noise = left / freedom;
    const double far = student_quantile(freedom, 1 - (1 - confidence) / 2);
    for (std::size_t i = 0; i < plane.taken.size(); ++i) {
        const double b = plane.slopes[i], error = std::sqrt(noise * plane.diagonal[i]), low = std::max(std::abs(b) - far * error, 0.0);
        Influence one{plane.taken[i], b * std::sqrt(out.variance), {std::max(b * b - error * error, 0.0), low * low, 0}};
        one.share.high = std::min((std::abs(b) + far * error) * (std::abs(b) + far * error), 1.0);
        one.chance = error > 0 ? student_two_sided(freedom, b / error) : 0;
        out.influences.push_back(one);
    }
    out.explained = plane.taken.empty() ? 0 : std::max(1 - noise * (n - 1), 0.0);
    std::sort(out.influences.begin(), out.influences.end(),
              [](const auto& a, const auto& b) { return std::pair(-a.share.value, a.factor) < std::pair(-b.share.value, b.factor); });
    return out;
}

Between between_groups(std::span<const double> measure, std::span<const std::size_t> group, std::size_t groups) {
    std::vector<double> sums(groups), counts(groups);
    double sum = 0, n = 0, squares = 0, inside = 0;
    for (std::size_t k = 0; k < measure.size(); ++k)
        if (std::isfinite(measure[k])) sum += measure[k], ++n, sums[group[k]] += measure[k], ++counts[group[k]];
    const auto used = static_cast<double>(std::count_if(counts.begin(), counts.end(), [](double c) { return c > 0; }));
    if (used < 2 || n <= used) return {};
    for (std::size_t k = 0; k < measure.size(); ++k) {
        if (!std::isfinite(measure[k])) continue;
        const double off = measure[k] - sum / n, own = measure[k] - sums[group[k]] / counts[group[k]];
        squares += off * off, inside += own * own;
    }
    if (!(squares > 0)) return {};
    const double noise = inside / (n - used), between = squares - inside;
    return {std::max((between - (used - 1) * noise) / (squares + noise), 0.0),
            noise > 0 ? fisher_upper(used - 1, n - used, between / (used - 1) / noise) : 0};
}

double sigma_with_four_times_the_area(double share_of_device) { return std::sqrt(std::max(1 - 0.75 * share_of_device, 0.0)); }

}  // namespace corpuscle
