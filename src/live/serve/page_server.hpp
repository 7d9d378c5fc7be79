#pragma once
// A web server inside a stream: it sends one page, and opens a WebSocket to it. The page then sees the frames of the stream, or has a
// session of the native engine. The server has a thread of its own. Its memory is bounded for any behaviour of its clients.

#include <atomic>
#include <chrono>

#include "live/serve/frame_ring.hpp"
#include "live/serve/page_session.hpp"

namespace corpuscle {

/// A message of the server about itself. The message format is that of the page, so a function of PageServerOptions encodes it.
struct ServerNotice {
    std::string error = {};          ///< why the connection ends; "": it does not
    std::int64_t lost_messages = 0;  ///< messages that were not sent to this page, because it or the network is slow
    std::int64_t lost_spikes = 0;    ///< spikes in them
};

struct PageServerOptions {
    std::string address = {};              ///< local address; "": 127.0.0.1 and ::1
    int port = 0;                          ///< 0: any free one
    std::size_t max_viewers = 256;         ///< number of pages that may be connected
    std::string_view page = {};            ///< the page, HTML; must outlive the server
    std::vector<std::byte> greeting = {};  ///< the first message to each page; empty: none
    std::function<std::vector<std::byte>(const ServerNotice&)> encode_notice;

    // To show a stream:
    FrameRing* frames = nullptr;  ///< null: no stream; must outlive the server
    std::function<std::vector<std::byte>(const FrameBatch&)> encode_frames = {};

    // To serve sessions of the engine:
    PageSessionFactory make_session = {};             ///< empty: no sessions
    unsigned session_threads = 1;                     ///< number of threads that answer requests
    std::size_t max_request = std::size_t{64} << 10;  ///< bytes of a message of the page
    double max_request_rate = 20;                     ///< Hz, messages of one page; with sessions, faster ones have to wait
};

/// Statistics of a server since its start.
struct PageServerCounts {
    std::int64_t requests = 0;       ///< HTTP requests, also refused ones
    std::int64_t refused = 0;        ///< of these: refused
    std::int64_t connections = 0;    ///< pages that were connected
    std::int64_t turned_away = 0;    ///< pages that were not, because of PageServerOptions::max_viewers
    std::int64_t disconnected = 0;   ///< pages that the server has disconnected: silent, stuck, too many requests, invalid messages
    std::int64_t messages = 0;       ///< messages sent, counted for each page
    std::int64_t lost_messages = 0;  ///< messages not sent, because a page or the network is slow
    std::int64_t lost_frames = 0;    ///< frames that no page has seen, because the server is slow
    std::int64_t lost_spikes = 0;    ///< spikes that no page has seen, because the server is slow
    std::int64_t viewers = 0;        ///< pages that are connected now
    std::int64_t max_viewers = 0;    ///< highest number of pages that were connected at once
};

class PageServer {
public:
    virtual ~PageServer() = default;
    /// Listens and starts the thread. Returns an error if the address cannot be used, or if the program was built without Boost.
    static Result<std::unique_ptr<PageServer>> start(PageServerOptions);

    /// The addresses of the page, the best first; with the token, if one is required.
    virtual std::vector<std::string> urls() const = 0;
    virtual int port() const = 0;
    /// Sends what is left in the ring and a last message, closes all connections, and waits at most `patience` for the pages.
    virtual void finish(std::vector<std::byte> last_message, std::chrono::milliseconds patience) = 0;
    virtual PageServerCounts counts() const = 0;
};

}  // namespace corpuscle
