#pragma once
// Fills page templates: each {{name}} is replaced by a value or by the embedded file of that name.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace corpuscle {

/// Name and version of the compiler.
std::string_view compiler_version();

/// The content of an embedded file of apps/report or of the chart library; "" if there is no such file.
std::string_view asset(std::string_view name);

/// JSON for a script element: '<' is escaped, so that the data cannot end the element.
std::string script_json(const nlohmann::ordered_json&);

/// Text with < and & escaped for HTML.
std::string escape_html(std::string_view text);

/// Fills a template with title, data and embedded files.
std::string fill_template(std::string_view page_template, std::string_view title, std::string_view data);

}  // namespace corpuscle
