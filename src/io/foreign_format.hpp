#pragma once
// Files of other programs that are not read here, known by their first bytes or their name.

#include <string>
#include <string_view>

namespace corpuscle {

/// What the file is and a command that makes a readable one of it; "" if it is none of these. `first`: its first bytes, some 512.
std::string foreign_format(std::string_view first, const std::string& path);

/// The same of files that are no text but are read here by another name (HDF5, NumPy ...); what names them is the end of their name.
std::string misnamed_format(std::string_view first, const std::string& path);

/// The command that unpacks a file of gzip, bzip2, xz or zstd. Its output has the name without `extension`, or name-unpacked.
std::string unpack_command(const std::string& program, std::string_view extension, const std::string& path);

/// A path as a shell takes it, in quotes where it needs them.
std::string shell_word(const std::string& path);

}  // namespace corpuscle
