#pragma once
// The messages between this process and a helper program that reads samples.

#include "io/message.hpp"
#include "io/samples.hpp"

namespace corpuscle {

/// The first message to the program.
struct OpenRequest {
    std::string path;      ///< for error messages only: the file is open already
    TableOptions options;  ///< only `dataset` and `transpose` are sent
};

/// All further messages: `rows` rows of the columns `wanted`, from row `first` on.
struct FetchRequest {
    std::uint64_t first = 0, rows = 0;
    std::vector<std::size_t> wanted = {};
};

Message encode(const OpenRequest&);
Message encode(const FetchRequest&);
bool decode(Message&, OpenRequest&);
bool decode(Message&, FetchRequest&);

// Responses. A response begins with 0; an error begins with its ErrorCode.
Message encode(const Error&);
Message encode(const SamplesInfo&);
Message encode(const std::vector<std::vector<double>>& columns);

// Decode responses; `path` is for errors. The child is not trusted: any bytes give values or an error.
Result<SamplesInfo> decode_info(Message&, const std::string& path);
/// Decodes `rows` rows into each column of `out`, from row `at` on.
Result<void> decode_rows(Message&, std::size_t at, std::size_t rows, std::vector<std::vector<double>>& out, const std::string& path);

}  // namespace corpuscle
