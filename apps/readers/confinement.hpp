#pragma once
// The rights that a helper program gives up before it reads the first byte of a file.

#include <cstdint>

namespace corpuscle {

/// Forbids this process new privileges, descriptors, files, programs, connections and core dumps, and lets it use at most `memory` bytes
/// more address space than now. Existing lower limits stay. Landlock and seccomp are used if the kernel has them. Descriptors up to
/// `last_descriptor` stay usable.
void confine(int last_descriptor, std::uint64_t memory);

}  // namespace corpuscle
