// Any bytes as a saved state: refused, or packed again to the same bytes and refused or taken by an afferent.

#include <cstdint>
#include <cstdlib>

#include "model/catalog.hpp"

using namespace corpuscle;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    auto state = unpack(bytes);
    if (!state) return 0;
    const auto again = pack(*state);
    if (!std::equal(bytes.begin(), bytes.end(), again.begin(), again.end())) std::abort();
    static const auto afferent = make_afferent(*plan_afferent("sa1", {}), {});
    std::vector<Spike> spikes;
    Answer answer{spikes};
    const std::vector<double> force(64, 1.0);
    (void)afferent->respond(force, *state, answer);
    return 0;
}
