#pragma once
// Reads the numbers of a population file and checks their units and ranges.

#include <cstdint>
#include <string_view>

#include "skin/plan/skin_spec.hpp"

namespace corpuscle::skins {

/// Every physical quantity in a population file must have a unit. Only a length may omit it, if the file defines a unit of length at its
/// top.
class NumberReader {
    std::optional<double> metres_;  // the file's unit of length in metres; not set if the file defines none

public:
    NumberReader() = default;
    explicit NumberReader(double metres) : metres_(metres) {}
    /// The value of a number in SI. `name` is its key, `unit` the SI unit of the quantity. A value outside [low, high] (SI) is an error.
    Result<double> number(const LocatedText&, std::string_view name, std::string_view unit, double low, double high) const;
    /// The same for a key that may be missing; its value is then `fallback`.
    Result<double> number(const OptionalLocatedText&, std::string_view name, std::string_view unit, double low, double high,
                          double fallback) const;
    /// The same for an integer.
    Result<std::uint64_t> integer(const OptionalLocatedText&, std::string_view name, std::uint64_t low, std::uint64_t high,
                                  std::uint64_t fallback) const;
};

}  // namespace corpuscle::skins
