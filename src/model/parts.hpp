#pragma once
// The parts that an afferent's text names, in the order of the signal: "fsr+f2v+adc+sa1a+lif-a".

#include "model/catalog.hpp"

namespace corpuscle {

struct Parts {
    std::string_view sensor, transducer, converter;  ///< "": there is none
    const NamedAfferent* named = nullptr;            ///< the afferent behind them, if it goes by a name
    std::string_view receptor, neuron;

    /// What stands before the transduction: "fsr+f2v+adc", or "".
    std::string front() const;
};

/// Reads a text; an afferent's own front is among the parts.
Result<Parts> parse_parts(std::string_view text);

const NamedAfferent* afferent_named(std::string_view text);

}  // namespace corpuscle
