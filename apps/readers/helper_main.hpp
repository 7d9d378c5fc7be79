#pragma once
// The helper programs: the main loop, which they share, and the readers and writers of each file format. Only helper programs call the
// readers, because damaged files have crashed the libraries of the formats, or could make them loop forever.

#include <functional>

#include "io/hdf5/hdf5_tree.hpp"
#include "io/nwb/nwb_messages.hpp"
#include "io/recording/samples.hpp"
#include "io/sandbox/helper_messages.hpp"

namespace corpuscle {

/// Opens the samples of the file that is open as descriptor `file`; `path` is for messages.
using OpenSamples = std::function<SamplesResult(int file, const std::string& path, const TableOptions&)>;

/// Opens the dataset of an HDF5 file that the options request, or the only one that can be a recording.
SamplesResult open_hdf5_samples(int file, const std::string& path, const TableOptions&);
/// Opens a sound file with libsndfile. The options are not used.
SamplesResult open_sound_samples(int file, const std::string& path, const TableOptions&);

/// Reads the units of the NWB file that is open as descriptor `file`.
Result<std::vector<NwbUnit>> read_nwb_units(int file, const UnitsRequest&);

/// Reads all datasets of the HDF5 file that is open as descriptor `file`; see read_hdf5_tree().
Result<std::vector<Hdf5Array>> hdf5_tree(int file, const TreeRequest&);
/// Reads the trials of the NWB file that is open as descriptor `file`.
Result<NwbTrialTable> read_nwb_trials(int file, const TrialsRequest&);

/// Whether a helper program may change the file that is open as its descriptor.
enum class FileAccess { read, write };

/// Forbids this process new privileges, descriptors, files, programs, connections and core dumps, and lets it use at most `memory` bytes
/// more address space than now. Existing lower limits stay. Landlock and seccomp are used if the kernel has them. Descriptors up to
/// `last_descriptor` stay usable.
void confine(int last_descriptor, std::uint64_t memory, FileAccess);

/// One service of a helper program. The program `corpuscle` requests it by its protocol.
struct HelperService {
    std::string_view protocol;  ///< HelperProcess::protocol ...
    FileAccess access = FileAccess::read;
    /// Serves the requests on `socket` about the file that is open as descriptor `file`, until the socket is closed.
    std::function<void(int socket, int file)> serve;
};

/// The service that opens the samples of the file and sends the requested rows.
HelperService samples_service(const OpenSamples&);
/// The service that sends the units of an NWB file.
HelperService units_service();
/// The service that sends all datasets of an HDF5 file.
HelperService tree_service();
/// The service that sends the trials of an NWB file.
HelperService trials_service();
/// The service that writes an HDF5 file.
HelperService writer_service();

/// Receives a message and starts the time limit of its reply: an alarm that ends the program. Returns false if the socket was closed.
bool next_request(int socket, std::string& message);
/// Ends the time limit and sends the reply.
bool send_reply(int socket, const std::string& message);
/// Sends what `reply` returns for the file at `path`, or the error if it throws an exception.
void reply_safely(int socket, const std::string& path, const std::function<std::string()>& reply);

/// The service that answers one request: `read` returns what it asks for, or an error.
template <class Request, class Read>
HelperService request_service(const char* protocol, Read read) {
    return {protocol, FileAccess::read, [read](int socket, int file) {
                std::string m;
                Request request;
                if (!next_request(socket, m) || !decode_request(m, request)) return;
                reply_safely(socket, request.path, [&] {
                    const auto contents = read(file, request);
                    return contents ? encode_response(*contents) : encode(contents.error());
                });
            }};
}

/// The main function of a helper program: it confines itself and serves requests until the socket is closed. `kind` names the file format
/// in the message to a user who starts the program by hand.
int helper_main(int argc, char** argv, const char* kind, const std::vector<HelperService>&);

}  // namespace corpuscle
