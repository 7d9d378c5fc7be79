#pragma once
// Messages between this process and a helper program as bytes. A response begins with a number: 0, or the ErrorCode of an error
// (remote_samples.hpp).

#include "core/bytes.hpp"
#include "io/sandbox/remote_samples.hpp"

namespace corpuscle {

template <class... T>
std::string message_of(const T&... values) {
    ByteWriter out;
    out.put(values...);
    return out.take();
}

inline Error broken_response(const std::string& path) {
    return bad_input("invalid response of the helper process that reads this file", {path});
}

template <class Request>
std::string encode_request(const Request& request) {
    return message_of(request);
}
/// False if the message is not such a request.
template <class Request>
bool decode_request(const std::string& m, Request& request) {
    return ByteReader(m).get(request);
}

/// A response that is not an error.
template <class... T>
std::string encode_response(const T&... contents) {
    return message_of(std::uint64_t{0}, contents...);
}
/// Decodes a response; `path` is the path of the file, for messages. The program is not trusted: any bytes give contents or an error.
template <class T>
Result<T> decode_response(const std::string& m, const std::string& path) {
    TRY(decode_status(m, path));
    ByteReader in(m);
    std::uint64_t status = 0;
    T contents;
    if (in.get(status, contents)) return contents;
    return broken_response(path);
}

}  // namespace corpuscle
