#pragma once
// The parts of the page server that know Boost.Beast: included by the two files that implement it, because its headers take seconds to
// compile. All functions run in the server's thread, unless they say otherwise.

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <deque>
#include <list>
#include <unordered_set>

#include "live/serve/access.hpp"
#include "live/serve/listeners.hpp"
#include "live/serve/page_server.hpp"
#include "live/serve/rate_limit.hpp"

namespace corpuscle::serve {

namespace beast = boost::beast;
namespace http = beast::http;
namespace net = boost::asio;
namespace websocket = beast::websocket;
using tcp = net::ip::tcp;
using beast::error_code;
using std::chrono::milliseconds;
using std::chrono::seconds;

using HttpRequest = http::request<http::empty_body>;
using Message = std::shared_ptr<const std::vector<std::byte>>;

inline constexpr auto request_timeout = seconds(5);         // from the connection to the end of the request's headers
inline constexpr auto response_timeout = seconds(30);       // for sending the page
inline constexpr std::uint32_t max_header = 8192;           // bytes of a request's headers
inline constexpr std::size_t max_unfinished = 256;          // connections without a WebSocket; a further one replaces the oldest
inline constexpr auto ping_after = seconds(15);             // of silence of a page; it is disconnected after twice this time
inline constexpr auto write_timeout = seconds(20);          // for one message to a page
inline constexpr auto closing_timeout = seconds(3);         // for the page's reply to a close frame
inline constexpr std::size_t max_queue = 8;                 // messages that wait for one page
inline constexpr int socket_buffer = 256 << 10;             // bytes that the system buffers for one page
inline constexpr auto frame_interval = milliseconds(16);    // between messages with frames
inline constexpr auto sweep_interval = milliseconds(1000);  // between checks of silent and stuck pages

inline std::int64_t now_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
inline constexpr std::int64_t in_ns(std::chrono::nanoseconds time) { return time.count(); }

inline std::string_view plain(beast::string_view text) { return {text.data(), text.size()}; }

/// Counters that other threads read.
struct SharedCounts {
    std::atomic<std::int64_t> requests = 0, refused = 0, connections = 0, turned_away = 0, disconnected = 0, messages = 0,
                              lost_messages = 0, lost_frames = 0, lost_spikes = 0, viewers = 0, max_viewers = 0;
    PageServerCounts read() const;
};

class PageConnection;

/// State that all connections share.
struct ServerState {
    PageServerOptions options;
    AccessPolicy policy;
    net::io_context& io;
    net::thread_pool* workers = nullptr;  // null: no sessions
    SharedCounts counts = {};
    std::unordered_set<std::shared_ptr<PageConnection>> pages = {};  // open WebSockets, also those that are being closed
    std::size_t viewers = 0;                                         // of these: counted against max_viewers
    bool is_stopping = false;

    void add(const std::shared_ptr<PageConnection>&);
    void remove(const std::shared_ptr<PageConnection>&);
    void set_viewers(std::size_t);
};

/// The WebSocket of one page.
class PageConnection : public std::enable_shared_from_this<PageConnection> {
    struct Outgoing {
        Message message;
        std::int64_t spikes;
    };
    websocket::stream<beast::tcp_stream, false> socket_;  // false: no compression, which could expand without limit
    ServerState& server_;
    beast::flat_buffer in_;
    std::deque<Outgoing> queue_;                                                 // the first is being written
    std::int64_t lost_messages_ = 0, lost_spikes_ = 0;                           // since the last notice
    std::int64_t last_received_ = now_ns(), write_begin_ = 0, close_begin_ = 0;  // ns; 0: no write, not closing
    bool is_ping_sent_ = false, is_viewer_ = false;
    bool is_computing_ = false, is_answering_ = false;  // the page is not read
    RateLimit requests_, control_frames_{20, 40};
    websocket::close_reason close_reason_;
    std::shared_ptr<PageSession> session_;
    net::steady_timer delay_;

    void begin(bool is_full);
    void read();
    void handle_message();
    void compute();
    void answer(Result<std::vector<std::byte>>);
    void queue(Message, std::int64_t spikes);
    void write();
    void send_close();
    void drop();

public:
    PageConnection(beast::tcp_stream&&, ServerState&);
    void accept(HttpRequest);
    /// Sends a message, or counts it as lost if too many wait already.
    void send(const Message&, std::int64_t spikes = 0);
    /// Sends a close frame after the messages that wait.
    void close(websocket::close_code, std::string_view reason);
    void disconnect(websocket::close_code code, std::string_view reason) { ++server_.counts.disconnected, close(code, reason); }
    /// Ends the request that a session computes.
    void stop_session() {
        if (session_) session_->stop();
    }
    /// Disconnects the page if it is silent or stuck; called once a second.
    void check(std::int64_t now);
    bool is_viewer() const { return is_viewer_; }
};

/// Opens the WebSocket of a request that the policy has accepted.
void open_web_socket(beast::tcp_stream&&, HttpRequest, ServerState&);

}  // namespace corpuscle::serve
