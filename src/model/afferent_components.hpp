#pragma once
// The components named by the text that specifies an afferent, in the order of the signal: "fsr+f2v+adc+sa1a+lif-a".

#include "model/catalog.hpp"

namespace corpuscle {

struct AfferentComponents {
    std::string_view sensor, transducer, converter;  ///< "": none
    const NamedAfferent* named = nullptr;            ///< the named afferent after them; null: a receptor and a neuron
    std::string_view receptor, neuron;

    /// The components before the receptor: "fsr+f2v+adc", or "".
    std::string front_end() const;
};

/// Parses a text such as "fsr+f2v+sa1". If the named afferent has its own front end, this is included.
Result<AfferentComponents> parse_components(std::string_view text);

/// Finds a named afferent by its name or an alias, without regard to case. Null if there is none.
const NamedAfferent* find_named_afferent(std::string_view text);

}  // namespace corpuscle
