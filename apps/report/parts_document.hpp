#pragma once
// What pages of all kinds show: a trace, the parameters of an afferent.

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "model/spread.hpp"
#include "report/envelope.hpp"

namespace corpuscle {

/// As class Trace of page-data.js reads it. `afferent`: whose it is, or null.
nlohmann::ordered_json trace_document(std::uint32_t channel, const nlohmann::ordered_json& afferent, std::string_view part,
                                      std::string_view unit, const Envelope&);

/// With defaults, sentences and sources; spreads of other afferents are passed over.
nlohmann::ordered_json parameters_document(const AfferentPlan&, std::span<const Spread>);

}  // namespace corpuscle
