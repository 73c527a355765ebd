// Implements the plug-in's Server: a thread that accepts connections and passes messages.
#include "serve/plugin/connection.hpp"
#include "serve/plugin/jpeg.hpp"
#include "serve/plugin/server.hpp"
#include "serve/plugin/vp8.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/host_name.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <fmt/format.h>

#include <exception>
#include <map>
#include <thread>

namespace tidemark::serve {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using ErrorWord = boost::system::error_code;

/// Viewers and clients without a token yet; more than there can be viewers.
constexpr size_t k_most_connections = 64;

tl::unexpected<Error> cannot_listen(const ServerSettings& settings, const std::string& why) {
    return fail(ErrorCode::usage,
                fmt::format("cannot listen at --host {} --port {}: {}", settings.host, settings.port, why));
}

class WebServer : public Server, public House {
public:
    explicit WebServer(ServerSettings settings) : settings_(std::move(settings)), acceptor_(context_) {}
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;
    ~WebServer() override { end(); }

    ErrorWord open() {
        ErrorWord error;
        const auto found = tcp::resolver(context_).resolve(settings_.host, std::to_string(settings_.port),
                                                           tcp::resolver::passive, error);
        if (error)
            return error;
        const tcp::endpoint place = found.begin()->endpoint();
        for (const auto step : {&WebServer::make, &WebServer::bind})
            if (error = (this->*step)(place); error)
                return error;
        return {};
    }

    void start(Guests& guests) override {
        guests_ = &guests;
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
    const ServerSettings& settings() const override { return settings_; }
    Guests& guests() override { return *guests_; }

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
                const auto connection = std::make_shared<Connection>(std::move(socket), ++last_id_, *this);
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

    ServerSettings settings_;
    Guests* guests_ = nullptr; ///< set by start()
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

const ServePlugIn k_plug_in{k_serve_version, open_server, encode_jpeg, open_vp8};

} // namespace
} // namespace tidemark::serve

extern "C" __attribute__((visibility("default"))) const void* tidemark_serve() {
    return &tidemark::serve::k_plug_in;
}
