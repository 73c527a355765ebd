// The server's viewers: their input, control, and the pictures they have acknowledged.
//
// The keys and buttons that the controlling viewer holds down, so that they can be released when it loses
// control.
#pragma once

#include "base/error.hpp"
#include "host/input_events.hpp"
#include "host/overlay_model.hpp"
#include "web/plugin/server.hpp"
#include "web/request.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace tidemark::web {

class Hands {
public:
    void follow(const host::InputEvent& event);
    /// Returns the events that release them all.
    std::vector<host::InputEvent> let_go();

private:
    std::set<host::Button> buttons_;
    std::set<host::Key> keys_;
    host::PointerPosition pointer_{};
};

// Input of the controlling viewer, passed from the server's thread to the drawing thread.

class Inbox {
public:
    struct Content {
        std::vector<host::InputEvent> events;
        overlay::Commands commands;
    };

    /// Adds an event; a pointer move replaces one directly before it.
    void add(const host::InputEvent& event);
    void add(overlay::Command command);
    /// Returns whether more is waiting than a user could produce.
    bool is_full() const;

    /// Returns what was added since the last call. Sleeps until there is something, `wake` was called or the
    /// seconds, which may be infinite, have passed.
    Content wait(double seconds);
    void wake();

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    Content content_;
    bool woken_ = false;
};

// Connected clients: which one has control, which pictures each has acknowledged, and the texts for a new
// one. A slow client does not delay the others: it misses pictures and gets the newest when it is ready
// again.

/// An encoded picture, to be sent; numbered from 1.
struct NumberedPicture {
    uint32_t number = 0;
    SharedMessage message{}; ///< null if encoding failed
};

/// Thread-safe.
class Audience : public Guests {
public:
    static constexpr size_t k_most_viewers = 16;
    /// One can be on its way while the next one is made.
    static constexpr size_t k_pictures_on_the_way = 2;

    struct Settings {
        std::function<void(ViewerId, SharedMessage)> send;
        bool once = false; ///< close the program when the last viewer leaves
    };

    /// Adds the viewers' input to `inbox`, and wakes it when a viewer is ready for a picture.
    Audience(Settings settings, Inbox& inbox) : settings_(std::move(settings)), inbox_(inbox) {}

    bool came(ViewerId viewer) override;
    Result<void> said(ViewerId viewer, std::string_view message) override;
    void left(ViewerId viewer) override;

    /// Sends it to every viewer that is ready, and to the others when they are, unless there is a newer one
    /// by then.
    void show(NumberedPicture picture);
    /// Sends a text to all viewers, and to later ones when they connect; it replaces the last text of that
    /// `kind`.
    void tell(const std::string& kind, SharedMessage text);
    /// Sends a text to the viewer with control.
    void tell_steering(const SharedMessage& text);

    /// Returns whether a viewer is ready for one more picture.
    bool is_waiting() const;

private:
    struct Viewer {
        std::deque<uint32_t> on_the_way; ///< numbers of pictures sent and not acknowledged
        uint32_t sent = 0;               ///< number of the newest one sent

        bool is_ready() const { return on_the_way.size() < k_pictures_on_the_way; }
    };

    void handle(ViewerId viewer, const PictureSeen& seen);
    void handle(ViewerId viewer, SteeringWanted);
    void handle(ViewerId viewer, const host::InputEvent& event);
    void handle(ViewerId viewer, const overlay::Command& command);
    void handle(ViewerId viewer, LetGo);
    void send_newest(ViewerId id, Viewer& viewer);
    void steer(ViewerId viewer);
    void let_go();
    void tell_who_steers();

    Settings settings_;
    Inbox& inbox_;
    mutable std::mutex mutex_;           ///< guards the members below
    std::map<ViewerId, Viewer> viewers_; ///< in the order of their arrival
    ViewerId steering_ = 0;
    /// time of the last change that a viewer requested
    std::chrono::steady_clock::time_point steering_since_{};
    Hands hands_;
    NumberedPicture newest_;
    std::map<std::string, SharedMessage> told_;
};

// Loads the web server's plug-in on first use; only `tidemark serve` needs it.

Result<const ServePlugIn*> load_serve_plug_in();

} // namespace tidemark::web
