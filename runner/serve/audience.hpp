// Connected clients: which one has control, which pictures each has acknowledged, and the texts for a new
// one. A slow client does not delay the others: it misses pictures and gets the newest when it is ready
// again.
#pragma once

#include "serve/hands.hpp"
#include "serve/inbox.hpp"
#include "serve/plugin/server.hpp"
#include "serve/request.hpp"

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace tidemark::serve {

/// An encoded picture, to be sent; numbered from 1.
struct NumberedPicture {
    uint32_t number = 0;
    SharedMessage message{};  ///< as a whole; null if no viewer needs it
    SharedMessage film{};     ///< as changes since `film_before`; null likewise
    uint32_t film_before = 0; ///< number of the preceding film picture; 0: a key picture, which needs none
};

/// The encodings that the viewers need.
struct WantedCodings {
    bool whole = false;
    bool film = false;
    bool key = false; ///< a viewer of the film has not received its last picture
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
        bool film = false; ///< send a film to viewers that can show one
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
    WantedCodings wanted() const;

private:
    struct Viewer {
        std::deque<uint32_t> on_the_way; ///< numbers of pictures sent and not acknowledged
        uint32_t sent = 0;               ///< number of the newest one sent
        bool shows_film = false;
        uint32_t film = 0; ///< number of the newest film picture sent

        bool is_ready() const { return on_the_way.size() < k_pictures_on_the_way; }
    };

    void handle(ViewerId viewer, const PictureSeen& seen);
    void handle(ViewerId viewer, SteeringWanted);
    void handle(ViewerId viewer, const FilmShown& shown);
    void handle(ViewerId viewer, const platform::InputEvent& event);
    void handle(ViewerId viewer, const live::Command& command);
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
    /// time of the last change that a viewer asked for
    std::chrono::steady_clock::time_point steering_since_{};
    Hands hands_;
    NumberedPicture newest_;
    uint32_t newest_film_ = 0; ///< number of the film's last picture
    std::map<std::string, SharedMessage> told_;
};

} // namespace tidemark::serve
