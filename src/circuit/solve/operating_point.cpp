#include "circuit/solve/operating_point.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "circuit/device/values.hpp"

namespace corpuscle::circuit {
namespace {

/// Tolerances that are wide as long as this lives.
class Loosened {
    Tolerances& of_;
    const Tolerances tight_;

    void loosen() const { of_.reltol = 1e-2, of_.vntol = 1e-3, of_.abstol = 1e-13; }

public:
    explicit Loosened(Tolerances& of) : of_(of), tight_(of) { loosen(); }
    Loosened(const Loosened&) = delete;
    ~Loosened() { of_ = tight_; }
    bool exactly(const std::function<bool()>& work) const {
        of_ = tight_;
        const bool good = work();
        return loosen(), good;
    }
};

/// One way after another, from where the last good answer was.
class Search {
    Newton& newton_;
    const System& system_;
    bool led_;                          // it begins where somebody knows it to be near; then .nodeset has nothing to add
    std::vector<double> start_, last_;  // last: where plain Newton gave up
    std::size_t nodes_;
    Springs held_;  // to the end

    /// A spring at every node; those that are held have their own.
    Springs all(double g, const std::vector<double>& to) const {
        Springs out{std::vector<double>(nodes_, g), to};
        for (std::size_t n = 0; n < held_.g.size(); ++n)
            if (held_.g[n] > 0) out.g[n] = held_.g[n], out.to[n] = held_.to[n];
        return out;
    }

    bool plain(std::vector<double>& x) {
        constexpr int near = 40;  // steps: from near they arrive within half of these, or never
        newton_.memory = system_.fresh_memory();
        return newton_.run(x, held_, led_ ? std::min(near, newton_.tolerances.itl1) : 0);
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

    /// Every node has a capacitor to ground, and time goes on in ever longer steps until nothing moves. Where something turns over by its
    /// own gain, a trigger that a chip has on its other side, it moves ever faster: there a step is as long as to move it so far. None but
    /// the last steps are exact.
    bool by_time(std::vector<double>& x) {
        constexpr double so_far = 20e-3, still = 2e-3;  // V
        constexpr int patience = 5;
        const Loosened loosened(newton_.tolerances);
        double g = 1e-4, rate = 0, too_small = 0;
        int careful = 0;  // steps, after one that was too long
        newton_.memory = system_.fresh_memory();
        for (int tries = 0; tries < 600; ++tries) {
            auto next = x;
            const auto memory = newton_.memory;
            const int before = newton_.iterations;
            if (!newton_.run(next, all(g, x), patience)) {
                newton_.memory = memory;
                too_small = g, careful = 20, g *= 3;
                if (g > 1e6) return false;
                continue;
            }
            const double moved = farthest(x, next), faster = rate > 0 ? moved * g / rate : 0;
            x = std::move(next), rate = moved * g;
            if (moved < 10 * still && g < 1e-13) {
                if (auto there = x; loosened.exactly([&] { return newton_.run(there, held_, 20); })) return x = std::move(there), true;
                if (g < 1e-19) return false;
            }
            const bool quick = newton_.iterations - before <= 3;
            g = faster > 1.03 ? std::max(rate * faster / so_far, g) : g / (moved < still ? 10 : quick ? 4 : 2);
            if (careful > 0) --careful, g = std::max(g, 1.5 * too_small);
        }
        return false;
    }
    /// The same, every step exact and shorter steps only where one fails: slow, and arrives where little else does.
    bool by_exact_time(std::vector<double>& x) {
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
    double farthest(const std::vector<double>& a, const std::vector<double>& b) const {
        double most = 0;
        for (std::size_t n = 0; n < nodes_; ++n) most = std::max(most, std::abs(a[n] - b[n]));
        return most;
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
    Search(Newton& newton, std::vector<double> start, Springs held)
        : newton_(newton), system_(newton.system), led_(!start.empty()), start_(std::move(start)),
          nodes_(static_cast<std::size_t>(system_.nodes())), held_(std::move(held)) {
        start_.resize(static_cast<std::size_t>(system_.size()));
        newton_.iterations = 0;
    }

    Result<OperatingPoint> run() {
        if (led_)
            if (auto found = from_start()) return *found;
        if (led_ && !system_.linear()) led_ = false, start_.assign(start_.size(), 0.0);  // as if nobody had known
        if (!led_) {
            hold(start_);
            if (auto found = from_start()) return *found;
        }
        return failure();
    }

private:
    std::optional<OperatingPoint> from_start() {
        struct Way {
            std::string_view name;
            bool (Search::*go)(std::vector<double>&);
        };
        const Way newton{"newton", &Search::plain}, gmin{"gmin", &Search::by_gmin}, source{"source", &Search::by_sources},
            time{"pseudo-transient", &Search::by_time}, exact_time{"pseudo-transient", &Search::by_exact_time};
        // From a place that is near, time goes where the circuit itself would; gmin and source forget where they began.
        for (const Way& way : led_ ? std::array{newton, time, gmin, source} : std::array{newton, gmin, source, exact_time}) {
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

}  // namespace corpuscle::circuit
