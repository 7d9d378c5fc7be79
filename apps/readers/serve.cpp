#include "serve.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "confinement.hpp"
#include "io/helper_process.hpp"
#include "io/samples_message.hpp"

namespace corpuscle {
namespace {

/// The time for an answer runs only while one is awaited. The alarm ends the program.
bool next_request(int socket, Message& m) {
    if (!m.receive(socket)) return false;
    ::alarm(HelperProcess::seconds_to_answer);
    return true;
}

bool give_answer(int socket, const Message& m) {
    ::alarm(0);
    return m.send(socket);
}

Message answer_to(const FetchRequest& request, Samples& samples) {
    std::vector<std::vector<double>> out(request.wanted.size(), std::vector<double>(request.rows));
    if (auto ok = samples.fetch(static_cast<std::int64_t>(request.first), request.rows, request.wanted, out); !ok)
        return encode(ok.error());
    return encode(out);
}

void answer_requests(int socket, int file, const OpenRequest& first, const OpenSamples& open) {
    auto samples = open(file, first.path, first.options);
    if (!give_answer(socket, samples ? encode((*samples)->facts()) : encode(samples.error())) || !samples) return;
    FetchRequest request;
    for (Message m; next_request(socket, m) && decode(m, request);)
        if (!give_answer(socket, answer_to(request, **samples))) return;
}

}  // namespace

void serve(int socket, int file, const OpenSamples& open) {
    Message m;
    OpenRequest first;
    if (!next_request(socket, m) || !decode(m, first)) return;
    try {
        answer_requests(socket, file, first, open);
    } catch (const std::bad_alloc&) {
        give_answer(socket, encode(bad_input("this file takes more memory than there is", {first.path})));
    } catch (const std::exception& e) {
        give_answer(socket, encode(bad_input(fmt::format("cannot be read: {}", e.what()), {first.path})));
    } catch (...) {
        give_answer(socket, encode(bad_input("cannot be read", {first.path})));
    }
}

int helper_main(int argc, char** argv, const char* kind, const OpenSamples& open) {
    if (argc != 2 || std::string_view(argv[1]) != HelperProcess::protocol) {
        fmt::print(stderr, "Corpuscle starts this program to read {} files; it is of no use by itself.\n", kind);
        return HelperProcess::other_version;
    }
    confine(HelperProcess::file_number, HelperProcess::memory);
    serve(HelperProcess::socket_number, HelperProcess::file_number, open);
    std::_Exit(0);  // without the library's own clean-up
}

}  // namespace corpuscle
