// Arbitrary texts as the parts of a request to the page server: method, target, Host headers, Origin headers. Expected: a page only for a
// right host or token, a WebSocket only for the own origin.

#include <algorithm>

#include "core/text/ascii_text.hpp"
#include "live/serve/access.hpp"
#include "require.hpp"

using namespace corpuscle;
using fuzz::require;

namespace {

const std::string token = "0123456789abcdef0123456789abcdef";

void check(const PageRequest& request) {
    static const AccessPolicy local("", 8080, "", "http://localhost:8080/", "/stream"),
        open("10.0.0.1", 8080, token, "http://10.0.0.1:8080/", "/stream");
    const auto here = local.decide(request).status, elsewhere = open.decide(request).status;
    for (const auto status : {here, elsewhere}) {
        require((status == 101) <= request.is_upgrade && (status == 200) <= !request.is_upgrade);
        require(status == 101 || status == 200 || (status >= 400 && status < 500));
        if (status >= 400) continue;
        require(request.hosts.size() == 1 && (request.method == "GET" || request.method == "HEAD"));
        const std::string path = request.is_upgrade ? "/stream" : "/";
        require(request.target == path || request.target.starts_with(path + "?"));
        if (status == 101 && !request.origins.empty())
            require(request.origins.size() == 1 && equal_ignoring_case(request.origins[0], "http://" + std::string(request.hosts[0])));
    }
    static const std::string hosts[] = {"localhost:8080", "127.0.0.1:8080", "[::1]:8080"};
    if (here < 400) require(std::find(std::begin(hosts), std::end(hosts), lower(request.hosts[0])) != std::end(hosts));
    if (elsewhere < 400) require(request.target.find("token=" + token) != request.target.npos);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto lines = split({reinterpret_cast<const char*>(data), size}, '\n');
    if (lines.size() < 2) return 0;
    PageRequest request{lines[0], lines[1], {}, {}, false};
    for (std::size_t k = 2; k < lines.size(); ++k) {
        if (lines[k] == "upgrade")
            request.is_upgrade = true;
        else if (lines[k].starts_with("O"))
            request.origins.push_back(lines[k].substr(1));
        else
            request.hosts.push_back(lines[k]);
    }
    check(request);
    is_loopback_address(lines[0]);
    return 0;
}
