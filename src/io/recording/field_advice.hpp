#pragma once
// Advice for fields of a text file that are meant as numbers, but are written in a form that is not supported.

#include <string>
#include <string_view>

namespace corpuscle {

struct FieldAdvice {
    std::string feature = {};  ///< the unsupported form, such as "a thousands separator"; "": the field is of no known form
    std::string filter = {};   ///< a shell command that reads the file and writes it in a supported form; "": no command does this safely
    std::string remedy = {};   ///< what the user can do if there is no command
};

FieldAdvice advise_on_field(std::string_view field);

}  // namespace corpuscle
