#include "sweep/spec/probability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace corpuscle {
namespace {

constexpr double beta_accuracy = 1e-15;  // relative

/// The continued fraction of I_x(a, b), by Lentz's method (DLMF 8.17.22); converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
    constexpr double tiny = 1e-300;
    const auto nonzero = [](double v) { return std::abs(v) < tiny ? tiny : v; };
    double c = 1, d = 1 / nonzero(1 - (a + b) * x / (a + 1)), h = d;
    for (int m = 1; m < 100000; ++m) {
        for (const double e :
             {m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)), -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))}) {
            d = 1 / nonzero(1 + e * d), c = nonzero(1 + e / c);
            h *= c * d;
        }
        if (std::abs(c * d - 1) < beta_accuracy) break;
    }
    return h;
}

double log_beta(double a, double b) { return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b); }

}  // namespace

double normal_quantile(double p) {
    if (!(p > 0 && p < 1)) return p == 0 || p == 1 ? (p - 0.5) * std::numeric_limits<double>::infinity() : std::nan("");
    // An initial value after Abramowitz and Stegun 26.2.23, then Halley steps on erfc.
    const double smaller_tail = std::min(p, 1 - p), t = std::sqrt(-2 * std::log(smaller_tail));
    double x = -(t - (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308))));
    for (int k = 0; k < 3; ++k) {
        const double off =  // error in probability, divided by the density
            (0.5 * std::erfc(-x / std::sqrt(2.0)) - smaller_tail) * std::sqrt(2 * 3.14159265358979323846) * std::exp(x * x / 2);
        x -= off / (1 + x * off / 2);
    }
    return p < 0.5 ? x : -x;
}

double incomplete_beta(double a, double b, double x) {
    if (x <= 0 || x >= 1) return x <= 0 ? 0 : 1;
    const double front = std::exp(a * std::log(x) + b * std::log1p(-x) - log_beta(a, b));
    return x < (a + 1) / (a + b + 2) ? front * beta_fraction(a, b, x) / a : 1 - front * beta_fraction(b, a, 1 - x) / b;
}

double beta_quantile(double a, double b, double p) {
    double low = 0, high = 1;
    while (high - low > 2e-16 * high) {  // bisection: about 60 steps, more only for values close to 0
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high || high < 1e-290) break;
        (incomplete_beta(a, b, middle) < p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double binomial_up_to(double k, double n, double p) { return k < 0 ? 0 : k >= n ? 1 : 1 - incomplete_beta(k + 1, n - k, p); }

double student_two_sided(double nu, double t) { return std::isinf(t) ? 0 : incomplete_beta(nu / 2, 0.5, nu / (nu + t * t)); }

double student_quantile(double nu, double p) {
    if (p == 0.5) return 0;
    const double x = beta_quantile(nu / 2, 0.5, 2 * std::min(p, 1 - p));
    return std::copysign(std::sqrt(nu * (1 - x) / x), p - 0.5);
}

double fisher_upper(double nu1, double nu2, double F) { return F <= 0 ? 1 : incomplete_beta(nu2 / 2, nu1 / 2, nu2 / (nu2 + nu1 * F)); }

}  // namespace corpuscle
