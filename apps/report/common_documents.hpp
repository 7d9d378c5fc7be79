#pragma once
// JSON that several report pages use: a trace, and the parameters of an afferent.

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "model/copies.hpp"
#include "report/envelope.hpp"

namespace corpuscle {

/// A trace in the format of class Trace in page-data.js. `channel`: its index, counted over all
/// inputs of the run. `afferent`: the name of the afferent, or null if the trace is the force.
nlohmann::ordered_json curve_document(std::uint32_t channel, const nlohmann::ordered_json& afferent, std::string_view quantity,
                                      std::string_view unit, const Envelope& values);

/// The parameters of an afferent, each with its value, default, description, source and, if it is drawn at random, its standard deviation
/// ("spread"). Distributions of other afferents' parameters are ignored.
nlohmann::ordered_json parameters_document(const AfferentPlan&, std::span<const ParameterDistribution> spreads);

}  // namespace corpuscle
