// One connection: an HTTP request is answered, or becomes a WebSocket that stays. By Boost.Beast, on one
// thread.
#pragma once

#include "serve/plugin/server.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <deque>
#include <memory>
#include <optional>

namespace tidemark::serve {

/// What connections know of their server; all on its thread.
class House {
public:
    virtual ~House() = default;

    virtual const ServerSettings& settings() const = 0;
    virtual bool is_loopback() const = 0;
    virtual Guests& guests() = 0;
};

/// Lives as long as an operation of it is under way.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(boost::asio::ip::tcp::socket socket, ViewerId id, House& house);
    /// Tells the guests that a viewer has left.
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void start();
    void send(SharedMessage message);
    void close();
    /// It showed the token, and watches.
    bool is_guest() const { return is_guest_; }
    /// The server ends: nobody is told any more.
    void part() { is_guest_ = false; }

private:
    using Error = boost::beast::error_code;

    void answer();
    void respond(boost::beast::http::status status, std::string text, const char* type = "text/plain");
    void accept();
    void welcome();
    void listen();
    void hear(const std::string& message);
    void write_next();
    void drop(const boost::beast::websocket::close_reason& why);

    boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
    ViewerId id_;
    House& house_;
    bool is_guest_ = false;
    bool closing_ = false;
    boost::beast::flat_buffer buffer_;
    std::optional<boost::beast::http::request_parser<boost::beast::http::empty_body>> request_;
    std::deque<SharedMessage> waiting_; ///< the first is under way
    size_t waiting_bytes_ = 0;
};

} // namespace tidemark::serve
