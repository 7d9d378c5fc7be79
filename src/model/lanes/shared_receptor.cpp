#include "model/lanes/shared_receptor.hpp"

#include <cstring>
#include <optional>
#include <type_traits>

#include "core/simulation_options.hpp"
#include "model/models.hpp"
#include "model/parameter_values.hpp"

namespace corpuscle::lanes {
namespace {

template <class R>
class ReceptorRun final : public SharedReceptor {
    R receptor_;
    typename R::State state_ = {};
    std::int64_t step_ = 0;  // number of samples simulated so far

public:
    explicit ReceptorRun(R receptor) : receptor_(std::move(receptor)) {}

    std::vector<double> save() const override {
        static_assert(std::is_trivially_copyable_v<typename R::State> && sizeof(state_) % sizeof(double) == 0);
        std::vector<double> all(1 + sizeof(state_) / sizeof(double), static_cast<double>(step_));
        std::memcpy(all.data() + 1, &state_, sizeof(state_));
        return all;
    }
    bool resume(std::span<const double> saved) override {
        if (saved.size() != 1 + sizeof(state_) / sizeof(double) || !(saved[0] >= 0 && saved[0] <= 0x1p53)) return false;
        step_ = static_cast<std::int64_t>(saved[0]);
        std::memcpy(&state_, saved.data() + 1, sizeof(state_));
        return true;
    }

    void run(std::span<const double> force, bool first, std::array<ProfileCurrents, max_outputs>& out) override {
        static_assert(R::outputs <= max_outputs);
        if (force.empty()) return;
        if (first) state_ = receptor_.start(force[0]);
        for (auto& c : out) c.from.resize(force.size()), c.to.resize(force.size()), c.end_sum.resize(force.size());
        for (std::size_t t = 0; t < force.size(); ++t, ++step_) {
            if constexpr (requires { receptor_.flush_decayed(state_); })
                if (step_ % flush_interval == 0 && step_ > 0) receptor_.flush_decayed(state_);
            Current<double> i[R::outputs];
            receptor_.step(state_, force[t], i);
            for (std::size_t k = 0; k < R::outputs; ++k) out[k].from[t] = i[k].from, out[k].to[t] = i[k].to, out[k].end_sum[t] = i[k].sum();
        }
    }
};

}  // namespace

std::unique_ptr<SharedReceptor> make_shared_receptor(const AfferentPlan& plan, const SimulationOptions& run) {
    std::unique_ptr<SharedReceptor> receptor;
    visit_named(Receptors{}, plan.receptor, [&]<template <class> class R>(ModelTag<R>) {
        receptor = std::make_unique<ReceptorRun<R<double>>>(R<double>(ParameterValues<R<double>>(plan), run.dt, run.method));
    });
    return receptor;
}

bool scales_with_force(const AfferentPlan& plan) {
    bool scales = false;
    visit_named(Receptors{}, plan.receptor, [&]<template <class> class R>(ModelTag<R>) {
        if constexpr (requires { R<double>::scales_with_force; }) scales = R<double>::scales_with_force;
    });
    return scales;
}

}  // namespace corpuscle::lanes
