#include "circuit/solve/transient.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "signal/quantity.hpp"

namespace corpuscle::circuit {
namespace {

constexpr double shortest_part = 1e-14;  // of the whole: no step is shorter

}  // namespace

void Transient::start_over(Point at) {
    past_.clear();
    past_.push_back(std::move(at));
}

/// What dq/dt weighs the newest charge by.
double Transient::leading(double h) const {
    if (past_.size() < 2) return 1 / h;
    if (trapezoid_) return 2 / h;
    const double w = h / (past_[0].t - past_[1].t);
    return (1 + 2 * w) / (1 + w) / h;
}

/// Newton's steps at t from x on, with dq/dt = leading q + history.
bool Transient::solve(double t, std::vector<double>& x) {
    const double h = t - past_[0].t;
    const auto count = x.size();
    history_.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
        if (past_.size() < 2) {
            history_[n] = -past_[0].q[n] / h;
        } else if (trapezoid_) {
            history_[n] = -2 / h * past_[0].q[n] - past_[0].dq[n];
        } else {
            const double w = h / (past_[0].t - past_[1].t);
            history_[n] = (-(1 + w) * past_[0].q[n] + w * w / (1 + w) * past_[1].q[n]) / h;
        }
    }
    newton_.instant.time = t;
    const int before = newton_.iterations;
    const bool found = newton_.run(x, {}, 25, {leading(h), history_});
    work_.iterations += newton_.iterations - before;
    return found;
}

/// The polynomial through up to three points before.
void Transient::predict(double t) {
    const auto& p = past_;
    predicted_ = p[0].x;
    if (p.size() == 1) return;
    for (std::size_t n = 0; n < predicted_.size(); ++n) {
        const double d01 = (p[0].x[n] - p[1].x[n]) / (p[0].t - p[1].t);
        predicted_[n] += (t - p[0].t) * d01;
        if (p.size() < 3) continue;
        const double d12 = (p[1].x[n] - p[2].x[n]) / (p[1].t - p[2].t);
        predicted_[n] += (t - p[0].t) * (t - p[1].t) * (d01 - d12) / (p[0].t - p[2].t);
    }
}

/// Of the step just solved, in units of what is allowed. With a straight line before, its distance is taken for an error that is larger.
double Transient::error_of(double t, const std::vector<double>& x) const {
    if (past_.size() < 2) return 0;
    const double h = t - past_[0].t, h1 = past_[0].t - past_[1].t;
    const double own = trapezoid_ ? h * h * h / 12 : h * h * (h + h1) * (h + h1) / (6 * (2 * h + h1));
    const double of_parabola = past_.size() < 3 ? own : h * (h + h1) * (t - past_[2].t) / 6;
    double worst = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(system_.nodes()); ++n) {
        if (!charged_[n]) continue;
        const double off = std::abs(x[n] - predicted_[n]) * own / (own + of_parabola);
        worst = std::max(worst, off / (plan_.reltol * std::max(scale_[n], std::abs(x[n])) + plan_.vntol));
    }
    return worst;
}

Result<void> Transient::run(std::vector<double> x, const std::function<bool(double, std::span<const double>)>& each) {
    const auto count = x.size();
    newton_.instant.charges = true;
    newton_.instant.time = 0;
    newton_.memory = system_.fresh_memory();
    system_.eval(x, newton_.instant, newton_.memory, newton_.sums);
    charged_.assign(count, 0), scale_.assign(count, 0);
    for (std::size_t n = 0; n < count; ++n) {
        charged_[n] = newton_.sums.C[system_.pattern().place(static_cast<int>(n), static_cast<int>(n))] != 0;
        scale_[n] = std::abs(x[n]);
    }
    start_over({0, x, newton_.sums.q, std::vector<double>(count)});
    bool more = each(0, x);
    double h = 0;
    while (more && past_[0].t < plan_.stop) {
        const double t0 = past_[0].t, corner = std::min(plan_.stop, system_.next_corner(t0));
        if (past_.size() == 1) h = std::min({plan_.longest, 1e-3 * (corner - t0), h > 0 ? h : plan_.longest});
        const bool last = t0 + h * 1.01 >= corner;
        if (!last && t0 + 2 * h > corner) h = (corner - t0) / 2;
        const double t = last ? corner : t0 + h;
        trapezoid_ = plan_.method == Integration::trapezoidal && past_.size() >= 2;
        predict(t);
        auto next = predicted_;
        const bool found = solve(t, next);
        const double error = found ? error_of(t, next) : 0;
        if (!found || error > 1) {
            ++work_.rejected;
            h = (t - t0) * (found ? std::max(0.2, 0.9 * std::pow(error, -1.0 / 3)) : 0.125);
            if (h < shortest_part * plan_.stop) {
                newton_.instant.charges = false;
                return Error{Code::not_converged,
                             fmt::format("at {} no step is short enough ({}); {}", format_quantity(t0, "s"), format_quantity(h, "s"),
                                         newton_.distance(next)),
                             Place{system_.circuit().file}};
            }
            continue;
        }
        ++work_.steps;
        std::vector<double> dq(count);
        const double a = leading(t - t0);
        for (std::size_t n = 0; n < count; ++n)
            dq[n] = a * newton_.sums.q[n] + history_[n], scale_[n] = std::max(scale_[n], std::abs(next[n]));
        more = each(t, next);
        h = std::min(plan_.longest, (t - t0) * std::clamp(error > 0 ? 0.9 * std::pow(error, -1.0 / 3) : 2.0, 0.3, 2.0));
        Point point{t, std::move(next), newton_.sums.q, std::move(dq)};
        if (last && t < plan_.stop) {
            start_over(std::move(point));
            continue;
        }
        past_.insert(past_.begin(), std::move(point));
        if (past_.size() > 3) past_.pop_back();
    }
    newton_.instant.charges = false;
    return {};
}

}  // namespace corpuscle::circuit
