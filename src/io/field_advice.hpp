#pragma once
// Advice on fields that are meant as numbers but are written in a format that is not supported.

#include <string>
#include <string_view>

namespace corpuscle {

struct FieldAdvice {
    std::string feature = {};  ///< the unusual feature, such as "a thousands separator"; "": not recognised
    std::string filter = {};   ///< a shell command that converts such a text; "": there is no safe one
    std::string remedy = {};   ///< the remedy if there is no command
};

FieldAdvice advise_on_field(std::string_view field);

}  // namespace corpuscle
