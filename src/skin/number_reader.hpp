#pragma once
// Numbers of a population file, with their units and ranges.

#include <cstdint>
#include <string_view>

#include "skin/skin_spec.hpp"

namespace corpuscle::skins {

/// Numbers in a population file. A number with a physical unit must be given with it; only a length may use the file's own unit.
class NumberReader {
    std::optional<double> metres_;

public:
    NumberReader() = default;
    explicit NumberReader(double metres) : metres_(metres) {}
    /// Converted to SI, within [low, high].
    Result<double> number(const LocatedText&, std::string_view name, std::string_view unit, double low, double high) const;
    Result<double> number(const OptionalLocatedText&, std::string_view name, std::string_view unit, double low, double high,
                          double fallback) const;
    Result<std::uint64_t> integer(const OptionalLocatedText&, std::string_view name, std::uint64_t low, std::uint64_t high,
                                  std::uint64_t fallback) const;
};

}  // namespace corpuscle::skins
