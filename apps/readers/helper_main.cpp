#include "helper_main.hpp"

#include <fmt/format.h>
#include <cstdlib>
#include <exception>
#include <new>

#include "io/sandbox/helper_process.hpp"
#include "io/sandbox/remote_samples.hpp"

namespace corpuscle {
namespace {

/// Receives a request and starts the time limit of its reply: an alarm that ends the program. Returns false if the socket was closed.
bool next_request(int socket, std::string& m) {
    if (!receive_message(socket, m)) return false;
    ::alarm(HelperProcess::response_timeout_s);
    return true;
}

/// Ends the time limit and sends the reply.
bool send_reply(int socket, const std::string& m) {
    ::alarm(0);
    return send_message(socket, m);
}

/// The requested samples, or the error.
std::string reply_to(const FetchRequest& request, Samples& samples) {
    std::vector<std::vector<double>> out(request.wanted.size(), std::vector<double>(request.rows));
    if (auto ok = samples.fetch(static_cast<std::int64_t>(request.first), request.rows, request.wanted, out); !ok)
        return encode(ok.error());
    return encode(out);
}

/// Opens the file as the first request says, then serves requests for rows until the socket is closed.
void serve_requests(int socket, int file, const OpenRequest& first, const OpenSamples& open) {
    auto samples = open(file, first.path, first.options);
    if (!send_reply(socket, samples ? encode((*samples)->info()) : encode(samples.error())) || !samples) return;
    FetchRequest request;
    for (std::string m; next_request(socket, m) && decode(m, request);)
        if (!send_reply(socket, reply_to(request, **samples))) return;
}

}  // namespace

void serve(int socket, int file, const OpenSamples& open) {
    std::string m;
    OpenRequest first;
    if (!next_request(socket, m) || !decode(m, first)) return;
    try {
        serve_requests(socket, file, first, open);
    } catch (const std::bad_alloc&) {
        send_reply(socket, encode(bad_input("not enough memory for this file", {first.path})));
    } catch (const std::exception& e) {
        send_reply(socket, encode(bad_input(fmt::format("cannot be read: {}", e.what()), {first.path})));
    } catch (...) {
        send_reply(socket, encode(bad_input("cannot be read", {first.path})));
    }
}

int helper_main(int argc, char** argv, const char* kind, const OpenSamples& open) {
    if (argc != 2 || std::string_view(argv[1]) != HelperProcess::protocol) {
        fmt::print(stderr, "Corpuscle starts this program to read {} files; it cannot be used on its own.\n", kind);
        return HelperProcess::exit_unknown_protocol;
    }
    confine(HelperProcess::file_descriptor, HelperProcess::memory_limit);
    serve(HelperProcess::socket_descriptor, HelperProcess::file_descriptor, open);
    std::_Exit(0);  // skips the exit handlers of the format's library, which a damaged file may have broken
}

}  // namespace corpuscle
