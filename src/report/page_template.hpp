#pragma once
// Makes report pages from HTML templates, and documents that several pages contain. In a template, {{title}} and {{data}} are replaced by
// values, any other {{name}} by the embedded file of that name.

#include <nlohmann/json_fwd.hpp>

#include "model/copies.hpp"

namespace corpuscle {

/// Versions of the program and of the compiler that built it.
nlohmann::ordered_json versions_document();

/// The parameters of an afferent, each with its value, default, description, source and, if it is drawn at random, its standard deviation
/// ("spread"). Distributions of other afferents' parameters are ignored.
nlohmann::ordered_json parameters_document(const AfferentPlan&, std::span<const ParameterDistribution> spreads);

/// The page of a template ("page.html") as HTML. Its data are title, program and command line, then those of the document.
std::string report_page(std::string_view page_template, const std::string& title, const std::string& command,
                        const nlohmann::ordered_json& document);

}  // namespace corpuscle
