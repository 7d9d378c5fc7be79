#pragma once
// Distributions for samples and confidence intervals. Boost.Math has them as well, but takes six seconds to compile.

namespace corpuscle {

/// Quantile of the standard normal distribution; 0 and 1 give infinities. Wichura, algorithm AS 241, Appl. Stat. 37 (1988), with a relative
/// error of 1e-16.
double normal_quantile(double u);
/// The inverse: cumulative probability of a standard normal deviate, by bisection to full precision.
double normal_probability(double deviate);
/// I_x(a, b), the regularised incomplete beta function: a, b > 0, 0 <= x <= 1.
double incomplete_beta(double a, double b, double x);
/// The x at which I_x(a, b) = p.
double beta_quantile(double a, double b, double p);
/// Probability of at most k successes in n trials, each with probability p; 0 for k < 0.
double binomial_up_to(double k, double n, double p);
/// Quantile of Student's t with nu degrees of freedom, 0 < p < 1.
double student_quantile(double nu, double p);
/// Probability that the absolute value of Student's t with nu degrees of freedom is at least |t|.
double student_two_sided(double nu, double t);
/// Probability that a number with the F distribution of (nu1, nu2) degrees of freedom is at least F.
double fisher_upper(double nu1, double nu2, double F);

}  // namespace corpuscle
