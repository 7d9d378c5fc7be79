// The page server with real sockets: HTTP, WebSockets, and clients that break the rules.

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "live/serve/page_server.hpp"
#include "page/message.hpp"
#include "page_client.hpp"

namespace corpuscle {
namespace {

constexpr std::string_view test_page = "<!DOCTYPE html><title>test</title>";

std::vector<std::byte> message_of(page::Json head) {
    page::MessageWriter out;
    out.head = std::move(head);
    return out.finish();
}

PageServerOptions server_options() {
    PageServerOptions options;
    options.page = test_page;
    options.greeting = message_of({{"event", "hello"}});
    options.encode_notice = [](const ServerNotice& n) {
        return n.error.empty() ? message_of({{"event", "lost"}, {"messages", n.lost_messages}, {"spikes", n.lost_spikes}})
                               : message_of({{"event", "refused"}, {"error", n.error}});
    };
    options.encode_frames = [](const FrameBatch& batch) {
        auto out = message_of({{"event", "frames"}, {"spikes", batch.spikes.size()}});
        out.resize(out.size() + batch.force.size() * 4);
        return out;
    };
    return options;
}

/// Starts a server; null, if this build has none.
std::unique_ptr<PageServer> start(PageServerOptions options) {
    auto server = PageServer::start(std::move(options));
    if (!server && server.error().message.find("libboost-dev") != std::string::npos) return nullptr;
    return test::value_or_throw(std::move(server));
}

constexpr const char* no_server = "this build has no page server (libboost-dev)";

constexpr std::size_t large_answer = std::size_t{1} << 20;  // bytes

/// A session that answers each request with its number and its text; "fail" ends it, "large" has a large answer, and "wait" waits until the
/// session is stopped.
class EchoSession final : public PageSession {
    int count_ = 0;
    std::mutex mutex_;
    std::condition_variable stopped_;
    bool is_stopped_ = false;

public:
    static inline std::atomic<int> large_answers = 0;

    Result<std::vector<std::byte>> request(std::span<const std::byte> bytes) override {
        const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        if (text == "fail") return bad_input("the test wants it to fail");
        if (text == "wait") {
            std::unique_lock lock(mutex_);
            stopped_.wait(lock, [this] { return is_stopped_; });
        }
        auto answer = message_of({{"number", ++count_}, {"text", text}});
        if (text == "large") ++large_answers, answer.resize(large_answer);
        return answer;
    }
    void stop() override {
        const std::lock_guard lock(mutex_);
        is_stopped_ = true;
        stopped_.notify_all();
    }
};

PageServerOptions session_options() {
    auto options = server_options();
    options.make_session = [] { return std::make_unique<EchoSession>(); };
    options.max_request_rate = 1000;
    return options;
}

TEST(PageServer, SendsItsPageAndNothingElse) {
    const auto server = start(server_options());
    if (!server) GTEST_SKIP() << no_server;
    const int port = server->port();
    const auto page = PageClient(port).get("/");
    EXPECT_TRUE(page.starts_with("HTTP/1.1 200 OK\r\n")) << page;
    EXPECT_TRUE(page.ends_with(std::string("\r\n\r\n") + std::string(test_page))) << page;
    for (const char* header : {"Content-Security-Policy: default-src 'none';", "X-Content-Type-Options: nosniff", "Cache-Control: no-store",
                               "Referrer-Policy: no-referrer", "frame-ancestors 'none'", "Content-Type: text/html"})
        EXPECT_NE(page.find(header), page.npos) << header;
    const auto head = PageClient(port).get("/", "", "HEAD");
    EXPECT_TRUE(head.starts_with("HTTP/1.1 200 OK\r\n") && head.ends_with("\r\n\r\n")) << head;
    EXPECT_NE(head.find("Content-Length: " + std::to_string(test_page.size())), head.npos) << head;
    EXPECT_EQ(server->counts().refused, 0);
    for (const char* target : {"/x", "/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc/passwd", "/.git/config"})
        EXPECT_TRUE(PageClient(port).get(target).starts_with("HTTP/1.1 404 ")) << target;
    EXPECT_TRUE(PageClient(port).get("/", "", "POST").starts_with("HTTP/1.1 405 "));
    EXPECT_TRUE(PageClient(port).request("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n").starts_with("HTTP/1.1 421 "));
    EXPECT_TRUE(PageClient(port).request("GET / HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 400 "));
    EXPECT_TRUE(PageClient(port).get("/", "Host: evil.example\r\n").starts_with("HTTP/1.1 400 ")) << "two Host headers";
    EXPECT_EQ(server->counts().refused, 9);
}

TEST(PageServer, RefusesRequestsThatAreTooLongOrNotHttp) {
    const auto server = start(server_options());
    if (!server) GTEST_SKIP() << no_server;
    const int port = server->port();
    EXPECT_TRUE(PageClient(port).get("/", "X: " + std::string(9000, 'x') + "\r\n").starts_with("HTTP/1.1 431 "));
    EXPECT_TRUE(PageClient(port).get("/?" + std::string(9000, 'x')).starts_with("HTTP/1.1 431 "));
    EXPECT_TRUE(PageClient(port).get("/", "X: " + std::string(1000000, 'x') + "\r\n").starts_with("HTTP/1.1 431 "));
    std::string many;
    for (int k = 0; k < 1000; ++k) many += "X-" + std::to_string(k) + ": y\r\n";
    EXPECT_TRUE(PageClient(port).get("/", many).starts_with("HTTP/1.1 431 "));
    EXPECT_TRUE(PageClient(port).get("/", "Content-Length: 1000000000\r\n").starts_with("HTTP/1.1 413 "));
    for (const std::string text :
         {"rubbish\r\n\r\n", "\x16\x03\x01\x02\r\n\r\n", "GET /\r\n\r\n", "GET / HTTP/9.9\r\n\r\n", "\r\n\r\n\r\n\r\n"}) {
        const auto response = PageClient(port).request(text);
        EXPECT_TRUE(response.empty() || response.starts_with("HTTP/1.1 400 ")) << text << response;
    }
    EXPECT_TRUE(PageClient(port).get("/").starts_with("HTTP/1.1 200 ")) << "the server goes on";
}

TEST(PageServer, IsReachedOverIPv6) {
    const auto server = start(server_options());
    if (!server) GTEST_SKIP() << no_server;
    if (!connect_socket(*resolve({"::1", server->port()}), 1000)) GTEST_SKIP() << "this machine has no IPv6";
    const auto page = PageClient(server->port(), "::1").request(fmt::format("GET / HTTP/1.1\r\nHost: [::1]:{}\r\n\r\n", server->port()));
    EXPECT_TRUE(page.starts_with("HTTP/1.1 200 OK\r\n")) << page;
}

TEST(PageServer, OpensWebSocketsForItsOwnPagesOnly) {
    const auto server = start(server_options());
    if (!server) GTEST_SKIP() << no_server;
    PageClient other(server->port()), own(server->port());
    EXPECT_EQ(other.open("Origin: http://evil.example\r\n"), 403);
    EXPECT_EQ(own.open("Origin: http://" + own.host() + "\r\n"), 101);
    EXPECT_EQ(head_of(own.next()->data)["event"], "hello");
    EXPECT_EQ(PageClient(server->port()).open("", "/"), 404);
}

TEST(PageServer, SendsFramesToAllPagesAndALastMessage) {
    FrameRing ring(4, 1000);
    auto options = server_options();
    options.frames = &ring;
    const auto server = start(std::move(options));
    if (!server) GTEST_SKIP() << no_server;
    PageClient first(server->port()), second(server->port());
    ASSERT_EQ(first.open(), 101);
    ASSERT_EQ(second.open(), 101);
    for (auto* page : {&first, &second}) EXPECT_EQ(head_of(page->next()->data)["event"], "hello");
    const double force[] = {0, 1, 0, 0};
    const Spike spikes[] = {{3, 0.5, 1}, {3, 0.75, 2}};
    ring.add_frame(3, force), ring.add_spikes(spikes);
    for (auto* page : {&first, &second}) {
        const auto head = head_of(page->next()->data);
        EXPECT_EQ(head["event"], "frames") << head;
        EXPECT_EQ(head["spikes"], 2) << head;
    }
    std::thread ending([&] { server->finish(message_of({{"event", "end"}}), std::chrono::seconds(10)); });
    for (auto* page : {&first, &second}) {
        EXPECT_EQ(head_of(page->next()->data)["event"], "end");
        const auto close = page->next();
        ASSERT_TRUE(close);
        EXPECT_EQ(close->close_code(), 1001);
        page->send(client_frame(0x88, close->data));  // the reply; the server then ends without waiting
    }
    ending.join();
    EXPECT_EQ(server->counts().connections, 2);
    EXPECT_EQ(server->counts().max_viewers, 2);
    EXPECT_EQ(server->counts().viewers, 0);
}

TEST(PageServer, ReportsLostMessagesToTheSlowPage) {
    FrameRing ring(20000, 1000);
    auto options = server_options();
    options.frames = &ring;
    const auto server = start(std::move(options));
    if (!server) GTEST_SKIP() << no_server;
    PageClient slow(server->port(), "127.0.0.1", 65536);
    ASSERT_EQ(slow.open(), 101);
    EXPECT_EQ(head_of(slow.next()->data)["event"], "hello");
    const std::vector<double> force(20000, 1.0);
    const Spike spike = {0, 0.5, 0};
    std::int64_t frame = 0, put_spikes = 0;
    for (int k = 0; k < 5000 && server->counts().lost_messages < 3; ++k) {
        ring.add_spikes({&spike, 1}), ring.add_frame(frame, force);
        ++put_spikes, frame += ring.force_interval();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ASSERT_GE(server->counts().lost_messages, 3);
    std::int64_t seen = 0, lost = 0, lost_messages = 0;
    const auto put = [&] {
        ring.add_spikes({&spike, 1}), ring.add_frame(frame, force);
        ++put_spikes, frame += ring.force_interval();
    };
    put();
    for (auto message = slow.next(); message && message->opcode == 2; message = slow.next()) {
        const auto head = head_of(message->data);
        if (head["event"] == "frames") seen += head["spikes"].get<std::int64_t>();
        if (head["event"] == "lost") lost += head["spikes"].get<std::int64_t>(), lost_messages += head["messages"].get<std::int64_t>();
        if (head["event"] == "end") break;
        if (seen + lost == put_spikes && lost_messages > 0) break;
        if (seen > 0 && lost == 0) put();  // a later message carries the notice
    }
    EXPECT_GE(lost_messages, 3);
    EXPECT_GE(lost, 3);
    EXPECT_LE(seen + lost, put_spikes);
}

TEST(PageServer, RefusesAPageTooManyWithTheReason) {
    auto options = server_options();
    options.max_viewers = 2;
    const auto server = start(std::move(options));
    if (!server) GTEST_SKIP() << no_server;
    PageClient first(server->port()), third(server->port()), fourth(server->port());
    auto second = std::make_unique<PageClient>(server->port());
    EXPECT_EQ(first.open(), 101);
    EXPECT_EQ(second->open(), 101);
    EXPECT_EQ(third.open(), 101);
    const auto notice = head_of(third.next()->data);
    EXPECT_EQ(notice["event"], "refused");
    EXPECT_NE(notice["error"].get<std::string>().find("--max-viewers 2"), std::string::npos) << notice;
    EXPECT_EQ(third.close_code(), 1013);
    second.reset();
    for (int k = 0; k < 1000 && server->counts().viewers == 2; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(fourth.open(), 101);
    EXPECT_EQ(head_of(fourth.next()->data)["event"], "hello") << "one has left";
    EXPECT_EQ(server->counts().turned_away, 1);
}

TEST(PageServer, DisconnectsPagesThatBreakTheProtocol) {
    struct Violation {
        std::string bytes;
        int code;
        const char* description;
    };
    std::string gigabyte("\x82\xff\0\0\0\0\x40\0\0\0mask", 14);
    const Violation violations[] = {
        {client_frame(0x81, "{}"), 1003, "a text message"},
        {gigabyte, 1009, "a length of a gigabyte"},
        {client_frame(0x82, std::string(70000, 'x')), 1009, "a message above the limit"},
        {client_frame(0x02, std::string(60000, 'x')) + client_frame(0x80, std::string(10000, 'x')), 1009, "fragments above the limit"},
        {std::string("\x82\xff\0\0\0\0\0\0\0\x01mask"
                     "x",
                     15),
         1002, "a length in more bytes than it needs"},
        {client_frame(0xc2, "x"), 1002, "a compressed message"},
        {client_frame(0x82, "x", false), 1002, "a message without a mask"},
        {client_frame(0x80, "x"), 1002, "a continuation of nothing"},
        {client_frame(0x83, "x"), 1002, "an unknown opcode"},
        {client_frame(0x09, "x"), 1002, "a ping in fragments"},
        {client_frame(0x89, std::string(126, 'x')), 1002, "a ping that is too long"}};
    const auto server = start(server_options());
    if (!server) GTEST_SKIP() << no_server;
    for (const auto& v : violations) {
        PageClient page(server->port());
        ASSERT_EQ(page.open(), 101) << v.description;
        page.send(v.bytes);
        const auto code = page.close_code();
        EXPECT_EQ(code, v.code) << v.description;
    }
    const auto all = static_cast<std::int64_t>(std::size(violations));
    for (int k = 0; k < 1000 && server->counts().disconnected < all; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(server->counts().disconnected, all);
    PageClient page(server->port());
    ASSERT_EQ(page.open(), 101);
    page.next();
    page.send(client_frame(0x89, "are you there"));
    const auto pong = page.next();
    ASSERT_TRUE(pong);
    EXPECT_EQ(pong->opcode, 10);
    EXPECT_EQ(pong->data, "are you there");
}

TEST(PageServer, DisconnectsPagesThatFlood) {
    const auto server = start(server_options());
    if (!server) GTEST_SKIP() << no_server;
    PageClient messages(server->port()), pings(server->port());
    ASSERT_EQ(messages.open(), 101);
    ASSERT_EQ(pings.open(), 101);
    for (int k = 0; k < 200; ++k) messages.send(client_frame(0x82, "x")), pings.send(client_frame(0x89, "x"));
    EXPECT_EQ(messages.close_code(), 1008);
    EXPECT_EQ(pings.close_code(), 1008);
}

TEST(PageServer, AnswersTheRequestsOfEachSessionInOrder) {
    const auto server = start(session_options());
    if (!server) GTEST_SKIP() << no_server;
    PageClient first(server->port()), second(server->port());
    ASSERT_EQ(first.open("", "/engine"), 101);
    ASSERT_EQ(second.open("", "/engine"), 101);
    for (auto* page : {&first, &second}) EXPECT_EQ(head_of(page->next()->data)["event"], "hello");
    for (int k = 1; k <= 50; ++k) first.send(client_frame(0x82, "a" + std::to_string(k)));
    second.send(client_frame(0x02, "in ") + client_frame(0x89, "") + client_frame(0x00, "three ") + client_frame(0x80, "fragments"));
    for (int k = 1; k <= 50; ++k) {
        const auto head = head_of(first.next()->data);
        EXPECT_EQ(head["number"], k);
        EXPECT_EQ(head["text"], "a" + std::to_string(k));
    }
    auto answer = second.next();
    if (answer && answer->opcode == 10) answer = second.next();
    ASSERT_TRUE(answer);
    EXPECT_EQ(head_of(answer->data)["text"], "in three fragments");
    EXPECT_EQ(head_of(answer->data)["number"], 1) << "a session of its own";
    second.send(client_frame(0x82, "fail"));
    EXPECT_EQ(second.close_code(), 1011);
    first.send(client_frame(0x82, "again"));
    EXPECT_EQ(head_of(first.next()->data)["number"], 51) << "the error of one session does not touch another";
}

TEST(PageServer, EndsWhileASessionComputes) {
    auto server = start(session_options());
    if (!server) GTEST_SKIP() << no_server;
    PageClient page(server->port());
    ASSERT_EQ(page.open("", "/engine"), 101);
    page.next();
    page.send(client_frame(0x82, "wait"));
    std::thread ending([&] { server->finish({}, std::chrono::milliseconds(50)); });
    EXPECT_EQ(page.close_code(), 1001);
    ending.join();  // after the session was stopped
    server.reset();
}

TEST(PageServer, ComputesNothingForAPageThatLeavesItsAnswers) {
    const auto server = start(session_options());
    if (!server) GTEST_SKIP() << no_server;
    PageClient page(server->port(), "127.0.0.1", 65536);
    ASSERT_EQ(page.open("", "/engine"), 101);
    page.next();
    constexpr int requests = 40;
    for (int k = 0; k < requests; ++k) page.send(client_frame(0x82, "large"));
    const int before = EchoSession::large_answers;
    int answers = -1;
    for (int k = 0; k < 100 && answers != EchoSession::large_answers; ++k) {
        answers = EchoSession::large_answers;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    EXPECT_LT(answers - before, 10) << "the system's buffers have room for a few";
    for (int k = 1; k <= requests; ++k) {
        const auto answer = page.next();
        ASSERT_TRUE(answer);
        EXPECT_EQ(head_of(answer->data)["number"], k);
        EXPECT_EQ(answer->data.size(), large_answer);
    }
}

TEST(PageServer, AClientThatLeavesInTheMiddleHarmsNothing) {
    const auto server = start(session_options());
    if (!server) GTEST_SKIP() << no_server;
    for (int k = 0; k < 40; ++k) {
        PageClient page(server->port());
        if (k % 4 == 0) page.send("GET / HT");
        if (k % 4 == 1) page.open("", "/engine");
        if (k % 4 == 2) page.open("", "/engine"), page.send(client_frame(0x82, "x"));
        if (k % 4 == 3) page.open("", "/engine"), page.send(client_frame(0x82, "incomplete").substr(0, 9));
    }
    PageClient last(server->port());
    for (int k = 0; k < 1000 && server->counts().viewers > 0; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(server->counts().viewers, 0);
    ASSERT_EQ(last.open("", "/engine"), 101);
    EXPECT_EQ(head_of(last.next()->data)["event"], "hello");
}

TEST(PageServer, ElsewhereNeedsTheToken) {
    auto options = server_options();
    options.address = "0.0.0.0";
    const auto server = start(std::move(options));
    if (!server) GTEST_SKIP() << no_server;
    const auto url = server->urls()[0];
    ASSERT_NE(url.find("/?token="), url.npos) << url;
    const auto target = url.substr(url.find("/?token="));
    EXPECT_EQ(target.size(), 8U + 32U);
    const auto refused = PageClient(server->port()).get("/");
    EXPECT_TRUE(refused.starts_with("HTTP/1.1 401 ")) << refused;
    EXPECT_EQ(refused.find("<title>"), refused.npos) << refused;
    EXPECT_EQ(PageClient(server->port()).open(), 401);
    EXPECT_TRUE(PageClient(server->port()).get(target).starts_with("HTTP/1.1 200 "));
    EXPECT_EQ(PageClient(server->port()).open("", "/stream" + target.substr(1)), 101);
}

}  // namespace
}  // namespace corpuscle
