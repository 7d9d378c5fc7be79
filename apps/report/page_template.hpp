#pragma once
// Fills the HTML templates of report pages: {{title}} and {{data}} are replaced by values, any other {{name}} by the embedded file of that
// name.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace corpuscle {

/// Name and version of the compiler that built this program.
std::string_view compiler_version();

/// The content of an embedded file of apps/report or of the chart library; "" if there is no such file.
std::string_view asset(std::string_view name);

/// JSON for a script element: '<' is escaped, so that the data cannot end the element.
std::string script_json(const nlohmann::ordered_json&);

/// Text with < and & escaped for HTML.
std::string escape_html(std::string_view text);

/// Returns the template with all names replaced. `title` must be escaped HTML, and `data` the text of script_json().
std::string fill_template(std::string_view page_template, std::string_view title, std::string_view data);

}  // namespace corpuscle
