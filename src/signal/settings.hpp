#pragma once
// What the user sets: "sa1.f_B=25Hz". The text is kept until the thing it names says which unit it wants.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "signal/field.hpp"

namespace corpuscle {

struct Wish {
    std::string of;         ///< "sa1", "press"
    std::string parameter;  ///< "f_B"
    std::string value;      ///< "25Hz"
    mutable bool used = false;

    std::string text() const { return of + "." + parameter + "=" + value; }
};

/// Splits "sa1.f_B=25Hz"; what stands before the last dot is whom it is for.
Result<Wish> parse_wish(std::string_view text);

/// The row of `rows` that a wish names; refuses one that is not there.
Result<const Row*> row_for(const Wish&, std::span<const Row> rows);

/// The settings among `wishes` that are for `name`, in SI, checked against its rows; marks them used.
Result<std::vector<Setting>> settings_for(std::string_view name, std::span<const Row> rows, std::span<const Wish> wishes);

}  // namespace corpuscle
