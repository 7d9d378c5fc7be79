#include "sweep/stats/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sweep/spec/probability.hpp"

namespace corpuscle {
namespace {

constexpr int max_rounds = 6;  // of adding factors
constexpr std::size_t max_influences = 60;

/// The values of these items, shifted to mean 0 and scaled to sum of squares 1; empty if they are all equal.
std::vector<double> standardised(std::span<const double> all, const std::vector<std::size_t>& items) {
    std::vector<double> out(items.size());
    double sum = 0, squares = 0;
    for (std::size_t k = 0; k < items.size(); ++k) sum += out[k] = all[items[k]];
    const double mean = sum / static_cast<double>(items.size());
    for (auto& x : out) x -= mean, squares += x * x;
    if (!(squares > 1e-24 * mean * mean * static_cast<double>(items.size()))) return {};
    for (auto& x : out) x /= std::sqrt(squares);
    return out;
}

double dot_product(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Solves A x = b for a symmetric positive definite A. On return, b contains x, and `diagonal` the diagonal of A's inverse. Returns false
/// if A is not positive definite.
bool solve(std::vector<std::vector<double>> A, std::vector<double>& b, std::vector<double>& diagonal) {
    const std::size_t n = b.size();
    for (std::size_t j = 0; j < n; ++j)  // Cholesky: A = L L^T
        for (std::size_t i = j; i < n; ++i) {
            double sum = A[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= A[i][k] * A[j][k];
            if (i == j && !(sum > 1e-12)) return false;
            A[i][j] = i == j ? std::sqrt(sum) : sum / A[j][j];
        }
    const auto forward_substitute = [&](std::vector<double>& v) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < i; ++k) v[i] -= A[i][k] * v[k];
            v[i] /= A[i][i];
        }
    };
    forward_substitute(b);
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= A[k][i] * b[k];
        b[i] /= A[i][i];
    }
    diagonal.assign(n, 0);
    for (std::size_t j = 0; j < n; ++j) {
        std::vector<double> unit(n);
        unit[j] = 1;
        forward_substitute(unit);
        diagonal[j] = dot_product(unit, unit);
    }
    return true;
}

/// The linear regression on the selected factors.
struct Regression {
    std::vector<std::size_t> selected;   ///< indexes of the factors
    std::vector<std::vector<double>> x;  ///< standardised values of each selected factor
    std::vector<double> slopes;          ///< of each selected factor, in standardised units
    std::vector<double> diagonal;        ///< of the inverse of the factors' correlation matrix; slope i has a variance proportional to it
    std::vector<double> residual;        ///< of each item, in standardised units

    /// `y`: the standardised measure. Returns false if the selected factors are linearly dependent.
    bool fit(const std::vector<double>& y) {
        std::vector<std::vector<double>> A(x.size(), std::vector<double>(x.size()));
        slopes.resize(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            slopes[i] = dot_product(x[i], y);
            for (std::size_t j = 0; j <= i; ++j) A[i][j] = A[j][i] = dot_product(x[i], x[j]);
        }
        if (!solve(std::move(A), slopes, diagonal)) return false;
        residual = y;
        for (std::size_t i = 0; i < x.size(); ++i)
            for (std::size_t k = 0; k < y.size(); ++k) residual[k] -= slopes[i] * x[i][k];
        return true;
    }
};

/// A factor that may be added to the regression.
struct Candidate {
    std::size_t factor;
    double p_value;
    std::vector<double> x = {};  // its standardised values
};

/// Keeps the candidates accepted by the procedure of Benjamini and Hochberg, the most significant first. `tried`: number of factors that
/// were tested to find the candidates.
void keep_discoveries(std::vector<Candidate>& all, std::size_t tried) {
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return std::pair(a.p_value, a.factor) < std::pair(b.p_value, b.factor); });
    std::size_t accepted = 0;
    for (std::size_t k = 0; k < all.size(); ++k)
        if (all[k].p_value <= false_discovery_rate * static_cast<double>(k + 1) / static_cast<double>(tried)) accepted = k + 1;
    all.resize(accepted);
}

/// Adds the candidates to the regression. If it had fewer than `limit` factors before, it has at most `limit` afterwards. If the regression
/// is then singular, adds them one at a time and skips those that are linearly dependent on earlier ones. Returns false if no factor was
/// added.
bool add_factors(Regression& regression, std::vector<Candidate>&& found, std::size_t limit, const std::vector<double>& y) {
    const auto before = regression.selected.size();
    if (before < limit && found.size() > limit - before) found.resize(limit - before);
    for (auto& c : found) regression.selected.push_back(c.factor), regression.x.push_back(c.x);
    if (found.empty() || regression.fit(y)) return !found.empty();
    regression.selected.resize(before), regression.x.resize(before);
    for (auto& c : found) {
        regression.selected.push_back(c.factor), regression.x.push_back(std::move(c.x));
        if (!regression.fit(y)) regression.selected.pop_back(), regression.x.pop_back();
    }
    regression.fit(y);
    return regression.selected.size() > before;
}

}  // namespace

Sensitivity sensitivity_of(std::span<const double> measure, std::span<const SweepFactor> factors, std::span<const SweepFactor> more) {
    std::vector<std::size_t> items;
    for (std::size_t k = 0; k < measure.size(); ++k)
        if (std::isfinite(measure[k])) items.push_back(k);
    const auto n = static_cast<double>(items.size());
    Sensitivity out{items.size(), factors.size() + more.size()};
    const auto y = items.size() < 8 ? std::vector<double>() : standardised(measure, items);
    if (y.empty()) return out;
    double mean = 0, squares = 0;
    for (const auto k : items) mean += measure[k] / n;
    for (const auto k : items) squares += (measure[k] - mean) * (measure[k] - mean);
    out.variance = squares / (n - 1);

    Regression regression;
    regression.residual = y;
    double unexplained = 1;  // sum of the squared residuals, as a fraction of that of y
    for (int round = 0; round < max_rounds && regression.selected.size() < max_influences; ++round) {
        const double degrees_of_freedom = n - 2 - static_cast<double>(regression.selected.size());
        if (degrees_of_freedom < 4 || unexplained < 1e-9) break;
        std::vector<Candidate> found;
        std::size_t tried = 0;
        for (std::size_t f = 0; f < out.factors; ++f) {
            if (std::find(regression.selected.begin(), regression.selected.end(), f) != regression.selected.end()) continue;
            auto x = standardised(f < factors.size() ? factors[f] : more[f - factors.size()], items);
            if (x.empty()) continue;
            ++tried;
            const double r = std::clamp(dot_product(x, regression.residual) / std::sqrt(unexplained), -1.0, 1.0);
            const double p_value = student_two_sided(degrees_of_freedom, r * std::sqrt(degrees_of_freedom / std::max(1 - r * r, 1e-300)));
            if (p_value <= false_discovery_rate) found.push_back({f, p_value, std::move(x)});
        }
        keep_discoveries(found, tried);
        const auto max_factors = static_cast<std::size_t>(n / 4);  // with as many factors as items, any measure would be explained
        if (!add_factors(regression, std::move(found), std::min(max_factors, max_influences), y)) break;
        unexplained = dot_product(regression.residual, regression.residual);
    }

    const double degrees_of_freedom = n - 1 - static_cast<double>(regression.selected.size()),
                 noise = unexplained / degrees_of_freedom;  // variance of the residual
    const double t_limit = student_quantile(degrees_of_freedom, 1 - (1 - confidence) / 2);
    for (std::size_t i = 0; i < regression.selected.size(); ++i) {
        const double b = regression.slopes[i], error = std::sqrt(noise * regression.diagonal[i]),
                     low = std::max(std::abs(b) - t_limit * error, 0.0);
        Influence one{regression.selected[i], b * std::sqrt(out.variance), {std::max(b * b - error * error, 0.0), low * low, 0}};
        one.fraction.high = std::min((std::abs(b) + t_limit * error) * (std::abs(b) + t_limit * error), 1.0);
        one.p_value = error > 0 ? student_two_sided(degrees_of_freedom, b / error) : 0;
        out.influences.push_back(one);
    }
    out.explained = regression.selected.empty() ? 0 : std::max(1 - noise * (n - 1), 0.0);
    std::sort(out.influences.begin(), out.influences.end(),
              [](const auto& a, const auto& b) { return std::pair(-a.fraction.value, a.factor) < std::pair(-b.fraction.value, b.factor); });
    return out;
}

GroupMeans group_means(std::span<const double> values, std::span<const std::size_t> group, std::size_t groups) {
    GroupMeans out{std::vector<double>(groups), std::vector<double>(groups)};
    for (std::size_t k = 0; k < values.size(); ++k)
        if (group[k] < groups && std::isfinite(values[k])) out.means[group[k]] += values[k], ++out.counts[group[k]];
    for (std::size_t g = 0; g < groups; ++g) out.means[g] = out.counts[g] > 0 ? out.means[g] / out.counts[g] : Estimate::none;
    return out;
}

GroupEffect group_effect(std::span<const double> measure, std::span<const std::size_t> group, std::size_t groups) {
    const auto [means, counts] = group_means(measure, group, groups);
    double sum = 0, n = 0, squares = 0, inside = 0;  // squares, inside: sums of squares in total, and inside the groups
    for (const double x : measure)
        if (std::isfinite(x)) sum += x, ++n;
    const auto used_groups = static_cast<double>(std::count_if(counts.begin(), counts.end(), [](double c) { return c > 0; }));
    if (used_groups < 2 || n <= used_groups) return {};
    for (std::size_t k = 0; k < measure.size(); ++k) {
        if (!std::isfinite(measure[k])) continue;
        const double deviation = measure[k] - sum / n, deviation_in_group = measure[k] - means[group[k]];
        squares += deviation * deviation, inside += deviation_in_group * deviation_in_group;
    }
    if (!(squares > 0)) return {};
    const double noise = inside / (n - used_groups), between = squares - inside;
    return {std::max((between - (used_groups - 1) * noise) / (squares + noise), 0.0),
            noise > 0 ? fisher_upper(used_groups - 1, n - used_groups, between / (used_groups - 1) / noise) : 0};
}

// Half the mismatch is a quarter of the variance due to the device.
double relative_sigma_at_four_times_area(double fraction_of_device) { return std::sqrt(std::max(1 - 0.75 * fraction_of_device, 0.0)); }

}  // namespace corpuscle
