// Transient runs against IDA of SUNDIALS on the same equations.

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "circuit/in_time.hpp"

namespace corpuscle::circuit {
namespace {

const std::string loops = test::root() + "/test/circuit/loops/";

TEST(Ida, Scratch) {
    auto o = InTime::file(loops + "oscillator.cir");
    o.stop_at(1);
    for (double tol : {1e-7, 1e-8, 1e-9, 1e-10}) {
        const auto t0 = std::chrono::steady_clock::now();
        IdaQuestion q;
        q.watched = o.unknown("v(s)"), q.level = 0.35, q.reltol = tol, q.vntol = tol;
        const auto a = o.ida(q);
        std::printf("%g: %zu spikes, last %.12g, %ld steps %ld evals, %s, %.2f s\n", tol, a.crossings.size(),
                    a.crossings.empty() ? 0 : a.crossings.back(), a.steps, a.evaluations, a.wrong.c_str(),
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count());
    }
    for (double tol : {1e-3, 1e-4, 1e-5, 1e-6}) {
        const auto t0 = std::chrono::steady_clock::now();
        TransientPlan plan;
        plan.reltol = tol, plan.vntol = tol / 10;
        const auto p = o.run(plan);
        const auto s = o.spikes(p, "v(s)", 0.35);
        std::printf("ours %g: %zu spikes, last %.12g, %ld steps %ld its, %s, %.2f s\n", tol, s.size(), s.empty() ? 0 : s.back(), p.work.steps,
                    p.work.iterations, p.wrong.c_str(), std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count());
    }
}

}  // namespace
}  // namespace corpuscle::circuit
