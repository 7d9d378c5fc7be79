#include "circuit/solve/topology.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numeric>

#include "circuit/devices.hpp"
#include "signal/field.hpp"

namespace corpuscle::circuit {
namespace {

/// Nodes that belong together.
class Groups {
    std::vector<int> up_;

public:
    explicit Groups(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), 0); }
    int of(int k) {
        auto& up = up_[static_cast<std::size_t>(k)];
        while (up != up_[static_cast<std::size_t>(up)]) up = up_[static_cast<std::size_t>(up)];
        return up;
    }
    /// False: they did before.
    bool join(int a, int b) {
        a = of(a), b = of(b);
        if (a == b) return false;
        up_[static_cast<std::size_t>(a)] = b;
        return true;
    }
};

/// Whether it can set a voltage that nothing else sets: a controlled current can, where it depends on it.
bool conducts(const Element& e) {
    if (e.letter == 'b') return has_branch(e) || !e.formula->constant();
    const auto* kind = device_of(e.letter);
    return kind != nullptr && kind->conducts;
}

bool fixes_voltage(const Element& e) {
    if (e.letter == 'b' || e.letter == 'g') return has_branch(e);
    const auto* kind = device_of(e.letter);
    return kind != nullptr && kind->fixes_voltage && has_branch(e);
}

/// The ends between which an element lets current pass: of a transistor drain, source and bulk, not its gate.
std::vector<int> ends_of(const Element& e) {
    if (e.letter == 'm' && e.nodes.size() == 4) return {e.nodes[0], e.nodes[2], e.nodes[3]};
    return {e.nodes[0], e.nodes[1]};
}

/// Up to three elements at a node, by name.
std::string at_node(const Circuit& c, int node) {
    std::vector<std::string> names;
    std::size_t more = 0;
    for (const auto& e : c.elements)
        if (std::find(e.nodes.begin(), e.nodes.end(), node) != e.nodes.end()) names.size() < 3 ? names.push_back(e.name) : void(++more);
    return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

std::optional<Error> floating(const Circuit& c) {
    Groups groups(c.nodes.size());
    for (const auto& e : c.elements)
        if (conducts(e))
            for (const int end : ends_of(e)) groups.join(end, e.nodes[0]);
    std::vector<int> loose;
    for (std::size_t n = 1; n < c.nodes.size(); ++n)
        if (groups.of(static_cast<int>(n)) != groups.of(0)) loose.push_back(static_cast<int>(n));
    if (loose.empty()) return {};
    const int first = loose[0];
    bool sources = false;  // do current sources alone join its group to others?
    const Element* here = nullptr;
    std::vector<std::string> names;
    for (const int n : loose)
        if (groups.of(n) == groups.of(first) && names.size() < 4) names.push_back(c.nodes[static_cast<std::size_t>(n)]);
    for (const auto& e : c.elements) {
        const bool touches = std::any_of(e.nodes.begin(), e.nodes.end(), [&](int n) { return groups.of(n) == groups.of(first); });
        if (!touches) continue;
        if (here == nullptr) here = &e;
        sources |= e.letter == 'i' || (e.letter == 'b' && !has_branch(e));
    }
    const auto what = names.size() == 1 ? fmt::format("node '{}' has", names[0]) : fmt::format("nodes '{}' have", fmt::join(names, "', '"));
    const auto why = sources ? "is cut off from ground but for current sources, so nothing sets its voltage"
                             : "stands at capacitors, gates or nothing else, so nothing sets its voltage";
    const auto which = names.size() == 1 ? "it" : "their part of the circuit";
    return bad_input(fmt::format("{} no path to ground for a direct current: {} {} (at it: {}); a large resistor to ground would", what,
                                 which, why, at_node(c, first)),
                     here != nullptr ? here->place : Place{c.file});
}

std::optional<Error> loop(const Circuit& c) {
    Groups groups(c.nodes.size());
    std::vector<const Element*> joined;
    for (const auto& e : c.elements) {
        if (!fixes_voltage(e)) continue;
        if (groups.join(e.nodes[0], e.nodes[1])) {
            joined.push_back(&e);
            continue;
        }
        if (e.nodes[0] == e.nodes[1])
            return bad_input(fmt::format("{}: both its ends are node '{}', so no voltage but 0 could stand there", e.name,
                                         c.nodes[static_cast<std::size_t>(e.nodes[0])]),
                             e.place);
        std::vector<std::string> names;
        for (const auto* other : joined)
            if (groups.of(other->nodes[0]) == groups.of(e.nodes[0]) && names.size() < 5) names.push_back(other->name);
        return bad_input(fmt::format("{}: it closes a loop of elements that each fix a voltage ({}), so the current in it is not set",
                                     e.name, fmt::join(names, ", ")),
                         e.place);
    }
    return {};
}

}  // namespace

std::optional<Error> unanswerable(const Circuit& c) {
    if (c.elements.empty()) return bad_input("no elements: there is nothing to solve", Place{c.file});
    if (std::none_of(c.elements.begin(), c.elements.end(),
                     [](const Element& e) { return std::find(e.nodes.begin(), e.nodes.end(), 0) != e.nodes.end(); }))
        return bad_input("no element is connected to ground (node 0)", c.elements[0].place);
    if (auto wrong = loop(c)) return wrong;
    return floating(c);
}

std::vector<Error> suspicious(const Circuit& c) {
    std::vector<int> ends(c.nodes.size());
    std::vector<const Element*> at(c.nodes.size());
    for (const auto& e : c.elements) {
        for (const int n : e.nodes) ++ends[static_cast<std::size_t>(n)], at[static_cast<std::size_t>(n)] = &e;
        if (!e.formula) continue;
        for (const auto& in : e.formula->inputs())
            for (const auto& name : {in.name, in.minus})
                if (const int n = c.node(name); in.kind == FormulaInput::Kind::voltage && n > 0) ++ends[static_cast<std::size_t>(n)];
    }
    std::vector<std::string_view> shared;
    for (std::size_t n = 1; n < c.nodes.size(); ++n)
        if (ends[n] > 1) shared.push_back(c.nodes[n]);
    std::vector<Error> out;
    for (std::size_t n = 1; n < c.nodes.size(); ++n)
        if (ends[n] == 1 && c.nodes[n].find('.') == std::string::npos)
            out.push_back(bad_input(
                fmt::format("node '{}' stands at {} alone{}", c.nodes[n], at[n]->name, did_you_mean(c.nodes[n], shared)), at[n]->place));
    return out;
}

}  // namespace corpuscle::circuit
