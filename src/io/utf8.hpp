#pragma once

#include <string>
#include <string_view>

namespace corpuscle {

bool is_utf8(std::string_view);

/// Text as UTF-8: as it is if it is that already, else read as Latin-1 (Windows-1252), as instruments and spreadsheets write it.
std::string utf8_text(std::string_view);

}  // namespace corpuscle
