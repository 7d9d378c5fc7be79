#include "model/catalog.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "signal/text.hpp"

namespace corpuscle {
namespace {

template <template <class> class... M>
std::vector<Card> cards(ModelList<M...>) {
    return {card_of<M<double>>()...};
}

/// Calls f with the member that has this name.
template <class List, class F>
void with_named(List list, std::string_view name, const F& f) {
    each(list, [&]<template <class> class M>(Model<M> m) {
        if (M<double>::name == name) f(m);
    });
}

const Card* card_named(const std::vector<Card>& cards, std::string_view name) {
    const auto at = std::find_if(cards.begin(), cards.end(), [&](const Card& c) { return c.name == name; });
    return at == cards.end() ? nullptr : &*at;
}

const NamedAfferent* afferent_named(std::string_view text) {
    for (const auto& a : named_afferents()) {
        if (same_letters(a.name, text)) return &a;
        for (const auto other : a.other_names)
            if (same_letters(other, text)) return &a;
    }
    return nullptr;
}

Error unknown_afferent(std::string_view text) {
    std::vector<std::string_view> names;
    for (const auto& a : named_afferents()) names.push_back(a.name);
    return bad_input(
        fmt::format("unknown afferent '{}'{} ('corpuscle list' shows them all; a transduction and a neuron join as 'sa1b+lif-b')", text,
                    did_you_mean(text, names)));
}

/// The two halves of "sa1b+izhikevich", as the catalogue's own text.
Result<std::pair<const Card*, const Card*>> halves(std::string_view text) {
    static const auto receptors = receptor_cards(), neurons = neuron_cards();
    const auto plus = text.find('+');
    if (plus == std::string_view::npos) return unknown_afferent(text);
    const auto find = [&](const std::vector<Card>& cards, std::string_view name, std::string_view kind) -> Result<const Card*> {
        if (const auto* card = card_named(cards, name)) return card;
        std::vector<std::string_view> names;
        for (const auto& c : cards) names.push_back(c.name);
        return bad_input(
            fmt::format("{}: unknown {} '{}'{} (there are {})", text, kind, name, did_you_mean(name, names), fmt::join(names, ", ")));
    };
    const auto receptor = find(receptors, text.substr(0, plus), "transduction");
    if (!receptor) return receptor.error();
    const auto neuron = find(neurons, text.substr(plus + 1), "neuron");
    if (!neuron) return neuron.error();
    return std::pair{*receptor, *neuron};
}

std::vector<Setting> settings_of(const AfferentPlan& plan) {
    std::vector<Setting> settings;
    for (const auto& p : plan.parameters) settings.push_back({p.row.name, p.value});
    return settings;
}

template <class M>
std::optional<Error> out_of_order(const AfferentPlan& plan) {
    if constexpr (requires { M::orders; })
        return out_of_order<typename M::Params>(plan.name, M::orders, with<typename M::Params>(M::fields, settings_of(plan)));
    return {};
}

}  // namespace

std::vector<Card> receptor_cards() { return cards(Receptors{}); }
std::vector<Card> neuron_cards() { return cards(Neurons{}); }

std::optional<double> AfferentPlan::value(std::string_view parameter) const {
    const auto at = std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.row.name == parameter; });
    return at == parameters.end() ? std::nullopt : std::optional(at->value);
}

Result<AfferentPlan> plan_afferent(std::string_view text, std::span<const Wish> wishes) {
    const NamedAfferent* named = afferent_named(text);
    const auto parts = halves(named ? fmt::format("{}+{}", named->receptor, named->neuron) : text);
    if (!parts) return parts.error();
    const auto [receptor, neuron] = *parts;

    AfferentPlan plan{named ? std::string(named->name) : std::string(text),
                      receptor->name,
                      neuron->name,
                      named ? named->sentence : receptor->sentence,
                      named ? named->source : receptor->source,
                      {},
                      0};
    std::vector<Row> rows;
    for (const auto* half : {receptor, neuron})
        for (const auto& row : half->rows) {
            rows.push_back(row);
            plan.parameters.push_back({row, half->name, row.initial, false});
        }
    const auto apply = [&](std::span<const Setting> settings, bool by_user) {
        for (const auto& s : settings)
            for (auto& p : plan.parameters)
                if (p.row.name == s.name) p.value = s.value, p.set = by_user;
    };
    if (named) {
        apply(named->settings, false);
        for (auto& p : plan.parameters)
            if (p.value != p.row.initial) p.row.initial = p.value, p.row.source = named->source;  // the name's own default
    }
    for (const auto& wish : wishes) {  // by any name it has
        if (named ? afferent_named(wish.of) != named : wish.of != plan.name) continue;
        const auto settings = settings_for(wish.of, rows, std::span(&wish, 1));
        if (!settings) return settings.error();
        apply(*settings, true);
    }
    std::optional<Error> wrong;
    const auto check = [&]<template <class> class M>(Model<M>) {
        if (!wrong) wrong = out_of_order<M<double>>(plan);
    };
    with_named(Receptors{}, plan.receptor, check);
    with_named(Neurons{}, plan.neuron, check);
    if (wrong) return *wrong;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        if constexpr (requires { R<double>::least_rate; }) plan.least_rate = R<double>::least_rate;
    });
    return plan;
}

std::unique_ptr<Afferent> make_afferent(const AfferentPlan& plan, const Run& run) {
    const auto settings = settings_of(plan);
    std::unique_ptr<Afferent> made;
    with_named(Receptors{}, plan.receptor, [&]<template <class> class R>(Model<R>) {
        with_named(Neurons{}, plan.neuron, [&]<template <class> class N>(Model<N>) {
            const auto r = with<typename R<double>::Params>(R<double>::fields, settings);
            const auto n = with<typename N<double>::Params>(N<double>::fields, settings);
            made = std::make_unique<Chain<R, N>>(r, n, run);
        });
    });
    return made;
}

}  // namespace corpuscle
