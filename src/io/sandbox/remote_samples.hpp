#pragma once
// Samples that a helper program reads in a process of its own (helper_process.hpp), and the messages between this
// process and the helper program.

#include "io/recording/samples.hpp"

namespace corpuscle {

/// The first message to the program.
struct OpenRequest {
    std::string path;      ///< for error messages only: the file is open already
    TableOptions options;  ///< only `dataset` and `transpose` are sent
};

/// All further messages to the program: a request for rows of some columns.
struct FetchRequest {
    std::uint64_t first = 0, rows = 0;     ///< index of the first row (from 0), and number of rows
    std::vector<std::size_t> wanted = {};  ///< indices of the columns
};

std::string encode(const OpenRequest&);
std::string encode(const FetchRequest&);
// Return false if the message is not such a request.
bool decode(const std::string&, OpenRequest&);
bool decode(const std::string&, FetchRequest&);

// Responses of the program. A response begins with 0; an error begins with its ErrorCode, which is not 0.
std::string encode(const Error&);
std::string encode(const SamplesInfo&);
std::string encode(const std::vector<std::vector<double>>& columns);

// Decode responses; `path` is the path of the file, for messages. The program is not trusted: any bytes give values or an error.
Result<SamplesInfo> decode_info(const std::string&, const std::string& path);
/// Decodes the response to a FetchRequest for `rows` rows, and stores the values of each column in `out` from position `at` on.
Result<void> decode_rows(const std::string&, std::size_t at, std::size_t rows, std::vector<std::vector<double>>& out,
                         const std::string& path);

/// Success, or the error that a response states. Any bytes after a success are ignored.
Result<void> decode_status(const std::string&, const std::string& path);

/// The helper program for one file format.
struct HelperProgram {
    std::string program;  ///< name of the program: "corpuscle-hdf5"
    std::string library;  ///< the library's name, with which error messages begin: "the HDF5 library"
};

/// Starts the helper program, which reads the file at `path`. It runs until the samples are destroyed.
SamplesResult open_remote_samples(const std::string& path, const HelperProgram&, const TableOptions& = {});

/// The same with the program whose path is `program`.
SamplesResult open_remote_samples_with(const std::string& program, const std::string& path, const HelperProgram&, const TableOptions& = {});

}  // namespace corpuscle
