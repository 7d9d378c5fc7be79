#include "circuit/solve/operating_point.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "circuit/device/values.hpp"

namespace corpuscle::circuit {
namespace {

/// One way after another, from where the last good answer was.
class Search {
    Newton& newton_;
    const System& system_;
    std::vector<double> start_, last_;  // last: where plain Newton gave up
    std::size_t nodes_;
    Springs held_;  // to the end
    const Descent* descent_;

    /// A spring at every node; those that are held have their own.
    Springs all(double g, const std::vector<double>& to) const {
        Springs out{std::vector<double>(nodes_, g), to};
        for (std::size_t n = 0; n < held_.g.size(); ++n)
            if (held_.g[n] > 0) out.g[n] = held_.g[n], out.to[n] = held_.to[n];
        return out;
    }

    bool plain(std::vector<double>& x) {
        newton_.memory = system_.fresh_memory();
        return newton_.run(x, held_);
    }

    bool from_designed(std::vector<double>& x) {
        x = descent_->designed;
        return plain(x);
    }

    /// The chip grows out of the circuit as designed, and its answer with it.
    bool by_chip(std::vector<double>& x) {
        x = descent_->designed;
        auto before = x;
        double reached = 0, step = 0.5, last = 0;
        newton_.memory = system_.fresh_memory();
        while (reached < 1 && step > 1e-3) {
            const double share = std::min(1.0, reached + step);
            auto next = x;
            if (last > 0)  // on the straight line so far
                for (std::size_t n = 0; n < x.size(); ++n) next[n] += (x[n] - before[n]) * (share - reached) / last;
            const auto memory = newton_.memory;
            descent_->go(share);
            if (newton_.run(next, held_, 20)) {
                last = share - reached, reached = share, step *= 2;
                before = std::exchange(x, std::move(next));
            } else {
                newton_.memory = memory, step /= 4;
            }
        }
        descent_->go(1);
        return reached >= 1;
    }

    /// Every node hangs at ground by a conductance that is taken away, decade by decade.
    bool by_gmin(std::vector<double>& x) {
        const std::vector<double> ground(x.size());
        double g = 1e-2, factor = 10;
        newton_.memory = system_.fresh_memory();
        for (int tries = 0; tries < 200; ++tries) {
            auto next = x;
            const auto memory = newton_.memory;
            if (newton_.run(next, all(g, ground), 50)) {
                x = next;
                if (g < 1e-15) return newton_.run(x, held_);
                g /= factor, factor = std::min(factor * 1.5, 10.0);
            } else {
                newton_.memory = memory;
                if (factor < 1.001) return false;
                g *= factor, factor = std::sqrt(factor), g /= factor;
            }
        }
        return false;
    }

    /// All sources rise from nothing.
    bool by_sources(std::vector<double>& x) {
        double reached = 0, step = 0.1;
        newton_.memory = system_.fresh_memory();
        newton_.instant.sources = 0;
        bool found = newton_.run(x, held_);
        for (int tries = 0; found && reached < 1 && tries < 500; ++tries) {
            auto next = x;
            const auto memory = newton_.memory;
            newton_.instant.sources = std::min(1.0, reached + step);
            if (newton_.run(next, held_, 30)) {
                x = next, reached = newton_.instant.sources, step *= 2;
            } else {
                newton_.memory = memory, step /= 4;
                found = step > 1e-7;
            }
        }
        newton_.instant.sources = 1;
        return found && reached >= 1;
    }

    /// Every node has a capacitor to ground, and time goes on in ever longer steps until nothing moves.
    bool by_time(std::vector<double>& x) {
        double g = 1e-4;
        newton_.memory = system_.fresh_memory();
        for (int tries = 0; tries < 2000; ++tries) {
            auto next = x;
            const auto memory = newton_.memory;
            if (newton_.run(next, all(g, x), 20)) {
                x = next;
                if (g < 1e-19) return newton_.run(x, held_);
                g /= 2;
            } else {
                newton_.memory = memory;
                g *= 8;
                if (g > 1e6) return false;
            }
        }
        return false;
    }

    /// Nodes of .nodeset are held there first, then let go.
    void hold(std::vector<double>& x) {
        const auto& wanted = system_.circuit().nodesets;
        if (wanted.empty()) return;
        Springs springs = all(0, std::vector<double>(x.size()));
        for (const auto& [node, v] : wanted)
            springs.g[static_cast<std::size_t>(node) - 1] = 1e3, springs.to[static_cast<std::size_t>(node) - 1] = v;
        auto held = x;
        if (newton_.run(held, springs)) x = held;
    }

public:
    Search(Newton& newton, std::vector<double> start, Springs held, const Descent* descent = nullptr)
        : newton_(newton), system_(newton.system), start_(std::move(start)), nodes_(static_cast<std::size_t>(system_.nodes())),
          held_(std::move(held)), descent_(descent) {
        start_.resize(static_cast<std::size_t>(system_.size()));
        newton_.iterations = 0;
    }

    Result<OperatingPoint> run() {
        if (descent_ != nullptr)
            if (auto found = by({{"newton", &Search::from_designed}, {"chip", &Search::by_chip}})) return std::move(*found);
        hold(start_);
        if (auto found = by({{"newton", &Search::plain},
                             {"gmin", &Search::by_gmin},
                             {"source", &Search::by_sources},
                             {"pseudo-transient", &Search::by_time}}))
            return std::move(*found);
        return failure();
    }

private:
    struct Way {
        std::string_view name;
        bool (Search::*go)(std::vector<double>&);
    };
    std::optional<OperatingPoint> by(std::initializer_list<Way> ways) {
        for (const Way& way : ways) {
            auto x = start_;
            if ((this->*way.go)(x)) return OperatingPoint{std::move(x), way.name, newton_.iterations};
            if (last_.empty()) last_ = std::move(x);
            if (system_.linear()) break;
        }
        return {};
    }

    Error failure() {
        const auto& c = system_.circuit();
        if (system_.linear() && newton_.singular >= 0)
            return {Code::bad_input,
                    fmt::format("the equations have no single answer: the matrix is singular at {}",
                                system_.names()[static_cast<std::size_t>(newton_.singular)]),
                    Place{c.file}};
        return {
            Code::not_converged,
            fmt::format(
                "no operating point: neither Newton's steps nor gmin, source and pseudo-transient continuation arrived ({} steps); {}{}",
                newton_.iterations, newton_.distance(last_),
                newton_.singular >= 0 ? fmt::format("; singular at {}", system_.names()[static_cast<std::size_t>(newton_.singular)]) : ""),
            Place{c.file}};
    }
};

}  // namespace

Result<Tolerances> Tolerances::of(const Circuit& c) {
    Tolerances t;
    t.reltol = value_or(c.options, "reltol", t.reltol);
    t.vntol = value_or(c.options, "vntol", t.vntol);
    t.abstol = value_or(c.options, "abstol", t.abstol);
    t.gmin = value_or(c.options, "gmin", t.gmin);
    t.itl1 = static_cast<int>(value_or(c.options, "itl1", t.itl1));
    for (const auto& [name, value] : {std::pair<std::string_view, double>{"reltol", t.reltol}, {"vntol", t.vntol}, {"abstol", t.abstol}})
        if (!(value > 0 && value < 1))
            return bad_input(fmt::format(".options {} = {:g} must be above 0 and below 1", name, value), Place{c.file});
    if (!(t.gmin >= 0 && t.gmin < 1)) return bad_input(fmt::format(".options gmin = {:g} must be in [0, 1)", t.gmin), Place{c.file});
    if (t.itl1 < 1 || t.itl1 > 1'000'000)
        return bad_input(fmt::format(".options itl1 = {} must be in [1, 1000000]", t.itl1), Place{c.file});
    return t;
}

Result<OperatingPoint> operating_point(Newton& newton, std::vector<double> start, Springs held) {
    return Search(newton, std::move(start), std::move(held)).run();
}

Result<OperatingPoint> operating_point(Newton& newton, const Descent& descent, Springs held) {
    return Search(newton, {}, std::move(held), &descent).run();
}

}  // namespace corpuscle::circuit
