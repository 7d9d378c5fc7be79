#pragma once
// The cards of cards.lib as text.

#include <gtest/gtest.h>

#include <string>

#include "support/support.hpp"

namespace corpuscle::circuit {

/// The type and the parameters of a card: "npn(is=1e-16 ...)".
inline std::string bipolar_card(const std::string& name) {
    const auto text = corpuscle::test::read_file(corpuscle::test::source_root() + "/test/circuit/bipolar/cards.lib");
    const auto head = ".model " + name + " ";
    const auto from = text.find(head);
    if (from == std::string::npos) return ADD_FAILURE() << "no card " << name, "";
    auto card = text.substr(from + head.size(), text.find(')', from) + 1 - from - head.size());
    for (std::size_t at; (at = card.find("\n+")) != std::string::npos;) card.erase(at, 2);
    return card;
}

/// The card of this name with the first occurrence of `before` replaced.
inline std::string changed_card(const std::string& name, const std::string& before, const std::string& after) {
    auto card = bipolar_card(name);
    const auto at = card.find(before);
    if (at == std::string::npos) return ADD_FAILURE() << name << " has no " << before, card;
    return card.replace(at, before.size(), after);
}

}  // namespace corpuscle::circuit
