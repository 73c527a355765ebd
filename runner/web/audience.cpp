#include "web/audience.hpp"

#include "base/dynamic_library.hpp"
#include "base/overloaded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tidemark::web {
namespace {

constexpr size_t k_most_waiting = 4096;
constexpr double k_as_good_as_forever = 1e6;

SharedMessage steering_text(bool you, size_t viewers) {
    return std::make_shared<Message>(
        Message{fmt::format(R"({{"steering":{{"you":{},"viewers":{}}}}})", you, viewers)});
}

} // namespace

void Hands::follow(const host::InputEvent& event) {
    std::visit(Overloaded{
                   [&](const host::PointerMoved& moved) { pointer_ = moved.at; },
                   [&](const host::ButtonPressed& pressed) { buttons_.insert(pressed.button); },
                   [&](const host::ButtonReleased& released) { buttons_.erase(released.button); },
                   [&](const host::KeyPressed& pressed) { keys_.insert(pressed.key); },
                   [&](const host::KeyReleased& released) { keys_.erase(released.key); },
                   [](const auto&) {},
               },
               event);
}

std::vector<host::InputEvent> Hands::let_go() {
    std::vector<host::InputEvent> events;
    for (const host::Button button : buttons_)
        events.emplace_back(host::ButtonReleased{button, pointer_});
    for (const host::Key key : keys_)
        events.emplace_back(host::KeyReleased{key});
    buttons_.clear();
    keys_.clear();
    return events;
}

bool Inbox::is_full() const {
    const std::lock_guard lock(mutex_);
    return content_.events.size() + content_.commands.size() >= k_most_waiting;
}

void Inbox::add(const host::InputEvent& event) {
    const auto moves = [](const host::InputEvent& other) {
        return std::holds_alternative<host::PointerMoved>(other);
    };
    const std::lock_guard lock(mutex_);
    auto& events = content_.events;
    if (!events.empty() && moves(events.back()) && moves(event))
        events.pop_back();
    events.push_back(event);
    changed_.notify_one();
}

void Inbox::add(overlay::Command command) {
    const std::lock_guard lock(mutex_);
    content_.commands.push_back(std::move(command));
    changed_.notify_one();
}

Inbox::Content Inbox::wait(double seconds) {
    std::unique_lock lock(mutex_);
    const std::chrono::duration<double> most(std::clamp(seconds, 0.0, k_as_good_as_forever));
    changed_.wait_for(lock, most,
                      [&] { return woken_ || !content_.events.empty() || !content_.commands.empty(); });
    woken_ = false;
    return std::exchange(content_, {});
}

void Inbox::wake() {
    const std::lock_guard lock(mutex_);
    woken_ = true;
    changed_.notify_one();
}

bool Audience::came(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    if (viewers_.size() >= k_most_viewers)
        return false;
    Viewer& made = viewers_[viewer];
    for (const auto& [kind, text] : told_)
        settings_.send(viewer, text);
    send_newest(viewer, made);
    if (viewers_.size() == 1)
        steering_ = viewer;
    tell_who_steers();
    inbox_.wake();
    return true;
}

Result<void> Audience::said(ViewerId viewer, std::string_view message) {
    const Request request = TRY(parse_request(message));
    const std::lock_guard lock(mutex_);
    if (viewer == steering_ && inbox_.is_full())
        return fail(ErrorCode::usage, "too many messages at a time");
    std::visit([&](const auto& wanted) { handle(viewer, wanted); }, request);
    return {};
}

void Audience::left(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    viewers_.erase(viewer);
    if (viewers_.empty() && settings_.once)
        inbox_.add(host::CloseRequested{});
    if (viewer == steering_)
        steer(viewers_.empty() ? 0 : viewers_.begin()->first);
    else
        tell_who_steers();
}

void Audience::handle(ViewerId viewer, const PictureSeen& seen) {
    Viewer& who = viewers_[viewer];
    if (who.on_the_way.empty() || seen.number > who.on_the_way.back())
        return; // no picture of that number was sent
    std::erase_if(who.on_the_way, [&](uint32_t number) { return number <= seen.number; });
    send_newest(viewer, who);
    inbox_.wake();
}

/// Input of viewers without control is ignored.
void Audience::handle(ViewerId viewer, const host::InputEvent& event) {
    if (viewer != steering_)
        return;
    hands_.follow(event);
    inbox_.add(event);
}

void Audience::handle(ViewerId viewer, const overlay::Command& command) {
    if (viewer == steering_)
        inbox_.add(command);
}

void Audience::handle(ViewerId viewer, LetGo) {
    if (viewer == steering_)
        let_go();
}

void Audience::send_newest(ViewerId id, Viewer& viewer) {
    if (viewer.sent == newest_.number || !viewer.is_ready() || !newest_.message)
        return;
    viewer.sent = newest_.number;
    viewer.on_the_way.push_back(newest_.number);
    settings_.send(id, newest_.message);
}

/// Limits the rate: each change of control is sent to all viewers, and users must be able to follow.
void Audience::handle(ViewerId viewer, SteeringWanted) {
    constexpr std::chrono::milliseconds k_shortest_turn(100);
    const auto now = std::chrono::steady_clock::now();
    if (viewer == steering_ || now - steering_since_ < k_shortest_turn)
        return;
    steering_since_ = now;
    steer(viewer);
}

void Audience::steer(ViewerId viewer) {
    let_go();
    steering_ = viewer;
    tell_who_steers();
}

void Audience::let_go() {
    for (const host::InputEvent& event : hands_.let_go())
        inbox_.add(event);
}

void Audience::tell_who_steers() {
    for (const auto& [id, viewer] : viewers_)
        settings_.send(id, steering_text(id == steering_, viewers_.size()));
}

void Audience::show(NumberedPicture picture) {
    const std::lock_guard lock(mutex_);
    newest_ = std::move(picture);
    for (auto& [id, viewer] : viewers_)
        send_newest(id, viewer);
    inbox_.wake();
}

void Audience::tell(const std::string& kind, SharedMessage text) {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, viewer] : viewers_)
        settings_.send(id, text);
    told_[kind] = std::move(text);
}

void Audience::tell_steering(const SharedMessage& text) {
    const std::lock_guard lock(mutex_);
    if (steering_ != 0)
        settings_.send(steering_, text);
}

bool Audience::is_waiting() const {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(viewers_, [](const auto& viewer) { return viewer.second.is_ready(); });
}

Result<const ServePlugIn*> load_serve_plug_in() {
    return load_plug_in<ServePlugIn>({"tidemark_serve.so", "plug-in of the web server",
                                      "serving a scene to browsers", "libturbojpeg 2.1", k_serve_entry,
                                      k_serve_version});
}

} // namespace tidemark::web
