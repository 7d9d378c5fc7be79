// Access to the page server: which requests get the page or a WebSocket, and which are refused.

#include "live/serve/access.hpp"
#include "live/serve/listeners.hpp"
#include "live/serve/rate_limit.hpp"
#include "support/support.hpp"

namespace corpuscle {
namespace {

AccessPolicy local_policy() { return {"", 8080, "", "http://localhost:8080/", "/stream"}; }
AccessPolicy token_policy() { return {"192.168.1.5", 8080, "0123456789abcdef0123456789abcdef", "http://192.168.1.5:8080/", "/stream"}; }

TEST(PageAccess, OnThisMachineOnlyItsOwnNamesAreAcceptedAsHost) {
    for (const char* host : {"localhost:8080", "127.0.0.1:8080", "[::1]:8080", "LocalHost:8080"})
        EXPECT_EQ(local_policy().decide({"GET", "/", {host}, {}, false}).status, 200U) << host;
    for (const char* host :
         {"evil.example:8080", "localhost", "localhost:8081", "localhost:8080.evil.example", "127.0.0.1.evil.example:8080", "",
          "localhost:8080@evil.example", " localhost:8080", "192.168.1.5:8080", "::1:8080", "[::1]"})
        EXPECT_EQ(local_policy().decide({"GET", "/", {host}, {}, false}).status, 421U) << host;
    EXPECT_EQ(local_policy().decide({"GET", "/", {}, {}, false}).status, 400U);
    EXPECT_EQ(local_policy().decide({"GET", "/", {"localhost:8080", "localhost:8080"}, {}, false}).status, 400U);
    EXPECT_EQ(AccessPolicy("", 80, "", "", "/stream").decide({"GET", "/", {"localhost"}, {}, false}).status, 200U);
    EXPECT_EQ(AccessPolicy("127.0.0.9", 8080, "", "", "/stream").decide({"GET", "/", {"127.0.0.9:8080"}, {}, false}).status, 200U);
}

TEST(PageAccess, ThereIsOnePathAndTwoMethods) {
    for (const char* target : {"/index.html", "/../../etc/passwd", "//", "/%2e%2e/etc/passwd", "/.", "/favicon.ico", "/?/../x/", "/#"}) {
        const auto status = local_policy().decide({"GET", target, {"localhost:8080"}, {}, false}).status;
        EXPECT_EQ(status, std::string_view(target).starts_with("/?") ? 200U : 404U) << target;
    }
    for (const char* target : {"", "http://localhost:8080/", "*", "etc/passwd"})
        EXPECT_EQ(local_policy().decide({"GET", target, {"localhost:8080"}, {}, false}).status, 400U) << target;
    EXPECT_EQ(local_policy().decide({"HEAD", "/", {"localhost:8080"}, {}, false}).status, 200U);
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", "get", ""})
        EXPECT_EQ(local_policy().decide({method, "/", {"localhost:8080"}, {}, false}).status, 405U) << method;
}

TEST(PageAccess, AWebSocketIsOpenedByTheOwnPageOrByAProgram) {
    EXPECT_EQ(local_policy().decide({"GET", "/stream", {"localhost:8080"}, {}, true}).status, 101U);
    EXPECT_EQ(local_policy().decide({"GET", "/", {"localhost:8080"}, {}, true}).status, 404U);
    EXPECT_EQ(local_policy().decide({"GET", "/stream", {"localhost:8080"}, {}, false}).status, 404U);
    EXPECT_EQ(local_policy().decide({"GET", "/stream", {"localhost:8080"}, {"http://localhost:8080"}, true}).status, 101U);
    for (const char* origin : {"http://evil.example", "http://127.0.0.1:8080", "https://localhost:8080", "null", "",
                               "http://localhost:80801", "http://localhost:8080/", "file://"})
        EXPECT_EQ(local_policy().decide({"GET", "/stream", {"localhost:8080"}, {origin}, true}).status, 403U) << origin;
    EXPECT_EQ(
        local_policy().decide({"GET", "/stream", {"localhost:8080"}, {"http://localhost:8080", "http://localhost:8080"}, true}).status,
        403U);
}

TEST(PageAccess, ElsewhereNothingIsAnsweredWithoutTheToken) {
    const std::string right = "token=0123456789abcdef0123456789abcdef";
    EXPECT_EQ(token_policy().decide({"GET", "/?" + right, {"robot.local:8080"}, {}, false}).status, 200U)
        << "the machine may have any name";
    const auto upgrade = token_policy().decide({"GET", "/stream?" + right, {"robot.local:8080"}, {"http://robot.local:8080"}, true});
    EXPECT_EQ(upgrade.status, 101U);
    EXPECT_EQ(token_policy().decide({"GET", "/stream?" + right, {"robot.local:8080"}, {"http://evil.example"}, true}).status, 403U);
    EXPECT_EQ(token_policy().decide({"GET", "/?a=1&" + right + "&b", {"robot.local:8080"}, {}, false}).status, 200U);
    const std::string wrong[] = {"/",
                                 "/x",
                                 "/?token=",
                                 "/?token",
                                 "/?" + right + "0",
                                 "/?token=1123456789abcdef0123456789abcdef",
                                 "/?token=0123456789ABCDEF0123456789ABCDEF",
                                 "/?Token=0123456789abcdef0123456789abcdef",
                                 "/?token=x&" + right,
                                 "/" + right};
    for (const auto& target : wrong) {
        EXPECT_EQ(token_policy().decide({"GET", target, {"192.168.1.5:8080"}, {}, false}).status, 401U) << target;
        EXPECT_EQ(token_policy().decide({"GET", target, {"192.168.1.5:8080"}, {}, true}).status, 401U) << target;
        EXPECT_EQ(token_policy().decide({"POST", target, {"192.168.1.5:8080"}, {}, false}).status, 401U) << target;
    }
}

TEST(PageAccess, ATokenIsLongAndNeverTheSame) {
    const auto first = test::value_or_throw(make_access_token()), second = test::value_or_throw(make_access_token());
    EXPECT_EQ(first.size(), 32U);
    EXPECT_EQ(first.find_first_not_of("0123456789abcdef"), first.npos);
    EXPECT_NE(first, second);
    EXPECT_TRUE(equal_in_constant_time(first, std::string(first)));
    EXPECT_FALSE(equal_in_constant_time(first, first.substr(1)));
    for (std::size_t k = 0; k < first.size(); ++k) {
        auto other = first;
        other[k] = other[k] == 'a' ? 'b' : 'a';
        EXPECT_FALSE(equal_in_constant_time(first, other)) << k;
    }
}

TEST(PageAccess, OnlyLoopbackAddressesNeedNoToken) {
    for (const char* address : {"127.0.0.1", "127.1.2.3", "::1", "localhost", "LOCALHOST"})
        EXPECT_TRUE(is_loopback_address(address)) << address;
    for (const char* address : {"0.0.0.0", "::", "192.168.1.5", "127.evil.example", "1127.0.0.1", "", "::2", "localhost.evil.example"})
        EXPECT_FALSE(is_loopback_address(address)) << address;
}

TEST(PageListeners, ListenOnBothLoopbackAddressesAtOnePort) {
    const auto first = test::value_or_throw(open_listeners("", 0));
    EXPECT_GT(first.port, 0);
    EXPECT_EQ(first.urls[0], "http://localhost:" + std::to_string(first.port) + "/");
    const auto second = test::value_or_throw(open_listeners("", 0));
    EXPECT_NE(first.port, second.port);
    const auto taken = open_listeners("", first.port);
    ASSERT_FALSE(taken);
    EXPECT_NE(taken.error().message.find(":" + std::to_string(first.port)), std::string::npos) << taken.error().message;
    EXPECT_NE(taken.error().message.find("give --serve another number, or 0 for any free port"), std::string::npos)
        << taken.error().message;
}

TEST(PageListeners, APortTakenOnTheSecondLoopbackAddressIsRefused) {
    Endpoint at{"::1", 0};
    const auto other = open_listening_socket(at);
    if (!other) GTEST_SKIP() << "this machine has no IPv6";
    const auto taken = open_listeners("", at.port);
    ASSERT_FALSE(taken) << "localhost would lead some browsers to the other program";
    EXPECT_NE(taken.error().message.find("[::1]"), std::string::npos) << taken.error().message;
}

TEST(PageListeners, AnAddressOfAnotherMachineIsRefused) {
    const auto refused = open_listeners("203.0.113.1", 0);  // reserved for documentation
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("give --bind an address of this machine"), std::string::npos) << refused.error().message;
}

TEST(RateLimit, AllowsABurstThenTheRate) {
    RateLimit limit(10, 3);
    std::int64_t now = 1'000'000'000;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(limit.take(now), 0) << k;
    EXPECT_EQ(limit.take(now), 100'000'000);
    now += 200'000'000;
    EXPECT_EQ(limit.take(now), 0);
    EXPECT_GT(limit.take(now), 0);
    now += 3'600'000'000'000;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(limit.take(now), 0) << "a pause allows a burst, not more: " << k;
    EXPECT_GT(limit.take(now), 0);
}

}  // namespace
}  // namespace corpuscle
