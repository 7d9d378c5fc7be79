#pragma once
// Recognises unsupported files of other programs by their first bytes or their name.

#include <string>
#include <string_view>

namespace corpuscle {

/// An error message with the file's format and a command that converts it. "" if the format is not recognised. `first` holds the first
/// bytes of the file, about 512.
std::string describe_foreign_format(std::string_view first, const std::string& path);

/// Like describe_foreign_format(), for binary files of supported formats (HDF5, NumPy ...) with a wrong file extension.
std::string describe_misnamed_format(std::string_view first, const std::string& path);

/// A command that decompresses a file with gzip, bzip2, xz or zstd. The name of its output is the file name without `extension`. If the
/// file has another extension, "-unpacked" replaces it.
std::string unpack_command(const std::string& program, std::string_view extension, const std::string& path);

/// A path as a shell word, quoted if necessary.
std::string quote_shell_word(const std::string& path);

}  // namespace corpuscle
