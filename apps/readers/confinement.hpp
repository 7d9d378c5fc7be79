#pragma once
// What a helper program gives up before it looks at the first byte of a file.

#include <cstdint>

namespace corpuscle {

/// No new privileges, descriptors, files, programs, connections or core; bounded memory. Limits are only lowered. Landlock and seccomp are
/// used where the kernel has them; the limits hold everywhere. Descriptors up to `last` stay.
void confine(int last, std::uint64_t memory);

}  // namespace corpuscle
