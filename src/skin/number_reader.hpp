#pragma once
// Reads the numbers of a population file and checks their units and ranges.

#include <cstdint>
#include <string_view>

#include "skin/skin_spec.hpp"

namespace corpuscle::skins {

/// The unit of a physical quantity must be written. Only a length may omit it, if the file defines its unit of length.
class NumberReader {
    std::optional<double> metres_;  // metres per unit of length of the file

public:
    NumberReader() = default;
    explicit NumberReader(double metres) : metres_(metres) {}
    /// The value in SI. Returns an error that names `name` if it is outside [low, high]. `fallback` is the value of a missing item.
    Result<double> number(const LocatedText&, std::string_view name, std::string_view unit, double low, double high) const;
    Result<double> number(const OptionalLocatedText&, std::string_view name, std::string_view unit, double low, double high,
                          double fallback) const;
    Result<std::uint64_t> integer(const OptionalLocatedText&, std::string_view name, std::uint64_t low, std::uint64_t high,
                                  std::uint64_t fallback) const;
};

}  // namespace corpuscle::skins
