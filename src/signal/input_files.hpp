#pragma once
// Input files. The process stores their devices and inodes, so that no output file replaces an input. A read that waits for a pipe or a
// terminal ends at an interruption, such as Ctrl-C.

#include <cstdio>
#include <optional>
#include <span>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

/// Registers a file as an input. "-" is standard input. A path without a regular file is ignored.
void remember_input(const std::string& path);

/// The path by which the file at `path` was read, possibly under another name. nullopt if it was not read.
std::optional<std::string> known_input_path(const std::string& path);

/// Sets the function that is called while a read waits. If it returns true, the read ends. Without it, reads wait without limit.
void set_interruption_check(bool (*is_interrupted)());

/// Opens a file for reading and registers it as an input. Never waits, not even for the writer of a named pipe. On failure returns null and
/// sets errno.
std::FILE* open_input(const std::string& path);

/// Like fread(), but an interruption is an error. Fewer bytes than requested mark the end. Do not read the same file with other functions.
Result<std::size_t> read_input(std::FILE*, std::span<char>, const std::string& name);

/// Reads an entire file. A file larger than `max_bytes` is an error, which names the expected `kind` ("population file").
Result<std::string> read_entire_input(const std::string& path, std::size_t max_bytes, const std::string& kind);

/// The first bytes of a regular file. "" for a pipe or similar, which can be read only once, and for a file that cannot be opened.
std::string peek_input(const std::string& path, std::size_t count);

}  // namespace corpuscle
