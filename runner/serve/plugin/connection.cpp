#include "serve/plugin/connection.hpp"

#include "serve/access.hpp"
#include "serve/request.hpp"

#include <chrono>
#include <utility>

namespace tidemark::serve {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

namespace {

constexpr std::chrono::seconds k_patience{10};
/// Limit for clients that have not shown the token yet.
constexpr std::chrono::seconds k_patience_with_strangers{1};
constexpr size_t k_longest_header = 16384;
/// Number of messages; a client that reads never has so many waiting.
constexpr size_t k_most_waiting = 256;
/// Two 4K pictures of the best quality take less.
constexpr size_t k_most_bytes_waiting = 64 << 20;
/// Bytes; RFC 6455 allows 123.
constexpr size_t k_longest_reason = 120;

std::string_view view_of(beast::string_view text) {
    return {text.data(), text.size()};
}

/// Keeps the page private: its address contains the token, and other sites must not embed or read it.
void shut_in(http::response<http::string_body>& response) {
    response.set(http::field::cache_control, "no-store");
    response.set("Content-Security-Policy",
                 "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; "
                 "img-src blob:; connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; "
                 "form-action 'none'");
    response.set("Referrer-Policy", "no-referrer");
    response.set("X-Content-Type-Options", "nosniff");
}

} // namespace

Connection::Connection(asio::ip::tcp::socket socket, ViewerId id, House& house)
    : socket_(std::move(socket)), id_(id), house_(house) {}

Connection::~Connection() {
    if (is_guest_)
        house_.guests().left(id_);
}

void Connection::start() {
    boost::system::error_code ignored;
    beast::get_lowest_layer(socket_).socket().set_option(asio::ip::tcp::no_delay(true), ignored);
    beast::get_lowest_layer(socket_).expires_after(k_patience_with_strangers);
    request_.emplace();
    request_->header_limit(k_longest_header);
    request_->body_limit(0);
    http::async_read(socket_.next_layer(), buffer_, *request_,
                     [self = shared_from_this()](Error error, size_t) {
                         if (!error)
                             self->answer();
                     });
}

void Connection::answer() {
    const auto& request = request_->get();
    if (request.method() != http::verb::get)
        return respond(http::status::method_not_allowed, "only GET is answered\n");
    const Knock knock{.target = view_of(request.target()),
                      .host = view_of(request[http::field::host]),
                      .origin = view_of(request[http::field::origin]),
                      .upgrade = websocket::is_upgrade(request),
                      .through_loopback = house_.is_loopback()};
    switch (answer_to(knock, house_.settings().token)) {
    case Answer::page: return respond(http::status::ok, house_.settings().page, "text/html; charset=utf-8");
    case Answer::socket: return accept();
    case Answer::not_found: return respond(http::status::not_found, "there is nothing here\n");
    case Answer::forbidden: break;
    }
    respond(http::status::forbidden,
            "not for you: open the whole address that `tidemark serve` printed, with its token\n");
}

void Connection::respond(http::status status, std::string text, const char* type) {
    beast::get_lowest_layer(socket_).expires_after(k_patience); // time to read the response
    auto response = std::make_shared<http::response<http::string_body>>(status, request_->get().version());
    response->set(http::field::content_type, type);
    shut_in(*response);
    response->keep_alive(false);
    response->body() = std::move(text);
    response->prepare_payload();
    http::async_write(socket_.next_layer(), *response,
                      [self = shared_from_this(), response](Error, size_t) { self->close(); });
}

void Connection::accept() {
    beast::get_lowest_layer(socket_).expires_never(); // a WebSocket has timeouts of its own
    auto times = websocket::stream_base::timeout::suggested(beast::role_type::server);
    times.idle_timeout = 2 * k_patience;
    times.keep_alive_pings = true;
    socket_.set_option(times);
    socket_.read_message_max(k_longest_request);
    socket_.auto_fragment(false);
    socket_.async_accept(request_->get(), [self = shared_from_this()](Error error) {
        if (!error)
            self->welcome();
    });
}

void Connection::welcome() {
    request_.reset();
    is_guest_ = house_.guests().came(id_);
    if (!is_guest_)
        return drop({websocket::close_code::try_again_later, "too many look already"});
    listen();
}

void Connection::listen() {
    socket_.async_read(buffer_, [self = shared_from_this()](Error error, size_t) {
        if (error)
            return self->close();
        self->hear(beast::buffers_to_string(self->buffer_.data()));
        self->buffer_.clear();
        if (!self->closing_)
            self->listen();
    });
}

void Connection::hear(const std::string& message) {
    if (!socket_.got_text())
        return drop({websocket::close_code::unknown_data, "a message is a text"});
    if (auto taken = house_.guests().said(id_, message); !taken)
        drop({websocket::close_code::policy_error, taken.error().message.substr(0, k_longest_reason)});
}

void Connection::send(SharedMessage message) {
    if (closing_)
        return;
    if (waiting_.size() >= k_most_waiting ||
        (!waiting_.empty() && waiting_bytes_ + message->bytes.size() > k_most_bytes_waiting))
        return close();
    waiting_bytes_ += message->bytes.size();
    waiting_.push_back(std::move(message));
    if (waiting_.size() == 1)
        write_next();
}

void Connection::write_next() {
    const Message& message = *waiting_.front();
    socket_.binary(message.binary);
    socket_.async_write(asio::buffer(message.bytes), [self = shared_from_this()](Error error, size_t) {
        if (error)
            return self->close();
        self->waiting_bytes_ -= self->waiting_.front()->bytes.size();
        self->waiting_.pop_front();
        if (!self->waiting_.empty() && !self->closing_)
            self->write_next();
    });
}

void Connection::drop(const websocket::close_reason& why) {
    if (!std::exchange(closing_, true))
        socket_.async_close(why, [self = shared_from_this()](Error) { self->close(); });
}

/// Closes the socket, which also ends pending operations.
void Connection::close() {
    closing_ = true;
    boost::system::error_code ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
    beast::get_lowest_layer(socket_).close();
}

} // namespace tidemark::serve
