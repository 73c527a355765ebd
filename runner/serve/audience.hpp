// Those who look: which of them steers, what each has still to see, and what a newcomer must be told. No slow
// one holds up the others: it misses pictures, and gets the newest when it is ready again.
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

/// A picture as it is sent; they are numbered from 1.
struct NumberedPicture {
    uint32_t number = 0;
    SharedMessage message{};  ///< whole; null where nobody wants it so
    SharedMessage film{};     ///< as what changed since `film_before`; null likewise
    uint32_t film_before = 0; ///< number of the film's picture before it; 0: it can be seen without
};

/// What the next picture is wanted as, by those who are ready for it.
struct WantedCodings {
    bool whole = false;
    bool film = false;
    bool key = false; ///< of those who want the film one has not seen its last picture
};

/// All of it from any thread.
class Audience : public Guests {
public:
    static constexpr size_t k_most_viewers = 16;
    /// One that is on its way while the next one is made.
    static constexpr size_t k_pictures_on_the_way = 2;

    struct Settings {
        std::function<void(ViewerId, SharedMessage)> send;
        bool once = false; ///< the end of the last viewer is that of the program
        bool film = false; ///< whoever can show a film is sent one
    };

    /// What viewers do goes into `inbox`, which is woken when one of them is ready for a picture, too.
    Audience(Settings settings, Inbox& inbox) : settings_(std::move(settings)), inbox_(inbox) {}

    bool came(ViewerId viewer) override;
    Result<void> said(ViewerId viewer, std::string_view message) override;
    void left(ViewerId viewer) override;

    /// To everybody who is ready for it, and later to the others, unless there is a newer one by then.
    void show(NumberedPicture picture);
    /// To everybody, and to those who come later: each text takes the place of the one of that `kind`.
    void tell(const std::string& kind, SharedMessage text);
    /// To the one who steers.
    void tell_steering(const SharedMessage& text);

    /// Somebody is ready for one more picture.
    bool is_waiting() const;
    WantedCodings wanted() const;

private:
    struct Viewer {
        std::deque<uint32_t> on_the_way; ///< numbers of pictures
        uint32_t sent = 0;               ///< the newest of them, ever
        bool shows_film = false;
        uint32_t film = 0; ///< the newest of the film's that it was sent

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
    mutable std::mutex mutex_;           ///< of what follows
    std::map<ViewerId, Viewer> viewers_; ///< in the order in which they came
    ViewerId steering_ = 0;
    std::chrono::steady_clock::time_point steering_since_{}; ///< asked for, not inherited
    Hands hands_;
    NumberedPicture newest_;
    uint32_t newest_film_ = 0; ///< number of the film's last picture
    std::map<std::string, SharedMessage> told_;
};

} // namespace tidemark::serve
