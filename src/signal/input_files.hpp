#pragma once
// Files that are read. This process remembers them by device and inode, so that no output takes the place of one; and where a read must
// wait (a pipe, a terminal), an interruption ends it.

#include <cstdio>
#include <optional>
#include <span>
#include <string>

#include "signal/error.hpp"

namespace corpuscle {

/// "-" stands for standard input. A path at which there is no regular file is left out.
void remember_input(const std::string& path);

/// The path by which the file at `path` was read, under this name or another one; none: it was not.
std::optional<std::string> input_at(const std::string& path);

/// Asked while a read waits, and by nothing else; without one, reads wait for ever.
void set_interruption(bool (*is_interrupted)());

/// fopen() for reading, of a file that is remembered; never waits, not even for the writer of a named pipe. Null: errno says why.
std::FILE* open_input(const std::string& path);

/// fread(), but that an interruption is an error. Fewer bytes than asked for: the end. No other way of reading may be mixed with it.
Result<std::size_t> read_input(std::FILE*, std::span<char>, const std::string& name);

/// All of a file of at most `most_bytes`; `what` it should be is named if it is larger ("population file").
Result<std::string> read_whole_input(const std::string& path, std::size_t most_bytes, const std::string& what);

/// The first bytes of a regular file; "" of what can be read only once, such as a pipe, and of a file that cannot be opened.
std::string first_bytes_of_input(const std::string& path, std::size_t count);

}  // namespace corpuscle
