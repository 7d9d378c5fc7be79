#pragma once
// Texts as fields of CSV files.

#include <string>
#include <string_view>

namespace corpuscle {

/// A text as a field of CSV, in UTF-8. It is quoted if it has a separator (also that of other dialects), a quote or a line break, or begins
/// like a comment.
std::string quote_csv_field(std::string_view text);

}  // namespace corpuscle
