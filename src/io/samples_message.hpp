#pragma once
// What a helper program is asked and answers: samples, as messages.

#include "io/message.hpp"
#include "io/samples.hpp"

namespace corpuscle {

/// The first message to the program.
struct OpenRequest {
    std::string path;  ///< for messages only: the file is open already
    TableOptions options;
};

/// The others: rows from a number on, of columns.
struct FetchRequest {
    std::uint64_t first = 0, rows = 0;
    std::vector<std::size_t> wanted = {};
};

Message encode(const OpenRequest&);
Message encode(const FetchRequest&);
bool decode(Message&, OpenRequest&);
bool decode(Message&, FetchRequest&);

// Answers. Each begins with 0, or is an error.
Message encode(const Error&);
Message encode(const SamplesFacts&);
Message encode(const std::vector<std::vector<double>>& columns);

// Answers as the parent reads them; `path` is for errors. The program may be broken: any bytes give values or an error.
Result<SamplesFacts> decode_facts(Message&, const std::string& path);
/// Rows from number `at` on of each column of `out`.
Result<void> decode_rows(Message&, std::size_t at, std::size_t rows, std::vector<std::vector<double>>& out, const std::string& path);

}  // namespace corpuscle
