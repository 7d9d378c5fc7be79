#include "model/catalog.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "model/parts.hpp"
#include "model/sensor/fronted.hpp"
#include "model/sensor/fronts.hpp"

namespace corpuscle {
namespace {

template <template <class> class... M>
std::vector<Card> cards(ModelList<M...>) {
    return {card_of<M<double>>()...};
}

template <class... M>
std::vector<Card> cards(PartList<M...>) {
    return {card_of<M>()...};
}

template <class List, class F>
void with_part(List list, std::string_view name, const F& f) {
    each(list, [&]<class M>(Part<M> m) {
        if (M::name == name) f(m);
    });
}

/// The cards of a plan's parts, in the order of the signal.
std::vector<Card> cards_of(const Parts& parts) {
    std::vector<Card> all;
    const auto add = [&](std::vector<Card> cards, std::string_view name) {
        for (auto& c : cards)
            if (c.name == name) all.push_back(std::move(c));
    };
    add(sensor_cards(), parts.sensor), add(transducer_cards(), parts.transducer), add(converter_cards(), parts.converter);
    add(receptor_cards(), parts.receptor), add(neuron_cards(), parts.neuron);
    return all;
}

template <class M>
std::optional<Error> out_of_order(const AfferentPlan& plan) {
    if constexpr (requires { M::orders; })
        return out_of_order<typename M::Params>(plan.name, M::orders, with<typename M::Params>(M::fields, settings_of(plan)));
    return {};
}

template <class M>
std::optional<Error> not_whole(const AfferentPlan& plan) {
    if constexpr (requires { M::whole; })
        for (const auto at : M::whole)
            for (const auto& f : M::fields)
                if (const double x = *plan.value(f.name); f.at == at && x != std::floor(x))
                    return bad_input(fmt::format("{}: {} = {:g} is no whole number", plan.name, f.name, x));
    return {};
}

}  // namespace

std::vector<Order> orders_of(const AfferentPlan& plan) {
    std::vector<Order> all;
    const auto add = [&]<class M>() {
        if constexpr (requires { M::orders; })
            for (const auto& o : M::orders) all.push_back({o.lesser, o.greater, o.or_equal});
    };
    const auto model = [&]<template <class> class M>(Model<M>) { add.template operator()<M<double>>(); };
    const auto part = [&]<class M>(Part<M>) { add.template operator()<M>(); };
    with_part(Sensors{}, plan.sensor, part), with_part(Transducers{}, plan.transducer, part), with_part(Converters{}, plan.converter, part);
    with_named(Receptors{}, plan.receptor, model), with_named(Neurons{}, plan.neuron, model);
    return all;
}

std::optional<Error> refusal(const AfferentPlan& plan) {
    std::optional<Error> wrong;
    const auto model = [&]<template <class> class M>(Model<M>) {
        if (!wrong) wrong = out_of_order<M<double>>(plan);
    };
    const auto part = [&]<class M>(Part<M>) {
        if (!wrong) wrong = out_of_order<M>(plan);
        if (!wrong) wrong = not_whole<M>(plan);
    };
    with_part(Sensors{}, plan.sensor, part), with_part(Transducers{}, plan.transducer, part), with_part(Converters{}, plan.converter, part);
    with_named(Receptors{}, plan.receptor, model), with_named(Neurons{}, plan.neuron, model);
    const auto front = front_of(plan);
    if (!wrong && !plan.sensor.empty()) wrong = front.unreadable(plan.name, 0, "F_cal", *plan.value("F_cal"));
    if (!wrong && !plan.converter.empty()) wrong = front.unreadable(plan.name, *plan.value("F_low"), "F_high", *plan.value("F_high"));
    if (!wrong && !plan.converter.empty())
        if (const auto chain = fixed_chain_of(plan); !chain) wrong = chain.error();
    return wrong;
}

std::vector<Card> sensor_cards() {
    auto all = cards(Sensors{});
    for (auto& card : all)
        for (const auto& row : rows_of<Calibration::Params>(Calibration::fields)) card.rows.push_back(row);
    return all;
}
std::vector<Card> transducer_cards() { return cards(Transducers{}); }
std::vector<Card> converter_cards() { return cards(Converters{}); }
std::vector<Card> receptor_cards() { return cards(Receptors{}); }
std::vector<Card> neuron_cards() { return cards(Neurons{}); }

std::optional<double> AfferentPlan::value(std::string_view parameter) const {
    for (std::size_t k = 0; k < values.size(); ++k)
        if ((*parameters)[k].row.name == parameter) return values[k];
    return {};
}

std::string AfferentPlan::made_of() const {
    if (design) return std::string(design->kind());
    std::string text;
    for (const auto part : {sensor, transducer, converter, receptor, neuron})
        if (!part.empty()) text += (text.empty() ? "" : "+") + std::string(part);
    return text;
}

std::vector<Setting> settings_of(const AfferentPlan& plan) {
    std::vector<Setting> settings;
    settings.reserve(plan.values.size());
    for (std::size_t k = 0; k < plan.values.size(); ++k) settings.push_back({(*plan.parameters)[k].row.name, plan.values[k]});
    return settings;
}

bool goes_by(const AfferentPlan& plan, std::string_view asked, std::string_view name) {
    if (name == asked || name == plan.name) return true;
    const auto* named = afferent_named(name);
    return named && named->name == plan.name;
}

Result<AfferentPlan> plan_afferent(std::string_view text, std::span<const Wish> wishes) {
    const auto parts = parse_parts(text);
    if (!parts) return parts.error();
    const auto* named = parts->named;
    const auto cards = cards_of(*parts);
    const auto& receptor = cards[cards.size() - 2];
    AfferentPlan plan{std::string(text),
                      parts->receptor,
                      parts->neuron,
                      named ? named->sentence : receptor.sentence,
                      named ? named->source : receptor.source,
                      {},
                      {},
                      0,
                      parts->sensor,
                      parts->transducer,
                      parts->converter};
    if (named)
        plan.name = named->front.empty() && !parts->front().empty() ? fmt::format("{}+{}", parts->front(), named->name) : named->name;
    std::vector<Row> rows;
    std::vector<Parameter> parameters;
    for (const auto& card : cards)
        for (const auto& row : card.rows) {
            rows.push_back(row);
            parameters.push_back({row, card.name});
            plan.values.push_back(row.initial);
        }
    const auto apply = [&](std::span<const Setting> settings, bool by_user) {
        for (const auto& s : settings)
            for (std::size_t k = 0; k < parameters.size(); ++k)
                if (parameters[k].row.name == s.name) plan.values[k] = s.value, parameters[k].set = by_user;
    };
    if (named) {
        apply(named->settings, false);
        for (std::size_t k = 0; k < parameters.size(); ++k)
            if (auto& row = parameters[k].row; plan.values[k] != row.initial)
                row.initial = plan.values[k], row.source = named->source;  // the name's own default
    }
    for (const auto& wish : wishes) {  // by any name it has
        if (!goes_by(plan, text, wish.of)) continue;
        const auto settings = settings_for(wish.of, rows, std::span(&wish, 1));
        if (!settings) return settings.error();
        apply(*settings, true);
    }
    plan.parameters = std::make_shared<const std::vector<Parameter>>(std::move(parameters));
    if (const auto wrong = refusal(plan)) return *wrong;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        if constexpr (requires { R<double>::least_rate; }) plan.least_rate = R<double>::least_rate;
    });
    return plan;
}

std::unique_ptr<Afferent> make_afferent(const AfferentPlan& plan, const Run& run) {
    if (plan.design) return plan.design->make(run.dt, run.sampled, plan.copy);
    if (!plan.converter.empty()) return make_digital(plan, run);
    const auto settings = settings_of(plan);
    std::unique_ptr<Afferent> made;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        with_named(Neurons{}, plan.neuron, [&]<template <class> class N>(Model<N>) {
            const auto r = with<typename R<double>::Params>(R<double>::fields, settings);
            const auto n = with<typename N<double>::Params>(N<double>::fields, settings);
            made = std::make_unique<Chain<R, N>>(r, n, run);
        });
    });
    if (!plan.sensor.empty()) return std::make_unique<Fronted>(front_of(plan), std::move(made));
    return made;
}

}  // namespace corpuscle
