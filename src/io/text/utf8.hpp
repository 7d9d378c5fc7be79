#pragma once
// Recognition of, and conversion to, UTF-8.

#include <string>
#include <string_view>

namespace corpuscle {

bool is_utf8(std::string_view);

/// Text as UTF-8. Text that is not valid UTF-8 is converted from Windows-1252, which instruments and spreadsheets write.
std::string to_utf8(std::string_view);

}  // namespace corpuscle
