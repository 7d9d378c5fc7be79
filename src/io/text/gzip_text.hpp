#pragma once

#include "io/text/line_reader.hpp"

namespace corpuscle {

/// The decompressed text of a gzip file, which is a sequence of members. `packed`: the compressed file.
std::unique_ptr<TextInput> make_gzip_text(std::string path, std::unique_ptr<TextInput> packed);

}  // namespace corpuscle
