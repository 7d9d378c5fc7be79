#pragma once
// A number in a JSON document; infinity and NaN become null.

#include <cmath>
#include <nlohmann/json.hpp>

namespace corpuscle {

inline nlohmann::ordered_json json_number(double x) {
    return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(nullptr);
}

}  // namespace corpuscle
