#include "model/lanes/profile.hpp"

#include <optional>

namespace corpuscle::lanes {
namespace {

template <class R>
class Transduction final : public ProfileTransduction {
    R receptor_;
    typename R::State state_ = {};

public:
    explicit Transduction(R receptor) : receptor_(std::move(receptor)) {}

    void run(std::span<const double> force, bool first, std::array<ProfileCurrents, most_outputs>& out) override {
        static_assert(R::outputs <= most_outputs);
        if (force.empty()) return;
        if (first) state_ = receptor_.start(force[0]);
        for (auto& c : out) c.from.resize(force.size()), c.to.resize(force.size()), c.both.resize(force.size());
        for (std::size_t t = 0; t < force.size(); ++t) {
            Current<double> i[R::outputs];
            receptor_.step(state_, force[t], i);
            for (std::size_t k = 0; k < R::outputs; ++k) out[k].from[t] = i[k].from, out[k].to[t] = i[k].to, out[k].both[t] = i[k].sum();
        }
    }
};

}  // namespace

std::unique_ptr<ProfileTransduction> profile_transduction(const AfferentPlan& plan, const Run& run) {
    std::unique_ptr<ProfileTransduction> made;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        const auto params = with<typename R<double>::Params>(R<double>::fields, settings_of(plan));
        made = std::make_unique<Transduction<R<double>>>(R<double>(Same<typename R<double>::Params>{params}, run.dt, run.method));
    });
    return made;
}

bool scales(const AfferentPlan& plan) {
    bool all = false;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        if constexpr (requires { R<double>::scales; }) all = R<double>::scales;
    });
    return all;
}

}  // namespace corpuscle::lanes
