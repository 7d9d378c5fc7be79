#pragma once
// What a nerve fibre can do at most, and what to say of an afferent that does more.

#include <string>

#include "model/catalog.hpp"

namespace corpuscle {

/// Hz: an absolute refractory period of about 1 ms ends the next spike no earlier (Hodgkin & Huxley 1952, J Physiol 117:500, and any
/// textbook since).
inline constexpr double nerve_limit = 1e3;

/// "it fires at up to 4.5 MHz ..., and what to look at". `name`: what --set calls the afferent.
std::string rate_sentence(double rate, const AfferentPlan&, const std::string& name);

}  // namespace corpuscle
