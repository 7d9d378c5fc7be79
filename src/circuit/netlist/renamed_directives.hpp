#pragma once
// Old names of directives and their new names. A netlist with an old name is an error.

#include <string_view>

namespace corpuscle::circuit {

struct RenamedDirective {
    std::string_view old_name, new_name;
};
inline constexpr RenamedDirective renamed_directives[] = {{".within", ".assert"}};

}  // namespace corpuscle::circuit
