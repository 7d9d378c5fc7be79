#pragma once
// Arbitrary bytes as a file of a text table, for a reader that takes a path.

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "require.hpp"

namespace corpuscle::fuzz {

/// A file with these bytes; `name` is that of the fuzzer. It is removed at the end of the process.
inline const std::string& write_table(const char* name, const std::uint8_t* data, std::size_t size) {
    static const std::string path = std::string("/tmp/corpuscle-fuzz-") + name + "-" + std::to_string(::getpid()) + ".csv";
    static const bool once = [] { return std::atexit([] { std::remove(path.c_str()); }), true; }();
    (void)once;
    if (std::FILE* f = std::fopen(path.c_str(), "wb")) {
        std::fwrite(data, 1, size, f);
        std::fclose(f);
    }
    return path;
}

/// An error must have a message and name an existing line, if any.
inline void check_located(const Error& error, const std::uint8_t* data, std::size_t size) {
    require(!error.message.empty());
    const bool is_gzip = size > 1 && data[0] == 0x1f && data[1] == 0x8b;  // the number of lines is unknown
    require(is_gzip || error.location.line <= 1 + std::count(data, data + size, '\n'));
}

}  // namespace corpuscle::fuzz
