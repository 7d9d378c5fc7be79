#pragma once
// Makes report pages, and documents that several pages contain. All pages have one template, web/shell.html, in which {{title}}, {{data}},
// {{style}} and {{script}} are replaced.

#include <nlohmann/json_fwd.hpp>

#include "model/copies.hpp"

namespace corpuscle {

/// Versions of the program and of the compiler that built it.
nlohmann::ordered_json versions_document();

/// The parameters of an afferent, each with its value, default, description, source and, if it is drawn at random, its standard deviation
/// ("spread"). Distributions of other afferents' parameters are ignored.
nlohmann::ordered_json parameters_document(const AfferentPlan&, std::span<const ParameterDistribution> spreads);

/// A page as HTML. `page` names the function that shows it (web/main.ts): "respond". Its data are page, title, program and command line,
/// then those of the document.
std::string report_page(std::string_view page, const std::string& title, const std::string& command,
                        const nlohmann::ordered_json& document);

}  // namespace corpuscle
