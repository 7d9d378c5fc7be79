#pragma once
// The distributions that confidence intervals are made of. Boost.Math has them too, at six seconds of compiling.

namespace corpuscle {

/// x of which a standard normal deviate is smaller with probability p; p = 0 and 1 are infinities.
double normal_quantile(double p);
/// I_x(a, b), the regularised incomplete beta function: a, b > 0, 0 <= x <= 1.
double incomplete_beta(double a, double b, double x);
/// x at which I_x(a, b) = p.
double beta_quantile(double a, double b, double p);
/// At most k of n, each with probability p; k < 0 is 0.
double binomial_up_to(double k, double n, double p);
/// x of which Student's t of nu degrees of freedom is smaller with probability p.
double student_quantile(double nu, double p);
/// How often |t| is as great as this, or greater, by chance.
double student_two_sided(double nu, double t);
/// How often F of (nu1, nu2) degrees of freedom is as great as this, or greater, by chance.
double fisher_upper(double nu1, double nu2, double F);

}  // namespace corpuscle
