#pragma once
// Former spellings of arguments. Each is refused with an error that names the new spelling.

#include <string_view>

namespace corpuscle {

struct RenamedArgument {
    std::string_view verb;
    std::string_view old_text, new_text;  ///< an option, an option and its value, or a positional argument
};

inline constexpr RenamedArgument renamed_arguments[] = {
    {"respond", "--trace", "--probe"},
    {"respond", "--traces", "--probe-files"},
    {"run", "--trace", "--probe"},
    {"sweep", "--units", "--samples"},
    {"sweep", "--apart", "--separately"},
    {"compare", "--unit", "--train"},
    {"stream", "--together", "--batch-frames"},
    {"stream", "--longest-gap", "--max-gap"},
    {"stream", "--stamp count", "--stamp sequence"},
    {"stream", "--spin", "--busy-poll"},
    {"stream", "--idle-limit", "--idle-timeout"},
    {"stream", "--limit", "--max-force"},
    {"list", "transduction", "receptors"},
    {"list", "transductions", "receptors"},
};

}  // namespace corpuscle
