// Arbitrary bytes as the saved origin of a force. Expected: an error, or an origin that is the same after it is saved and loaded again, and
// whose metrics are of its channels.

#include <cstdint>
#include <cstdlib>

#include "api/force_origin.hpp"

using namespace corpuscle;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const auto origin = load_origin(std::string(reinterpret_cast<const char*>(data), size));
        for (const auto& m : origin->quality.metrics)
            if (m.channel >= origin->channels.size()) std::abort();
        const auto text = save_origin(*origin);
        if (save_origin(*load_origin(text)) != text) std::abort();
    } catch (const InputError& error) {
        if (*error.what() == '\0') std::abort();
    }
    return 0;
}
