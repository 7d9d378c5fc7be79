#include "helper_main.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>

#include "io/sandbox/helper_process.hpp"
#include "io/sandbox/remote_samples.hpp"

namespace corpuscle {
namespace {

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

bool next_request(int socket, std::string& m) {
    if (!receive_message(socket, m)) return false;
    ::alarm(HelperProcess::response_timeout_s);
    return true;
}

bool send_reply(int socket, const std::string& m) {
    ::alarm(0);
    return send_message(socket, m);
}

void reply_safely(int socket, const std::string& path, const std::function<std::string()>& reply) {
    std::string m;
    try {
        m = reply();
    } catch (const std::bad_alloc&) {
        m = encode(bad_input("not enough memory for this file", {path}));
    } catch (const std::exception& e) {
        m = encode(bad_input(fmt::format("cannot be read: {}", e.what()), {path}));
    } catch (...) {
        m = encode(bad_input("cannot be read", {path}));
    }
    if (!m.empty()) send_reply(socket, m);
}

HelperService samples_service(const OpenSamples& open) {
    const auto serve = [open](int socket, int file) {
        std::string m;
        OpenRequest first;
        if (!next_request(socket, m) || !decode(m, first)) return;
        reply_safely(socket, first.path, [&] { return serve_requests(socket, file, first, open), std::string(); });
    };
    return {HelperProcess::protocol, FileAccess::read, serve};
}

int helper_main(int argc, char** argv, const char* kind, const std::vector<HelperService>& services) {
    const auto is_requested = [&](const HelperService& s) { return argc == 2 && s.protocol == argv[1]; };
    const auto service = std::find_if(services.begin(), services.end(), is_requested);
    if (service == services.end()) {
        fmt::print(stderr, "Corpuscle starts this program to read {} files; it cannot be used on its own.\n", kind);
        return HelperProcess::exit_unknown_protocol;
    }
    confine(HelperProcess::file_descriptor, HelperProcess::memory_limit, service->access);
    service->serve(HelperProcess::socket_descriptor, HelperProcess::file_descriptor);
    std::_Exit(0);  // skips the exit handlers of the format's library, which a damaged file may have broken
}

}  // namespace corpuscle
