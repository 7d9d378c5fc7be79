#pragma once
// A fitted card as text that a netlist reads, and as a JSON document.

#include <nlohmann/json_fwd.hpp>

#include "fit/transistor/transistor_fit.hpp"

namespace corpuscle {

inline constexpr std::string_view card_signature = "* Written by 'corpuscle fit transistor'";

/// A file with one .model line of this name. Values that were not fitted are those of the base.
std::string card_text(const TransistorFit&, const std::string& model_name, const std::string& command);

nlohmann::ordered_json document_of(const TransistorFit&, const IvData&);

/// "485.7 mV"; "infinite" for a value without effect, such as an Early voltage of 1e30 V/m.
std::string card_value_text(const FittedCardValue&);
/// "478 mV to 493 mV", "not determined", "as given".
std::string card_interval_text(const FittedCardValue&);
/// "3.2 %"
std::string percent_text(double fraction);

}  // namespace corpuscle
