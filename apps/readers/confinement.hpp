#pragma once
// The rights that a helper program gives up before it reads the first byte of a file.

#include <cstdint>

namespace corpuscle {

/// Forbids new privileges, descriptors, files, programs, connections and core dumps, and bounds memory to `memory` bytes beyond the present
/// use. Resource limits are only lowered. Landlock and seccomp are used if the kernel has them. Descriptors up to `last_descriptor` stay
/// open.
void confine(int last_descriptor, std::uint64_t memory);

}  // namespace corpuscle
