#pragma once
// Pages are templates with {{name}} in them, each replaced once by a value or by the file of that name that the program carries.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace corpuscle {

/// What the program was compiled with.
std::string_view compiler();

/// A file of apps/report, or of the chart library.
std::string_view asset(std::string_view name);

/// JSON that can stand inside a script element: no '<' can end it.
std::string safe_json(const nlohmann::ordered_json&);

std::string escaped(std::string_view text);

/// The template with its title, its data and its assets.
std::string filled(std::string_view text, std::string_view title, std::string_view data);

}  // namespace corpuscle
