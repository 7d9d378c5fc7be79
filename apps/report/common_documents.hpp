#pragma once
// JSON that several pages use: a trace, the parameters of an afferent.

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "model/copies.hpp"
#include "report/envelope.hpp"

namespace corpuscle {

/// A trace in the format of class Trace in page-data.js. `afferent`: its name, or null for the force.
nlohmann::ordered_json curve_document(std::uint32_t channel, const nlohmann::ordered_json& afferent, std::string_view quantity,
                                      std::string_view unit, const Envelope&);

/// The parameters with defaults, descriptions and sources. Spreads of other afferents are ignored.
nlohmann::ordered_json parameters_document(const AfferentPlan&, std::span<const ParameterDistribution>);

}  // namespace corpuscle
