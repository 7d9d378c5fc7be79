#include "fit/identifiability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace corpuscle {
namespace {

constexpr double factor_of_two = std::numbers::ln2;  // ln 2; of a parameter that is not logarithmic: this fraction of its bounds

constexpr double negligible_part = 0.05;  // of a parameter in the weak directions

/// The linearized residuals along some unit vectors, block by block.
struct BlockSums {
    std::vector<Vector> gradients;   // of each block with data, along the vectors
    std::vector<Matrix> curvatures;  // likewise
};

/// Sums over blocks. Those without effect, such as pauses, are left out.
BlockSums sums_along(const Linearization& at, std::span<const Vector> vectors) {
    const std::size_t n = vectors.size();
    const auto& [residuals, block, blocks] = at.residuals;
    BlockSums out;
    for (std::size_t begin = 0, end = 0; begin < residuals.size(); begin = end) {
        Vector gradient(n), slopes(n);
        Matrix curvature(n * n);
        double squares = 0;
        for (; end < residuals.size() && block[end] == block[begin]; ++end) {
            for (std::size_t j = 0; j < n; ++j) {
                slopes[j] = 0;
                for (std::size_t k = 0; k < at.size(); ++k) slopes[j] += vectors[j][k] * at.slopes[k][end];
                gradient[j] += slopes[j] * residuals[end], squares += slopes[j] * slopes[j];
            }
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j) curvature[i * n + j] += slopes[i] * slopes[j];
        }
        if (squares > 1e-6) out.gradients.push_back(std::move(gradient)), out.curvatures.push_back(std::move(curvature));
    }
    return out;
}

/// The covariance of the coordinates along eigenvectors with these eigenvalues, by the jackknife: the point moves when the residuals of one
/// block are left out, block after block (Bell & McCaffrey 2002, Survey Methodology 28:169). It allows correlations within a block.
Matrix jackknife_covariance(const BlockSums& sums, std::span<const double> values) {
    constexpr double least_rest = 0.05;  // of the curvature without a block; a block with nearly all of it is not left out as a whole
    const std::size_t n = values.size();
    const double count = static_cast<double>(sums.gradients.size());
    Matrix out(n * n);
    for (std::size_t b = 0; b < sums.gradients.size(); ++b) {
        Matrix rest(n * n);  // scaled so that all blocks together are the unit matrix
        Vector gradient(n), move(n);
        for (std::size_t i = 0; i < n; ++i) {
            gradient[i] = sums.gradients[b][i] / std::sqrt(values[i]);
            for (std::size_t j = 0; j < n; ++j)
                rest[i * n + j] = (i == j) - sums.curvatures[b][i * n + j] / std::sqrt(values[i] * values[j]);
        }
        const auto eigen = symmetric_eigensystem(rest, n);
        for (std::size_t j = 0; j < n; ++j) {
            const double along = dot_product(eigen.vectors[j], gradient) / std::max(eigen.values[j], least_rest);
            for (std::size_t i = 0; i < n; ++i) move[i] += eigen.vectors[j][i] * along / std::sqrt(values[i]);
        }
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) out[i * n + j] += move[i] * move[j] * (count - 1) / count;
    }
    return out;
}

/// The residuals of a number of repetitions.
using Repetitions = std::vector<Vector>;

Result<Repetitions> repeat(const RepetitionFunction& repetition, double noise, std::size_t count) {
    Repetitions out;
    for (std::size_t seed = 0; seed < count; ++seed) out.push_back(fitted_residuals(TRY(repetition(noise, seed))).values);
    return out;
}

/// The move of the point along the eigenvectors that these residuals cause.
Vector move_along(const Linearization& at, const Vector& residuals, std::span<const Vector> vectors, std::span<const double> values) {
    Vector gradient(at.size()), out(values.size());
    for (std::size_t k = 0; k < at.size(); ++k) gradient[k] = dot_product(at.slopes[k], residuals);
    for (std::size_t j = 0; j < values.size(); ++j) out[j] = dot_product(vectors[j], gradient) / values[j];
    return out;
}

/// Mean and variance of the cost of repetitions after a fit of their own.
struct RefittedCost {
    double mean = 0, variance = 0;
    /// The degrees of freedom of a chi-squared variable with this ratio of mean and variance.
    double freedom() const { return variance > 0 ? 2 * mean * mean / variance : 1; }
};

RefittedCost refitted_cost(const Linearization& at, const Repetitions& repetitions, std::span<const Vector> vectors,
                           std::span<const double> values) {
    const double count = static_cast<double>(repetitions.size());
    RefittedCost out;
    double squares = 0;
    for (const auto& residuals : repetitions) {
        const auto move = move_along(at, residuals, vectors, values);
        double cost = dot_product(residuals, residuals);
        for (std::size_t j = 0; j < move.size(); ++j) cost -= move[j] * move[j] * values[j];
        out.mean += cost / count, squares += cost * cost / count;
    }
    out.variance = std::max(0.0, squares - out.mean * out.mean);
    return out;
}

/// Repetitions with the noise at which the refitted cost is that of the data. If even the least noise gives more, as an irregular afferent
/// may, repetitions with that; none, if no noise is enough.
Result<Repetitions> repetitions_like(const Linearization& at, const RepetitionFunction& repetition, std::span<const Vector> vectors,
                                     std::span<const double> values) {
    constexpr double least = 1e-15, most = 1e-3;  // noise, A
    constexpr std::size_t few = 8, many = 60;     // repetitions to find the noise, and for the result
    const double cost = dot_product(at.residuals.values, at.residuals.values);
    const auto is_below = [&](double noise) -> Result<bool> {
        return refitted_cost(at, TRY(repeat(repetition, noise, few)), vectors, values).mean < cost;
    };
    double low = least, high = least;
    while (high < most && TRY(is_below(high))) low = high, high *= 4;
    if (high == least) return repeat(repetition, least, many);
    if (high >= most) return Repetitions();
    for (int pass = 0; pass < 6; ++pass) {
        const double middle = std::sqrt(low * high);
        (TRY(is_below(middle)) ? low : high) = middle;
    }
    return repeat(repetition, high, many);
}

/// The covariance of the coordinates along eigenvectors with these eigenvalues, from repetitions. Unlike the jackknife this allows
/// correlations over any time, such as those of spikes after a late one.
Matrix repeated_covariance(const Linearization& at, const Repetitions& repetitions, std::span<const Vector> vectors,
                           std::span<const double> values) {
    const std::size_t n = values.size();
    Matrix out(n * n);
    for (const auto& residuals : repetitions) {
        const auto move = move_along(at, residuals, vectors, values);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) out[i * n + j] += move[i] * move[j] / static_cast<double>(repetitions.size());
    }
    return out;
}

/// The covariance if the deviations of the residuals are known, enlarged if the residuals are larger than these say.
Matrix known_covariance(const Linearization& at, std::span<const double> values) {
    const std::size_t n = values.size();
    const double freedom = static_cast<double>(at.residuals.values.size()) - static_cast<double>(at.size());
    const double scale = freedom > 0 ? std::max(1.0, dot_product(at.residuals.values, at.residuals.values) / freedom) : 1.0;
    Matrix out(n * n);
    for (std::size_t i = 0; i < n; ++i) out[i * n + i] = scale / values[i];
    return out;
}

/// The curvature of the cost along a direction, over a factor of two: the smaller one of both sides. The slopes underestimate it where the
/// residuals are counts of spikes, which change in steps.
double curvature_along(const ResidualFunction& residuals, std::span<const FreeParameter> parameters, std::span<const double> point,
                       const Vector& direction, double cost) {
    double least = std::numeric_limits<double>::infinity();
    for (const double sign : {-1.0, 1.0}) {
        Vector to(point.begin(), point.end());
        double squares = 0;
        for (std::size_t k = 0; k < to.size(); ++k) {
            const double width = parameters[k].width();
            to[k] = std::clamp(to[k] + sign * factor_of_two * direction[k] / width, 0.0, 1.0);
            squares += (to[k] - point[k]) * (to[k] - point[k]) * width * width;
        }
        const auto there = residuals(to);
        if (there && squares > 0) least = std::min(least, (cost_of(*there) - cost) / squares);
    }
    return std::isfinite(least) ? least : 0;
}

/// The factor from a standard deviation to half a 95 % interval: Student's t, approximated to 3 % from 3 degrees of freedom.
double t_factor(double freedom) {
    freedom = std::max(1.0, freedom);
    return 1.96 + 2.4 / freedom + 3 / (freedom * freedom);
}

/// v' M w
double form(const Matrix& m, const Vector& v, const Vector& w) {
    const std::size_t n = v.size();
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) sum += v[i] * m[i * n + j] * w[j];
    return sum;
}

/// A covariance along eigenvectors, and the factor from a standard deviation to half a 95 % interval.
struct IntervalEstimate {
    Matrix covariance;
    double factor;
};

Result<std::vector<IntervalEstimate>> interval_estimates(const Linearization& at, const RepetitionFunction& repetition,
                                                         std::span<const Vector> vectors, std::span<const double> values,
                                                         bool has_known_deviations) {
    if (has_known_deviations) return std::vector<IntervalEstimate>{{known_covariance(at, values), 1.96}};
    const auto sums = sums_along(at, vectors);
    std::vector<IntervalEstimate> out = {
        {jackknife_covariance(sums, values), t_factor(static_cast<double>(sums.gradients.size()) - static_cast<double>(at.size()))}};
    if (!repetition) return out;
    if (const auto repetitions = TRY(repetitions_like(at, repetition, vectors, values)); !repetitions.empty())
        out.push_back(
            {repeated_covariance(at, repetitions, vectors, values), t_factor(refitted_cost(at, repetitions, vectors, values).freedom())});
    return out;
}

}  // namespace

Result<Identifiability> identifiability(const ResidualFunction& residuals, std::span<const FreeParameter> parameters,
                                        std::span<const double> point, double slope_effect, bool has_known_deviations,
                                        const RepetitionFunction& repetition) {
    const std::size_t n = parameters.size();
    const auto at = TRY(linearize(residuals, parameters, point, slope_effect));
    auto eigen = symmetric_eigensystem(at.JJ, n);
    const double cost = dot_product(at.residuals.values, at.residuals.values);
    for (std::size_t j = 0; j < n && has_known_deviations; ++j)
        eigen.values[j] = std::max(eigen.values[j], curvature_along(residuals, parameters, point, eigen.vectors[j], cost));
    Identifiability out;
    // The directions in which a factor of two has an effect.
    std::vector<double> values;
    std::vector<Vector> vectors;
    for (std::size_t j = 0; j < n; ++j) {
        if (eigen.values[j] * factor_of_two * factor_of_two > negligible_cost)
            values.push_back(eigen.values[j]), vectors.push_back(eigen.vectors[j]);
        else
            out.weak.push_back({eigen.vectors[j]});
    }
    const auto estimates = TRY(interval_estimates(at, repetition, vectors, values, has_known_deviations));
    const auto half_width = [&](const Vector& along) {
        double largest = 0;
        for (const auto& e : estimates) largest = std::max(largest, e.factor * std::sqrt(std::max(0.0, form(e.covariance, along, along))));
        return largest;
    };
    std::vector<bool> is_strong(values.size());
    for (std::size_t j = 0; j < values.size(); ++j) {
        Vector along(values.size());
        along[j] = 1;
        is_strong[j] = half_width(along) < factor_of_two;
        if (!is_strong[j]) out.weak.push_back({vectors[j]});
    }
    for (std::size_t i = 0; i < n; ++i) {
        double weak_part = 0;
        for (const auto& w : out.weak) weak_part += w.direction[i] * w.direction[i];
        Vector along(values.size());
        for (std::size_t j = 0; j < values.size(); ++j) along[j] = is_strong[j] ? vectors[j][i] : 0;
        const double width = half_width(along);
        out.parameters.push_back({weak_part < negligible_part && width < factor_of_two, width});
    }
    return out;
}

}  // namespace corpuscle
