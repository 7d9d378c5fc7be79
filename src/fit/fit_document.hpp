#pragma once
// The result of a fit as JSON, and its values as texts that the program reads again.

#include <nlohmann/json_fwd.hpp>

#include "fit/afferent_fit.hpp"

namespace corpuscle {

/// The JSON document of a result. `score_meaning`: see FitProblem.
nlohmann::ordered_json document_of(const FitResult&, const std::string& score_meaning);

/// The fitted values as a sweep file (TOML), whose [set] also fits into a class of a population file that has the same afferent.
std::string settings_file(const FitResult&, const std::string& command);
/// The fitted values as settings: "sa1.k_A=1.2e-06".
std::vector<std::string> fitted_settings(const FitResult&);
/// The afferent and its fitted values as options: "--afferent sa1 --set sa1.k_A=1.2e-06 --set sa1.f_B=25". The afferent is named because
/// the target of a setting may be something else elsewhere, such as a class of a skin.
std::string settings_options(const FitResult&);

}  // namespace corpuscle
