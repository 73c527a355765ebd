// Implements the plug-in's Server with Boost.Beast: a thread that accepts connections and passes messages.

#include "base/extent.hpp"
#include "web/plugin/server.hpp"
#include "web/request.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <turbojpeg.h>

#include <chrono>
#include <cstddef>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>

namespace tidemark::web {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
namespace {

using asio::ip::tcp;
using ErrorWord = boost::system::error_code;

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

/// Keeps the page private: its address contains the token, and only named pages may embed it.
void shut_in(http::response<http::string_body>& response, const ServerSettings& settings) {
    response.set(http::field::cache_control, "no-store");
    const std::string ancestors =
        settings.ancestors.empty() ? "'none'" : fmt::format("{}", fmt::join(settings.ancestors, " "));
    response.set("Content-Security-Policy",
                 fmt::format("default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; "
                             "img-src blob: data:; connect-src 'self'; frame-ancestors {}; base-uri 'none'; "
                             "form-action 'none'",
                             ancestors));
    response.set("Referrer-Policy", "no-referrer");
    response.set("X-Content-Type-Options", "nosniff");
}

/// The server as its connections see it.
struct House {
    ServerSettings settings;
    bool is_loopback = true;
    Guests* guests = nullptr; ///< set when the server starts
};

/// Answers an HTTP request, or becomes a WebSocket that stays open. Lives as long as one of its operations is
/// pending.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(tcp::socket socket, ViewerId id, const House& house)
        : socket_(std::move(socket)), id_(id), house_(house) {}
    /// Reports that the viewer has left.
    ~Connection() {
        if (is_guest_)
            house_.guests->left(id_);
    }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void start() {
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

    void send(SharedMessage message) {
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

    /// Closes the socket, which also ends pending operations.
    void close() {
        closing_ = true;
        boost::system::error_code ignored;
        beast::get_lowest_layer(socket_).socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
        beast::get_lowest_layer(socket_).close();
    }

    /// Returns whether it has shown the token and is a viewer.
    bool is_guest() const { return is_guest_; }
    /// The server is stopping: leaving is not reported any more.
    void part() { is_guest_ = false; }

private:
    using Error = beast::error_code;

    void answer() {
        const auto& request = request_->get();
        if (request.method() != http::verb::get)
            return respond(http::status::method_not_allowed, "only GET is supported\n");
        const Knock knock{.target = view_of(request.target()),
                          .host = view_of(request[http::field::host]),
                          .origin = view_of(request[http::field::origin]),
                          .upgrade = websocket::is_upgrade(request),
                          .through_loopback = house_.is_loopback};
        switch (answer_to(knock, house_.settings.token, house_.settings.origins)) {
        case Answer::page: return respond(http::status::ok, house_.settings.page, "text/html; charset=utf-8");
        case Answer::socket: return accept();
        case Answer::not_found: return respond(http::status::not_found, "not found\n");
        case Answer::forbidden: break;
        }
        respond(http::status::forbidden,
                "access denied: open the full address printed by `tidemark serve`, including its token\n");
    }

    void respond(http::status status, std::string text, const char* type = "text/plain") {
        beast::get_lowest_layer(socket_).expires_after(k_patience); // time to read the response
        auto response =
            std::make_shared<http::response<http::string_body>>(status, request_->get().version());
        response->set(http::field::content_type, type);
        shut_in(*response, house_.settings);
        response->keep_alive(false);
        response->body() = std::move(text);
        response->prepare_payload();
        http::async_write(socket_.next_layer(), *response,
                          [self = shared_from_this(), response](Error, size_t) { self->close(); });
    }

    void accept() {
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

    void welcome() {
        request_.reset();
        is_guest_ = house_.guests->came(id_);
        if (!is_guest_)
            return drop({websocket::close_code::try_again_later, "too many viewers already"});
        listen();
    }

    void listen() {
        socket_.async_read(buffer_, [self = shared_from_this()](Error error, size_t) {
            if (error)
                return self->close();
            self->hear(beast::buffers_to_string(self->buffer_.data()));
            self->buffer_.clear();
            if (!self->closing_)
                self->listen();
        });
    }

    void hear(const std::string& message) {
        if (!socket_.got_text())
            return drop({websocket::close_code::unknown_data, "a message must be text"});
        if (auto taken = house_.guests->said(id_, message); !taken)
            drop({websocket::close_code::policy_error, taken.error().message.substr(0, k_longest_reason)});
    }

    void write_next() {
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

    void drop(const websocket::close_reason& why) {
        if (!std::exchange(closing_, true))
            socket_.async_close(why, [self = shared_from_this()](Error) { self->close(); });
    }

    beast::websocket::stream<beast::tcp_stream> socket_;
    ViewerId id_;
    const House& house_;
    bool is_guest_ = false;
    bool closing_ = false;
    beast::flat_buffer buffer_;
    std::optional<beast::http::request_parser<beast::http::empty_body>> request_;
    std::deque<SharedMessage> waiting_; ///< the first is being written
    size_t waiting_bytes_ = 0;
};

/// From this quality on, colour has full resolution.
constexpr int k_fine_quality = 90;

struct Destroy {
    void operator()(void* compressor) const { tjDestroy(compressor); }
};

/// Implements ServePlugIn::encode.
std::string encode_jpeg(Extent extent, std::span<const std::byte> rgba, int quality) {
    static const std::unique_ptr<void, Destroy> compressor(tjInitCompress());
    const int sampling = quality >= k_fine_quality ? TJSAMP_444 : TJSAMP_420;
    std::string file(tjBufSize(extent.width, extent.height, sampling), '\0');
    auto* begin = reinterpret_cast<unsigned char*>(file.data());
    unsigned long size = file.size();
    const int failed = tjCompress2(compressor.get(), reinterpret_cast<const unsigned char*>(rgba.data()),
                                   extent.width, 0, extent.height, TJPF_RGBX, &begin, &size, sampling,
                                   quality, TJFLAG_BOTTOMUP | TJFLAG_NOREALLOC | TJFLAG_FASTDCT);
    file.resize(failed == 0 ? size : 0);
    return file;
}

/// Viewers and clients without a token yet; more than there can be viewers.
constexpr size_t k_most_connections = 64;

tl::unexpected<Error> cannot_listen(const ServerSettings& settings, const std::string& why) {
    return fail(ErrorCode::usage,
                fmt::format("cannot listen at --host {} --port {}: {}", settings.host, settings.port, why));
}

class WebServer : public Server {
public:
    explicit WebServer(ServerSettings settings) : house_{std::move(settings)}, acceptor_(context_) {}
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;
    ~WebServer() override { end(); }

    ErrorWord open() {
        ErrorWord error;
        const auto found = tcp::resolver(context_).resolve(
            house_.settings.host, std::to_string(house_.settings.port), tcp::resolver::passive, error);
        if (error)
            return error;
        const tcp::endpoint place = found.begin()->endpoint();
        for (const auto step : {&WebServer::make, &WebServer::bind})
            if (error = (this->*step)(place); error)
                return error;
        return {};
    }

    void start(Guests& guests) override {
        house_.guests = &guests;
        house_.is_loopback = is_loopback();
        accept();
        thread_ = std::thread([this] { run(); });
    }

    void stop() override { end(); }

    void send(ViewerId viewer, SharedMessage message) override {
        asio::post(context_, [this, viewer, message = std::move(message)]() mutable {
            const auto known = connections_.find(viewer);
            if (const auto connection = known != connections_.end() ? known->second.lock() : nullptr)
                connection->send(std::move(message));
        });
    }

    std::string place() const override {
        const tcp::endpoint at = acceptor_.local_endpoint();
        ErrorWord ignored;
        const std::string name = at.address().is_unspecified() ? asio::ip::host_name(ignored)
                                 : at.address().is_v6()        ? "[" + at.address().to_string() + "]"
                                                               : at.address().to_string();
        return fmt::format("{}:{}", name, at.port());
    }

    bool is_loopback() const override { return acceptor_.local_endpoint().address().is_loopback(); }

private:
    void end() {
        context_.stop();
        if (thread_.joinable())
            thread_.join();
        for (const auto& [id, known] : connections_)
            if (const auto connection = known.lock())
                connection->part();
    }

    /// Boost throws if memory runs out: that ends the operation, but not the others.
    void run() {
        while (!context_.stopped())
            try {
                context_.run();
            } catch (const std::exception&) {
            }
    }

    ErrorWord make(const tcp::endpoint& place) {
        ErrorWord error;
        acceptor_.open(place.protocol(), error);
        if (!error)
            acceptor_.set_option(asio::socket_base::reuse_address(true), error);
        return error;
    }

    ErrorWord bind(const tcp::endpoint& place) {
        ErrorWord error;
        acceptor_.bind(place, error);
        if (!error)
            acceptor_.listen(asio::socket_base::max_listen_connections, error);
        return error;
    }

    void accept() {
        acceptor_.async_accept([this](ErrorWord error, tcp::socket socket) {
            if (error == asio::error::operation_aborted)
                return;
            std::erase_if(connections_, [](const auto& known) { return known.second.expired(); });
            if (connections_.size() >= k_most_connections)
                close_oldest_stranger();
            if (!error) {
                const auto connection = std::make_shared<Connection>(std::move(socket), ++last_id_, house_);
                connections_[last_id_] = connection;
                connection->start();
            }
            accept();
        });
    }

    /// Closes the oldest connection without a token, so that silent clients cannot block others.
    void close_oldest_stranger() {
        for (const auto& [id, known] : connections_) // in the order of arrival
            if (const auto connection = known.lock(); connection && !connection->is_guest()) {
                connection->close();
                connections_.erase(id);
                return;
            }
    }

    House house_;
    std::map<ViewerId, std::weak_ptr<Connection>> connections_;
    ViewerId last_id_ = 0;
    asio::io_context context_{1}; ///< destroyed before the members that its handlers use
    tcp::acceptor acceptor_;
    std::thread thread_;
};

/// Boost throws if memory or descriptors run out.
Result<std::unique_ptr<Server>> open_server(const ServerSettings& settings) {
    try {
        auto server = std::make_unique<WebServer>(settings);
        if (const ErrorWord error = server->open())
            return cannot_listen(settings, error.message());
        return server;
    } catch (const std::exception& error) {
        return cannot_listen(settings, error.what());
    }
}

const ServePlugIn k_plug_in{k_serve_version, open_server, encode_jpeg};

} // namespace

} // namespace tidemark::web

extern "C" __attribute__((visibility("default"))) const void* tidemark_serve() {
    return &tidemark::web::k_plug_in;
}
