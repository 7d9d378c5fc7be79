#pragma once
// A single request about an HDF5 file, which a helper program answers.

#include "io/sandbox/helper_messages.hpp"
#include "io/sandbox/helper_process.hpp"

namespace corpuscle {

/// Opens the file, registers it as an input, sends `request` to a helper program that offers the service `protocol`, and returns its
/// response.
Result<std::string> hdf5_response(const std::string& path, const std::string& protocol, const std::string& request);

/// The same with a request that has a `path`, and a decoded response.
template <class Response, class Request>
Result<Response> request_from_hdf5(const char* protocol, const Request& request) {
    return decode_response<Response>(TRY(hdf5_response(request.path, protocol, encode_request(request))), request.path);
}

}  // namespace corpuscle
