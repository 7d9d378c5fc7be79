#include "sweep/spec/probability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/number/elementary.hpp"

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

/// c[0] + c[1] x + ... + c[7] x^7.
double polynomial(const double (&c)[8], double x) {
    double y = c[7];
    for (int k = 6; k >= 0; --k) y = y * x + c[k];
    return y;
}

}  // namespace

double normal_quantile(double u) {
    if (!(u > 0 && u < 1)) return u == 0 || u == 1 ? (u - 0.5) * std::numeric_limits<double>::infinity() : std::nan("");
    static constexpr double a[8] = {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3, 1.3731693765509461125e4,
                                    4.5921953931549871457e4, 6.7265770927008700853e4, 3.3430575583588128105e4, 2.5090809287301226727e3},
                            b[8] = {1.0,
                                    4.2313330701600911252e1,
                                    6.8718700749205790830e2,
                                    5.3941960214247511077e3,
                                    2.1213794301586595867e4,
                                    3.9307895800092710610e4,
                                    2.8729085735721942674e4,
                                    5.2264952788528545610e3},
                            c[8] = {1.42343711074968357734e0,  4.63033784615654529590e0, 5.76949722146069140550e0,
                                    3.64784832476320460504e0,  1.27045825245236838258e0, 2.41780725177450611770e-1,
                                    2.27238449892691845833e-2, 7.74545014278341407640e-4},
                            d[8] = {1.0,
                                    2.05319162663775882187e0,
                                    1.67638483018380384940e0,
                                    6.89767334985100004550e-1,
                                    1.48103976427480074590e-1,
                                    1.51986665636164571966e-2,
                                    5.47593808499534494600e-4,
                                    1.05075007164441684324e-9},
                            e[8] = {6.65790464350110377720e0,  5.46378491116411436990e0,  1.78482653991729133580e0,
                                    2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                    2.71155556874348757815e-5, 2.01033439929228813265e-7},
                            f[8] = {1.0,
                                    5.99832206555887937690e-1,
                                    1.36929880922735805310e-1,
                                    1.48753612908506148525e-2,
                                    7.86869131145613259100e-4,
                                    1.84631831751005468180e-5,
                                    1.42151175831644588870e-7,
                                    2.04426310338993978564e-15};
    const double centred = u - 0.5;  // a ... f and the ranges of r are those of the algorithm
    if (std::abs(centred) <= 0.425) {
        const double r = 0.180625 - centred * centred;
        return centred * polynomial(a, r) / polynomial(b, r);
    }
    const double r = num::sqrt(-num::log(centred < 0 ? u : 1 - u));
    const double x = r <= 5 ? polynomial(c, r - 1.6) / polynomial(d, r - 1.6) : polynomial(e, r - 5) / polynomial(f, r - 5);
    return centred < 0 ? -x : x;
}

double normal_probability(double deviate) {
    double low = 0, high = 1;
    for (int k = 0; k < 1100; ++k) {
        const double midpoint = low + (high - low) / 2;
        if (!(midpoint > low && midpoint < high) || midpoint < 0x1p-1000) break;  // no number is between low and high
        (normal_quantile(midpoint) < deviate ? low : high) = midpoint;
    }
    return low;
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
