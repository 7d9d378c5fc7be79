// The WebSockets of the page server: messages to pages, and requests of pages to their sessions.

#include "live/serve/beast_server.hpp"

namespace corpuscle::serve {

void ServerState::set_viewers(std::size_t count) {
    viewers = count;
    const auto n = static_cast<std::int64_t>(count);
    counts.viewers = n;
    counts.max_viewers = std::max(counts.max_viewers.load(), n);
    if (options.frames) options.frames->set_watched(count > 0);
}

void ServerState::add(const std::shared_ptr<PageConnection>& page) {
    pages.insert(page);
    if (!page->is_viewer()) return;
    ++counts.connections;
    set_viewers(viewers + 1);
}

void ServerState::remove(const std::shared_ptr<PageConnection>& page) {
    if (pages.erase(page) > 0 && page->is_viewer()) set_viewers(viewers - 1);
}

PageConnection::PageConnection(beast::tcp_stream&& stream, ServerState& server)
    : socket_(std::move(stream)), server_(server), requests_(server.options.max_request_rate, 2 * server.options.max_request_rate),
      delay_(socket_.get_executor()) {}

void PageConnection::accept(HttpRequest request) {
    const bool is_full = server_.viewers >= server_.options.max_viewers;
    is_viewer_ = !is_full;
    server_.add(shared_from_this());
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout{request_timeout, websocket::stream_base::none(), false});
    socket_.read_message_max(server_.options.max_request);
    socket_.binary(true);
    socket_.auto_fragment(false);
    socket_.control_callback([this](websocket::frame_type, beast::string_view) {
        last_received_ = now_ns(), is_ping_sent_ = false;
        if (control_frames_.take(last_received_) > 0) disconnect(websocket::close_code::policy_error, "too many control frames");
    });
    const auto kept = std::make_shared<HttpRequest>(std::move(request));
    socket_.async_accept(*kept, [self = shared_from_this(), kept, is_full](error_code error) {
        if (error) return self->server_.remove(self);
        self->begin(is_full);
    });
}

/// Sends the first message, or says that the server has as many pages as it may have.
void PageConnection::begin(bool is_full) {
    last_received_ = now_ns();
    const auto& options = server_.options;
    read();
    if (is_full) {
        ++server_.counts.turned_away;
        const auto reason = "the server has as many pages as it may have (--max-viewers " + std::to_string(options.max_viewers) + ")";
        queue(std::make_shared<const std::vector<std::byte>>(options.encode_notice({reason})), 0);
        return close(websocket::close_code::try_again_later, reason);
    }
    if (options.make_session) session_ = options.make_session();
    if (!options.greeting.empty()) queue(std::make_shared<const std::vector<std::byte>>(options.greeting), 0);
}

void PageConnection::read() {
    socket_.async_read(in_, [self = shared_from_this()](error_code error, std::size_t) {
        if (!error) return self->handle_message();
        const error_code closed = websocket::error::closed;
        if (error != closed && error.category() == closed.category()) ++self->server_.counts.disconnected;  // a violation of the protocol
        self->drop();
    });
}

void PageConnection::handle_message() {
    last_received_ = now_ns(), is_ping_sent_ = false;
    if (close_begin_ != 0) return in_.clear(), read();  // until the close frame of the page
    if (!socket_.got_binary()) {
        disconnect(websocket::close_code::unknown_data, "text messages are not read; send binary ones");
        return in_.clear(), read();
    }
    const auto wait = requests_.take(last_received_);
    if (session_ && wait > 0) {
        is_computing_ = true;  // the page is not silent: it is not read
        delay_.expires_after(std::chrono::nanoseconds(wait));
        return delay_.async_wait([self = shared_from_this()](error_code error) {
            if (!error) self->compute();
        });
    }
    if (session_) return compute();
    if (wait > 0) disconnect(websocket::close_code::policy_error, "too many messages; this page shows a stream, and is asked nothing");
    in_.clear();
    read();
}

/// Answers the message in in_ in a thread of the pool. The next one is read when its answer has been sent, so that a page that does not
/// accept answers cannot ask for more.
void PageConnection::compute() {
    is_computing_ = true;
    net::post(*server_.workers, [self = shared_from_this()]() mutable {
        const auto data = self->in_.data();
        auto answer = self->session_->request({static_cast<const std::byte*>(data.data()), data.size()});
        auto& io = self->server_.io;
        // The connection goes along, so that it is never destroyed in this thread.
        net::post(io, [self = std::move(self), answer = std::move(answer)]() mutable { self->answer(std::move(answer)); });
    });
}

void PageConnection::answer(Result<std::vector<std::byte>> answer) {
    is_computing_ = false, last_received_ = now_ns();
    in_.clear();
    if (!answer) {
        disconnect(websocket::close_code::internal_error, answer.error().message);
        return read();
    }
    is_answering_ = true;
    queue(std::make_shared<const std::vector<std::byte>>(*std::move(answer)), 0);
}

void PageConnection::send(const Message& message, std::int64_t spikes) {
    if (close_begin_ != 0 || !is_viewer_ || !socket_.is_open()) return;
    if (queue_.size() >= max_queue) {
        ++lost_messages_, lost_spikes_ += spikes, ++server_.counts.lost_messages;
        return;
    }
    if (lost_messages_ > 0) {
        queue(std::make_shared<const std::vector<std::byte>>(server_.options.encode_notice({"", lost_messages_, lost_spikes_})), 0);
        lost_messages_ = lost_spikes_ = 0;
    }
    queue(message, spikes);
}

void PageConnection::queue(Message message, std::int64_t spikes) {
    queue_.push_back({std::move(message), spikes});
    if (queue_.size() == 1) write();
}

void PageConnection::write() {
    write_begin_ = now_ns();
    const auto& bytes = *queue_.front().message;
    socket_.async_write(net::buffer(bytes.data(), bytes.size()), [self = shared_from_this()](error_code error, std::size_t) {
        self->write_begin_ = 0;
        if (error) return self->drop();
        ++self->server_.counts.messages;
        self->queue_.pop_front();
        if (!self->queue_.empty()) return self->write();
        if (std::exchange(self->is_answering_, false)) self->last_received_ = now_ns(), self->read();
        if (self->close_begin_ != 0) self->send_close();
    });
}

void PageConnection::close(websocket::close_code code, std::string_view reason) {
    if (close_begin_ != 0) return;
    close_begin_ = now_ns();
    constexpr std::size_t max_reason = 120;  // bytes; a control frame has at most 125
    close_reason_ = websocket::close_reason(code, beast::string_view(reason.data(), std::min(reason.size(), max_reason)));
    if (queue_.empty()) send_close();
}

void PageConnection::send_close() {
    socket_.async_close(close_reason_, [self = shared_from_this()](error_code) { self->drop(); });
}

/// Closes the connection without waiting.
void PageConnection::drop() {
    beast::get_lowest_layer(socket_).close();
    delay_.cancel();
    stop_session();
    server_.remove(shared_from_this());
}

void PageConnection::check(std::int64_t now) {
    const bool is_closed_late = close_begin_ != 0 && now - close_begin_ > in_ns(closing_timeout);
    const bool is_stuck = write_begin_ != 0 && now - write_begin_ > in_ns(write_timeout);
    const bool is_silent = !is_computing_ && !is_answering_ && now - last_received_ > 2 * in_ns(ping_after);
    if (is_closed_late) return drop();
    if (is_stuck || is_silent) return ++server_.counts.disconnected, drop();
    if (is_computing_ || is_answering_ || is_ping_sent_ || close_begin_ != 0 || now - last_received_ < in_ns(ping_after) ||
        !socket_.is_open())
        return;
    is_ping_sent_ = true;
    socket_.async_ping({}, [self = shared_from_this()](error_code) {});
}

void open_web_socket(beast::tcp_stream&& stream, HttpRequest request, ServerState& server) {
    std::make_shared<PageConnection>(std::move(stream), server)->accept(std::move(request));
}

}  // namespace corpuscle::serve
