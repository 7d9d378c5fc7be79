// The page server: listens, answers HTTP requests, and sends frames to the pages.

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <thread>

#include <boost/beast/http/span_body.hpp>

#include "core/text/ascii_text.hpp"
#include "live/serve/beast_server.hpp"

namespace corpuscle {
namespace serve {

PageServerCounts SharedCounts::read() const {
    return {requests,      refused,     connections, turned_away, disconnected, messages,
            lost_messages, lost_frames, lost_spikes, viewers,     max_viewers};
}

namespace {

/// Allows the page to run its own script and style, which are in its text, and to connect to this server only. Some browsers do not count a
/// WebSocket as 'self', so that `host` is named, too; it is the text of a client.
std::string content_policy(std::string_view host) {
    std::string out =
        "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; style-src 'unsafe-inline'; "
        "img-src data: blob:; font-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; connect-src 'self'";
    const bool is_plain = std::all_of(host.begin(), host.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || std::string_view(".:-[]").find(static_cast<char>(c)) != std::string_view::npos;
    });
    if (is_plain && !host.empty()) out += fmt::format(" ws://{}", host);
    return out;
}

/// A connection until its request has been answered, or has become a WebSocket.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
    beast::tcp_stream stream_;
    ServerState& server_;
    beast::flat_buffer in_{2 * max_header};
    http::request_parser<http::empty_body> parser_;
    std::string refusal_;  // its text, while it is sent
    std::array<char, 4096> rest_ = {};
    std::size_t rest_bytes_ = 0;

    void handle(error_code error) {
        if (error == http::error::header_limit || error == http::error::buffer_overflow)
            return refuse({431, "The headers of a request have at most " + std::to_string(max_header) + " bytes."});
        if (error == http::error::body_limit) return refuse({413, "A request has no body."});
        const error_code http_error = http::error::bad_method;
        if (error && error != http::error::end_of_stream && error != http::error::partial_message &&
            error.category() == http_error.category())
            return refuse({400, "This is not an HTTP request."});
        if (error) return;  // the client has disconnected, or was too slow
        auto decision = server_.policy.decide(read_request());
        if (decision.status == 101 && server_.pages.size() >= server_.options.max_viewers + max_unfinished)
            decision = {503, "Too many pages are connected."};
        if (decision.status == 101) return count(decision), open_web_socket(std::move(stream_), parser_.release(), server_);
        if (decision.status == 200) return count(decision), send_page();
        refuse(decision);
    }

    PageRequest read_request() const {
        const auto& fields = parser_.get();
        PageRequest out{plain(fields.method_string()), plain(fields.target()), {}, {}, websocket::is_upgrade(fields)};
        for (const auto& field : fields) {
            if (field.name() == http::field::host) out.hosts.push_back(plain(field.value()));
            if (field.name() == http::field::origin) out.origins.push_back(plain(field.value()));
        }
        return out;
    }

    void count(const AccessDecision& decision) {
        ++server_.counts.requests;
        if (decision.status >= 400) ++server_.counts.refused;
    }

    using Response = http::response<http::span_body<const char>>;

    static Response response_of(http::status status, std::string_view type, std::string_view body) {
        Response out(status, 11);
        out.set(http::field::content_type, std::string(type) + "; charset=utf-8");
        out.body() = {body.data(), body.size()};
        out.prepare_payload();
        return out;
    }

    void send(Response response) {
        response.set(http::field::connection, "close");
        response.set(http::field::cache_control, "no-store");
        response.set("X-Content-Type-Options", "nosniff");
        response.set("X-Frame-Options", "DENY");
        const auto host = parser_.get()[http::field::host];
        response.set("Content-Security-Policy", content_policy(plain(host)));
        response.set("Cross-Origin-Opener-Policy", "same-origin");
        response.set("Cross-Origin-Resource-Policy", "same-origin");
        response.set("Referrer-Policy", "no-referrer");
        const auto kept = std::make_shared<Response>(std::move(response));
        stream_.expires_after(response_timeout);
        http::async_write(stream_, *kept, [self = shared_from_this(), kept](error_code error, std::size_t) {
            if (!error || error == http::error::end_of_stream) self->linger();
        });
    }

    void send_page() {
        auto response = response_of(http::status::ok, "text/html", server_.options.page);
        if (parser_.get().method() == http::verb::head) response.body() = {};  // the header gives the length of the page
        send(std::move(response));
    }

    void refuse(const AccessDecision& decision) {
        count(decision);
        if (parser_.get().method() != http::verb::head) refusal_ = decision.reason + "\n";
        auto response = response_of(http::int_to_status(decision.status), "text/plain", refusal_);
        if (decision.status == 405) response.set(http::field::allow, "GET, HEAD");
        send(std::move(response));
    }

    /// Reads what the client still sends, for a short time: if the connection were closed at once, the system would discard the response.
    void linger() {
        error_code ignored;
        if (rest_bytes_ == 0) stream_.socket().shutdown(tcp::socket::shutdown_send, ignored), stream_.expires_after(seconds(1));
        stream_.async_read_some(net::buffer(rest_), [self = shared_from_this()](error_code error, std::size_t bytes) {
            self->rest_bytes_ += bytes;
            if (!error && self->rest_bytes_ < (std::size_t{1} << 16)) self->linger();
        });
    }

public:
    HttpConnection(tcp::socket&& socket, ServerState& server) : stream_(std::move(socket)), server_(server) {
        parser_.header_limit(max_header);
        parser_.body_limit(std::uint64_t{0});
    }
    void read() {
        stream_.expires_after(request_timeout);
        http::async_read_header(stream_, in_, parser_, [self = shared_from_this()](error_code error, std::size_t) { self->handle(error); });
    }
    void close() { stream_.close(); }
};

/// Runs in a thread of its own, which the signals of the program do not reach. Its priority is below that of the stream.
template <class Work>
std::thread start_thread(Work work) {
    sigset_t all, before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    std::thread thread([work] {
        ::setpriority(PRIO_PROCESS, 0, 10);  // on Linux, of this thread only
        work();
    });
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return thread;
}

class BeastServer final : public PageServer {
    net::io_context io_{1};
    std::unique_ptr<net::thread_pool> workers_;
    ServerState state_;
    std::vector<std::string> urls_;
    int port_;
    std::vector<tcp::acceptor> acceptors_;
    RateLimit accepts_{200, 400};
    std::list<std::weak_ptr<HttpConnection>> unfinished_;
    net::steady_timer tick_{io_}, stop_timer_{io_};
    std::int64_t last_sweep_ = 0;
    FrameBatch batch_;
    std::thread thread_;

    void accept(std::size_t k) {
        acceptors_[k].async_accept([this, k](error_code error, tcp::socket socket) {
            if (error == net::error::operation_aborted || state_.is_stopping) return;
            if (!error) begin(std::move(socket));
            auto wait = accepts_.take(now_ns());
            if (error) wait = std::max(wait, in_ns(milliseconds(100)));  // no descriptors are left
            if (wait == 0) return accept(k);
            const auto timer = std::make_shared<net::steady_timer>(io_, std::chrono::nanoseconds(wait));
            timer->async_wait([this, k, timer](error_code) {
                if (!state_.is_stopping) accept(k);
            });
        });
    }

    void begin(tcp::socket socket) {
        error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        socket.set_option(net::socket_base::send_buffer_size(socket_buffer), ignored);
        unfinished_.remove_if([](const auto& c) { return c.expired(); });
        if (unfinished_.size() >= max_unfinished) {
            if (const auto oldest = unfinished_.front().lock()) oldest->close();
            unfinished_.pop_front();
        }
        const auto connection = std::make_shared<HttpConnection>(std::move(socket), state_);
        unfinished_.push_back(connection);
        connection->read();
    }

    /// Sends the frames that have arrived to all pages.
    void send_frames() {
        if (!state_.options.frames) return;
        constexpr int max_batches = 4;  // so that a full ring does not delay new connections
        for (int k = 0; k < max_batches && state_.options.frames->take(batch_); ++k) {
            state_.counts.lost_frames += batch_.lost_frames, state_.counts.lost_spikes += batch_.lost_spikes;
            const auto message = std::make_shared<const std::vector<std::byte>>(state_.options.encode_frames(batch_));
            for (const auto& page : copy_of_pages()) page->send(message, static_cast<std::int64_t>(batch_.spikes.size()));
        }
    }

    /// A copy, because a page that is disconnected leaves the list.
    std::vector<std::shared_ptr<PageConnection>> copy_of_pages() const { return {state_.pages.begin(), state_.pages.end()}; }

    void tick() {
        send_frames();
        if (const auto now = now_ns(); now - last_sweep_ >= in_ns(sweep_interval)) {
            last_sweep_ = now;
            for (const auto& page : copy_of_pages()) page->check(now);
        }
        if (state_.is_stopping && state_.pages.empty()) return io_.stop();
        const bool is_busy = state_.is_stopping || (state_.options.frames && state_.viewers > 0);
        tick_.expires_after(is_busy ? milliseconds(frame_interval) : milliseconds(200));
        tick_.async_wait([this](error_code error) {
            if (!error) tick();
        });
    }

    void begin_stop(std::vector<std::byte> last_message) {
        send_frames();
        state_.is_stopping = true;
        for (auto& acceptor : acceptors_) acceptor.close();
        const auto message = std::make_shared<const std::vector<std::byte>>(std::move(last_message));
        for (const auto& page : copy_of_pages()) {
            if (!message->empty()) page->send(message);
            page->close(websocket::close_code::going_away, "the stream has ended");
        }
        tick_.cancel();
        tick();
    }

public:
    BeastServer(PageServerOptions options, AccessPolicy policy, Listeners listeners, const std::string& token)
        : workers_(options.make_session ? std::make_unique<net::thread_pool>(options.session_threads) : nullptr),
          state_{std::move(options), std::move(policy), io_, workers_.get()}, urls_(std::move(listeners.urls)), port_(listeners.port) {
        if (!token.empty())
            for (auto& url : urls_) url += "?token=" + token;
        for (auto& socket : listeners.sockets) {
            sockaddr_storage address = {};
            socklen_t size = sizeof address;
            ::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &size);
            acceptors_.emplace_back(io_, address.ss_family == AF_INET6 ? tcp::v6() : tcp::v4(), socket.release());
        }
        for (std::size_t k = 0; k < acceptors_.size(); ++k) accept(k);
        net::post(io_, [this] { tick(); });
        thread_ = start_thread([this] { io_.run(); });
    }
    ~BeastServer() override { finish({}, milliseconds(0)); }

    std::vector<std::string> urls() const override { return urls_; }
    int port() const override { return port_; }
    PageServerCounts counts() const override { return state_.counts.read(); }

    void finish(std::vector<std::byte> last_message, milliseconds patience) override {
        if (!thread_.joinable()) return;
        net::post(io_, [this, &last_message, patience] {
            begin_stop(std::move(last_message));
            stop_timer_.expires_after(patience);
            stop_timer_.async_wait([this](error_code) {
                for (const auto& page : copy_of_pages()) page->stop_session();
                io_.stop();
            });
        });
        thread_.join();
        if (workers_) workers_->stop(), workers_->join();
    }
};

}  // namespace
}  // namespace serve

Result<std::unique_ptr<PageServer>> PageServer::start(PageServerOptions options) {
    const bool is_local = options.address.empty() || is_loopback_address(options.address);
    if (equal_ignoring_case(options.address, "localhost")) options.address = "";
    std::string token;
    if (!is_local) token = TRY(make_access_token());
    auto listeners = TRY(open_listeners(options.address, options.port));
    AccessPolicy policy(options.address, listeners.port, token, listeners.urls[0], options.make_session ? "/engine" : "/stream");
    return std::unique_ptr<PageServer>(
        std::make_unique<serve::BeastServer>(std::move(options), std::move(policy), std::move(listeners), token));
}

}  // namespace corpuscle
