#pragma once
// Directives of former versions, which are refused, with their present names.

#include <string_view>

namespace corpuscle::circuit {

struct RenamedDirective {
    std::string_view old_name, new_name;
};
inline constexpr RenamedDirective renamed_directives[] = {{".within", ".assert"}};

}  // namespace corpuscle::circuit
