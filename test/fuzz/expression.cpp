// Arbitrary text as an expression. Expected: the same value with and without slopes, or an error with a message and a location.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "circuit/expression/expression.hpp"

using namespace corpuscle;
using namespace corpuscle::circuit;

namespace {

void evaluate(const Expression& f) {
    std::vector<double> x(f.inputs().size()), slopes(x.size());
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = 0.25 * static_cast<double>(k % 9) - 1;
    const double plain = f.value(x), sloped = f.value(x, slopes);
    if (std::bit_cast<std::uint64_t>(plain) != std::bit_cast<std::uint64_t>(sloped)) std::abort();
    for (const auto& input : f.inputs())
        if (input.kind == ExpressionInput::Kind::voltage && (input.name.empty() || input.name == input.minus)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const ExpressionScope::Function twice{{"x"}, "x+x"}, power{{"x", "y"}, "twice(x)^y"}, endless{{}, "1+endless()"};
    ExpressionScope scope;
    scope.parameter = [](std::string_view name) { return name == "p" ? std::optional(2.5) : std::nullopt; };
    scope.function = [&](std::string_view name) {
        return name == "twice" ? &twice : name == "power" ? &power : name == "endless" ? &endless : nullptr;
    };
    scope.suggestions = {"p"};
    for (const bool inputs : {false, true}) {
        scope.allows_inputs = inputs;
        const auto f = Expression::parse(text, {"f", 1, 1}, scope);
        if (f)
            evaluate(*f);
        else if (f.error().message.empty() || f.error().location.column < 1 || f.error().location.column > static_cast<long>(size) + 1)
            std::abort();
        if (f && !inputs && !f->is_constant()) std::abort();
    }
    return 0;
}
