#pragma once
// Parts of answers that several requests have.

#include <span>

#include "core/afferent_factory.hpp"
#include "core/force_source.hpp"
#include "page/message.hpp"

namespace corpuscle::page {

/// {"name", "class", "composition", "is_circuit", "description"} of an afferent.
Json document_of(const AfferentPlan&);
Json document_of(std::span<const Probe>);       ///< [{"name", "unit"}]
Json document_of(std::span<const ValidRange>);  ///< [{"quantity", "unit", "low", "high", "meaning"}]
Json document_of(std::span<const Phase>);       ///< [{"name", "from", "to"}]
Json document_of(std::span<const SettableValue>);
/// The rows of a plan's parameters, as in the catalogue, with "value".
Json parameters_document(const AfferentPlan&);

/// The spikes as two arrays, "unit" and "time" (s).
void add_spikes(MessageWriter&, std::span<const Spike>, const Clock&);

}  // namespace corpuscle::page
