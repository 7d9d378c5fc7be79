#pragma once
// The parameters of a UICM card that curves can tell, and the points at which a search evaluates them.

#include <span>

#include "circuit/device/uicm_card.hpp"
#include "fit/symmetric_matrix.hpp"

namespace corpuscle {

/// How a parameter is searched: its value, its logarithm, or 1 / value.
enum class SearchScale : std::uint8_t { linear, logarithmic, inverse };

struct CardParameter {
    std::string_view name;       ///< "V_T0"
    std::string_view card_name;  ///< "vto"
    std::string_view unit;
    double circuit::UicmCard::* member;
    SearchScale scale;
    double low, high;                 ///< bounds in the coordinate of the search
    double difference;                ///< distance in this coordinate over which the constants of a transistor are nearly linear
    double resolution;                ///< a standard error above this means that the data do not determine the parameter
    double no_effect;                 ///< the value if it is not determined; NaN: that of the start
    bool is_optional = false;         ///< fitted only if it is named
    bool scales_with_length = false;  ///< `resolution` is that of the coordinate divided by L
};

/// A standard deviation between devices, which is fitted to the deviations of many.
struct MismatchParameter {
    std::string_view name, card_name, unit;
    double circuit::UicmCard::* member;
};

/// In the order of the tables.
std::span<const CardParameter> card_parameters();
std::span<const MismatchParameter> mismatch_parameters();  ///< of V_T0, then of I_SQ
/// By name or name on the card, without regard to case. Null: none.
const CardParameter* find_card_parameter(std::string_view name);

double value_of_coordinate(const CardParameter&, double x);
double coordinate_of_value(const CardParameter&, double value);

/// A card with the parameters at these coordinates.
circuit::UicmCard card_at(circuit::UicmCard, std::span<const CardParameter* const>, const Vector& x);
/// The coordinates of the parameters of a card.
Vector coordinates_of(const circuit::UicmCard&, std::span<const CardParameter* const>);

}  // namespace corpuscle
