#pragma once
// Recognises unsupported files of other programs by their first bytes or their name.

#include <string>
#include <string_view>

namespace corpuscle {

/// An error message that names the format of an unsupported file, and a command that converts it. "" if the format is not recognised.
/// `first` holds the first bytes of the file, up to 512.
std::string describe_foreign_format(std::string_view first, const std::string& path);

/// An error message for a file that is read as text because of its file extension, but is in a supported binary format (HDF5, NumPy ...) or
/// a zip archive. It names a command that gives the file the right extension, or extracts it. "" for other files.
std::string describe_misnamed_format(std::string_view first, const std::string& path);

/// A shell command that decompresses a file with `program` (gzip, bzip2, xz or zstd). The output file has the name without `extension`. If
/// the file does not have this extension, the output has the name without any extension, followed by "-unpacked".
std::string unpack_command(const std::string& program, std::string_view extension, const std::string& path);

/// A path as a shell word, quoted if necessary.
std::string quote_shell_word(const std::string& path);

}  // namespace corpuscle
