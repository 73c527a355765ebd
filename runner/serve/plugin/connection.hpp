// One connection: answers an HTTP request, or becomes a WebSocket that stays open. Uses Boost.Beast, on one
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

/// The server as its connections see it; used on its thread only.
class House {
public:
    virtual ~House() = default;

    virtual const ServerSettings& settings() const = 0;
    virtual bool is_loopback() const = 0;
    virtual Guests& guests() = 0;
};

/// Lives as long as one of its operations is pending.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(boost::asio::ip::tcp::socket socket, ViewerId id, House& house);
    /// Reports that the viewer has left.
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void start();
    void send(SharedMessage message);
    void close();
    /// Returns whether it has shown the token and is a viewer.
    bool is_guest() const { return is_guest_; }
    /// The server is stopping: leaving is not reported any more.
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
    std::deque<SharedMessage> waiting_; ///< the first is being written
    size_t waiting_bytes_ = 0;
};

} // namespace tidemark::serve
