#pragma once
// The components that an afferent's text names, in the order of the signal: "fsr+f2v+adc+sa1a+lif-a".

#include "model/catalog.hpp"

namespace corpuscle {

struct AfferentComponents {
    std::string_view sensor, transducer, converter;  ///< "": none
    const NamedAfferent* named = nullptr;            ///< the afferent after them, if it is a named one
    std::string_view receptor, neuron;

    /// The components before the receptor: "fsr+f2v+adc", or "".
    std::string front_end() const;
};

/// Parses a text. The components include the front end that a named afferent has of its own.
Result<AfferentComponents> parse_components(std::string_view text);

const NamedAfferent* find_named_afferent(std::string_view text);

}  // namespace corpuscle
