#pragma once
// Parses the text that specifies an afferent, such as "fsr+f2v+adc+sa1a+lif-a", into components. They are in the order in which the signal
// passes them.

#include <initializer_list>

#include "model/catalog.hpp"

namespace corpuscle {

/// The names of components that an afferent has, "fsr+f2v", without those that are "".
std::string join_components(std::initializer_list<std::string_view> names);

struct AfferentComponents {
    std::string_view sensor, transducer, converter;  ///< "": the afferent has none
    const NamedAfferent* named = nullptr;            ///< null if the text names a receptor and a neuron instead of an afferent
    std::string_view receptor, neuron;               ///< those of the named afferent, if there is one

    /// The components before the receptor: "fsr+f2v+adc", or "".
    std::string front_end() const { return join_components({sensor, transducer, converter}); }
};

/// Parses a text such as "fsr+f2v+sa1". The front end of a named afferent, if it has one, is among the components.
Result<AfferentComponents> parse_components(std::string_view text);

}  // namespace corpuscle
