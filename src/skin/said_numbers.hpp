#pragma once
// Numbers of a population file, with their units and their ranges.

#include <cstdint>
#include <string_view>

#include "skin/text.hpp"

namespace corpuscle::skins {

/// Numbers as a population file writes them. A number whose unit matters says it; a length may leave that to the file's own unit.
class SaidNumbers {
    std::optional<double> metres_;

public:
    SaidNumbers() = default;
    explicit SaidNumbers(double metres) : metres_(metres) {}
    /// In SI, within [low, high].
    Result<double> number(const Said&, std::string_view name, std::string_view unit, double low, double high) const;
    Result<double> number(const MaybeSaid&, std::string_view name, std::string_view unit, double low, double high, double otherwise) const;
    Result<std::uint64_t> whole(const MaybeSaid&, std::string_view name, std::uint64_t low, std::uint64_t high,
                                std::uint64_t otherwise) const;
};

}  // namespace corpuscle::skins
