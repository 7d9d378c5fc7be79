#include "reproduction/thesis/array_text.hpp"

#include <fmt/format.h>

namespace corpuscle {

std::string array_lines(const std::string& name, const std::string& drain, const std::string& gate, const std::string& source, int m, int n,
                        const std::string& rest) {
    std::string out;
    for (int column = 0; column < m; ++column)
        for (int k = 0; k < n; ++k) {  // k counts from the source; inner(k) is the node between the transistors k - 1 and k
            const auto inner = [&](int level) { return fmt::format("{}_{}_{}", name, column, level); };
            out += fmt::format("m{}_{}_{} {} {} {} {}\n", name, column, k, k + 1 == n ? drain : inner(k + 1), gate,
                               k == 0 ? source : inner(k), rest);
        }
    return out;
}

}  // namespace corpuscle
