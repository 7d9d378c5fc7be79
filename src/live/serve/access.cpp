#include "live/serve/access.hpp"

#include <fmt/format.h>
#include <sys/random.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/text/ascii_text.hpp"

namespace corpuscle {
namespace {

/// The token in the query of a target such as "/?token=0123"; "" if there is none.
std::string_view token_of(std::string_view target) {
    constexpr std::string_view key = "token=";
    const auto query = target.find('?');
    if (query == target.npos) return {};
    for (const auto field : split(target.substr(query + 1), '&'))
        if (field.starts_with(key)) return field.substr(key.size());
    return {};
}

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

}  // namespace

bool equal_in_constant_time(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    volatile unsigned char difference = 0;  // volatile: the compiler must not end the loop early
    for (std::size_t k = 0; k < a.size(); ++k)
        difference = static_cast<unsigned char>(difference | (static_cast<unsigned char>(a[k]) ^ static_cast<unsigned char>(b[k])));
    return difference == 0;
}

Result<std::string> make_access_token() {
    unsigned char bytes[16];
    if (::getrandom(bytes, sizeof bytes, 0) != sizeof bytes)
        return bad_input(fmt::format("the system gives no random numbers for a token: {}", std::strerror(errno)));
    std::string text;
    for (const auto byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

bool is_loopback_address(std::string_view address) {
    return address == "::1" || equal_ignoring_case(address, "localhost") ||
           (address.starts_with("127.") && address.find_first_not_of("0123456789.") == address.npos);
}

AccessPolicy::AccessPolicy(std::string address, int port, std::string token, std::string url, std::string socket_path)
    : token_(std::move(token)), socket_path_(std::move(socket_path)), url_(std::move(url)) {
    if (!token_.empty()) return;
    if (address.find(':') != address.npos) address = "[" + address + "]";
    for (const std::string& name : {std::string("localhost"), std::string("127.0.0.1"), std::string("[::1]"), lower(address)}) {
        if (name.empty()) continue;
        hosts_.push_back(fmt::format("{}:{}", name, port));
        if (port == 80) hosts_.push_back(name);  // a browser omits the default port
    }
}

AccessDecision AccessPolicy::decide(const PageRequest& request) const {
    if (request.hosts.size() != 1) return {400, "A request needs one Host header."};
    const auto host = lower(request.hosts[0]);
    if (!hosts_.empty() && std::find(hosts_.begin(), hosts_.end(), host) == hosts_.end())
        return {421, fmt::format("This server is for this machine only. Open {}", url_)};
    if (!token_.empty() && !equal_in_constant_time(token_of(request.target), token_))
        return {401, "Open the address with the token that corpuscle has printed."};
    if (request.method != "GET" && request.method != "HEAD") return {405, "This server answers GET and HEAD only."};
    if (!request.target.starts_with('/')) return {400, "The target of a request begins with '/'."};
    if (path_of(request.target) != (request.is_upgrade ? socket_path_ : "/"))
        return {404, fmt::format("There is one page here, at /, and one WebSocket, at {}.", socket_path_)};
    if (!request.is_upgrade) return {200};
    if (request.origins.size() > 1 || (request.origins.size() == 1 && lower(request.origins[0]) != "http://" + host))
        return {403, "A page of another site must not open this WebSocket."};
    return {101};
}

}  // namespace corpuscle
