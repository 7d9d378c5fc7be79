#include "model/model_factory.hpp"

#include "model/catalog.hpp"
#include "model/chain.hpp"
#include "model/components.hpp"
#include "model/models.hpp"
#include "model/sensor/digital_afferent.hpp"

namespace corpuscle {
namespace {

class ModelFactory final : public AfferentFactory {
public:
    std::unique_ptr<Afferent> make(const AfferentPlan& plan, const SimulationOptions& run) const override {
        if (!plan.converter.empty()) return make_digital(plan, run);
        std::unique_ptr<Afferent> afferent;
        visit_named(Receptors{}, plan.receptor, [&]<template <class> class R>(ModelTag<R>) {
            visit_named(Neurons{}, plan.neuron, [&]<template <class> class N>(ModelTag<N>) {
                afferent = std::make_unique<Chain<R, N>>(ParameterValues<R<double>>(plan), ParameterValues<N<double>>(plan), run);
            });
        });
        // A plan with a transducer also has a sensor.
        if (!plan.sensor.empty()) return make_behind_front_end(make_front_end(plan), std::move(afferent));
        return afferent;
    }
    AfferentTraits traits(const AfferentPlan& plan) const override {
        return {.can_use_lanes = plan.sensor.empty() && plan.transducer.empty() && plan.converter.empty(),
                .is_irregular = plan.value(jitter_name).value_or(0) > 0,
                .lane_obstacles = "sensors, converters and noise",
                .reason_no_noise = plan.converter.empty() ? "" : "behind a converter the membrane is digital"};
    }
    std::string composition(const AfferentPlan& plan) const override {
        return join_components({plan.sensor, plan.transducer, plan.converter, plan.receptor, plan.neuron});
    }
    std::vector<std::pair<std::string, std::string>> labels(const AfferentPlan& plan) const override {
        return {{"receptor", std::string(plan.receptor)}, {"neuron", std::string(plan.neuron)}};
    }
};

}  // namespace

std::shared_ptr<const AfferentFactory> model_factory() {
    static const auto factory = std::make_shared<const ModelFactory>();
    return factory;
}

}  // namespace corpuscle
