// Arbitrary bytes as a saved state, as they are and with a valid checksum added. Expected: rejected, or packed to the same bytes again and
// then accepted or rejected by an afferent.

#include <cstdint>
#include <cstdlib>

#include "core/checksum.hpp"
#include "model/catalog.hpp"

using namespace corpuscle;

namespace {

void try_state(std::span<const std::byte> bytes) {
    auto state = unpack(bytes);
    if (!state) return;
    const auto again = pack(*state);
    const bool has_checksum = bytes[6] != std::byte{'1'};  // version 1 has none
    if (has_checksum && !std::equal(bytes.begin(), bytes.end(), again.begin(), again.end())) std::abort();
    static const auto afferent = make_afferent(*plan_afferent("sa1"), {});
    std::vector<Spike> spikes;
    ResponseBlock response{spikes};
    const std::vector<double> force(64, 1.0);
    (void)afferent->respond(force, *state, response);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    try_state(bytes);
    std::vector<std::byte> with_checksum(bytes.begin(), bytes.end());
    const auto sum = checksum_of(bytes);
    const auto* const end = reinterpret_cast<const std::byte*>(&sum);
    with_checksum.insert(with_checksum.end(), end, end + sizeof sum);
    try_state(with_checksum);
    return 0;
}
