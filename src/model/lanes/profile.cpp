#include "model/lanes/profile.hpp"

#include <cstring>
#include <optional>
#include <type_traits>

namespace corpuscle::lanes {
namespace {

template <class R>
class Transduction final : public ProfileTransduction {
    R receptor_;
    typename R::State state_ = {};
    std::int64_t step_ = 0;

public:
    explicit Transduction(R receptor) : receptor_(std::move(receptor)) {}

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

    void run(std::span<const double> force, bool first, std::array<ProfileCurrents, most_outputs>& out) override {
        static_assert(R::outputs <= most_outputs);
        if (force.empty()) return;
        if (first) state_ = receptor_.start(force[0]);
        for (auto& c : out) c.from.resize(force.size()), c.to.resize(force.size()), c.both.resize(force.size());
        for (std::size_t t = 0; t < force.size(); ++t, ++step_) {
            if constexpr (requires { receptor_.settle(state_); })
                if (step_ % settling == 0 && step_ > 0) receptor_.settle(state_);
            Current<double> i[R::outputs];
            receptor_.step(state_, force[t], i);
            for (std::size_t k = 0; k < R::outputs; ++k) out[k].from[t] = i[k].from, out[k].to[t] = i[k].to, out[k].both[t] = i[k].sum();
        }
    }
};

}  // namespace

std::unique_ptr<ProfileTransduction> profile_transduction(const AfferentPlan& plan, const Run& run) {
    std::unique_ptr<ProfileTransduction> receptor;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        const auto params = with_settings<typename R<double>::Params>(R<double>::fields, settings_of(plan));
        receptor = std::make_unique<Transduction<R<double>>>(R<double>(Same<typename R<double>::Params>{params}, run.dt, run.method));
    });
    return receptor;
}

bool scales(const AfferentPlan& plan) {
    bool all = false;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        if constexpr (requires { R<double>::scales; }) all = R<double>::scales;
    });
    return all;
}

}  // namespace corpuscle::lanes
