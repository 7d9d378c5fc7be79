#pragma once

#include "page/row.hpp"
#include "skin/innervation.hpp"

namespace corpuscle::page {

/// The text of spikes.csv for the spikes of a session. The channel of a row is "force", that of a skin's afferent its region. `skin`: null
/// if there is none.
std::string spikes_csv(std::span<const Row> rows, const Innervation* skin, std::span<const Spike>, const Clock&);

}  // namespace corpuscle::page
