#pragma once
// Fields that are meant as numbers but are not written as they are read here: what is unusual in them, and how to rewrite them.

#include <string>
#include <string_view>

namespace corpuscle {

struct FieldAdvice {
    std::string what = {};    ///< what the field has, as "a separator of thousands"; "": nothing that is known
    std::string filter = {};  ///< a shell's command that rewrites such a text; "": there is no safe one
    std::string remedy = {};  ///< what to do where there is no command
};

FieldAdvice advice_on(std::string_view field);

}  // namespace corpuscle
