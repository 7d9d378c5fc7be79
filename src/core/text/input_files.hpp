#pragma once
// Opening and reading of input files. The device and inode of every input are stored, so that no output file replaces an input. A read that
// waits for a pipe or a terminal ends at an interruption, such as Ctrl-C.

#include <cstdio>
#include <span>

#include "core/error.hpp"

namespace corpuscle {

/// Registers a file as an input. "-" is standard input. Does nothing if the path is not that of a regular file.
void remember_input(const std::string& path);

/// If the file at `path` is a registered input: the path under which it was registered first, which differs from `path` if the file has
/// several paths. nullopt if it is not an input.
std::optional<std::string> known_input_path(const std::string& path);

/// Sets the function that read_input() calls again and again while it waits. If the function returns true, the read ends with an error.
/// Without a function, reads wait without limit.
void set_interruption_check(bool (*is_interrupted)());

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, FileCloser>;

/// Opens a file for reading and registers it as an input. Does not wait, not even until a named pipe has a writer. On failure returns null
/// and sets errno.
FileHandle open_input(const std::string& path);

/// Fills `to` and returns the number of bytes read. Fewer bytes than the size of `to` mark the end of the file; an interruption is an
/// error. `name` is the file's name for messages. Do not mix with fread(): the data of pipes do not pass through the buffer of the FILE.
Result<std::size_t> read_input(std::FILE*, std::span<char> to, const std::string& name);

/// Reads an entire file. A file larger than `max_bytes` is an error. `kind` is the expected kind of file, for messages: "population file".
Result<std::string> read_entire_input(const std::string& path, std::size_t max_bytes, const std::string& kind);

/// The first `count` bytes of a regular file, following links, or all bytes of a shorter file. "" for a pipe or similar, which can be read
/// only once, and for a file that cannot be opened. Does not register the file as an input.
std::string peek_input(const std::string& path, std::size_t count = 4096);

}  // namespace corpuscle
