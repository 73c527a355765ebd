#include "cli/serve/remote_screen.hpp"

#include "base/try.hpp"
#include "cli/view/wall_clock.hpp"
#include "render/pass_target.hpp"
#include "serve/page.hpp"
#include "serve/plug_in.hpp"
#include "serve/state_text.hpp"

#include <fmt/format.h>

#include <utility>

namespace tidemark::cli {
namespace {

serve::SharedMessage text_message(std::string text) {
    return std::make_shared<serve::Message>(serve::Message{std::move(text)});
}

/// Returns a texture as RGBA bytes, whatever its format.
image::Image read_texture(unsigned texture, Extent extent) {
    image::Image picture(extent, 4, image::SampleType::u8);
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(picture.bytes.size()),
                      picture.bytes.data());
    return picture;
}

image::Image read_target(const gl::RenderTarget& target) {
    image::Image picture(target.extent(), 4, image::SampleType::u8);
    gl::read_pixels(target, GL_RGBA, GL_UNSIGNED_BYTE, picture.bytes);
    return picture;
}

} // namespace

RemoteScreen::RemoteScreen(Settings settings, platform::HeadlessContext context)
    : settings_(std::move(settings)), context_(std::move(context)),
      audience_({.send = [this](auto viewer, auto message) { server_->send(viewer, std::move(message)); },
                 .once = settings_.once,
                 .film = settings_.film},
                inbox_) {}

/// Stops the threads first: they send through members that are destroyed next.
RemoteScreen::~RemoteScreen() {
    if (server_)
        server_->stop();
    encoder_.reset();
}

Result<std::unique_ptr<RemoteScreen>> RemoteScreen::open(Settings settings) {
    auto context = TRY(platform::HeadlessContext::create());
    TRY(render::check_size(settings.extent));
    std::unique_ptr<RemoteScreen> screen(new RemoteScreen(std::move(settings), std::move(context)));
    TRY(screen->listen());
    return screen;
}

Result<void> RemoteScreen::listen() {
    const serve::ServePlugIn& plug_in = *TRY(serve::load_serve_plug_in());
    settings_.server.page = serve::k_page;
    server_ = TRY(plug_in.open(settings_.server));
    film_ = plug_in.open_film(settings_.quality);
    encoder_ = std::make_unique<serve::PictureEncoder>(serve::PictureEncoder::Settings{
        .whole = [encode = plug_in.encode, quality = settings_.quality](
                     const image::Image& picture) { return encode(picture.extent, picture.bytes, quality); },
        .film = [this](const image::Image& picture,
                       bool key) { return film_->encode(picture.extent, picture.bytes, key); },
        .wanted = [this] { return audience_.wanted(); },
        .done = [this](serve::NumberedPicture picture) { audience_.show(std::move(picture)); }});
    server_->start(audience_);
    return {};
}

std::string RemoteScreen::address() const {
    return fmt::format("http://{}/?token={}", server_->place(), settings_.server.token);
}

std::vector<platform::InputEvent> RemoteScreen::wait(double seconds) {
    serve::Inbox::Content content = inbox_.wait(seconds);
    woken_at_ = now_seconds();
    was_asked_ |= !content.commands.empty();
    commands_.insert(commands_.end(), std::make_move_iterator(content.commands.begin()),
                     std::make_move_iterator(content.commands.end()));
    return std::move(content.events);
}

live::Commands RemoteScreen::take_commands() {
    return std::exchange(commands_, {});
}

/// Returns whether the key works in a page. The others have no use there, or must not act on another machine.
bool RemoteScreen::has(platform::Key key) const {
    using platform::Key;
    switch (key) {
    case Key::space:
    case Key::left:
    case Key::right:
    case Key::home:
    case Key::r:
    case Key::c: return true;
    default: return key >= Key::digit_0 && key <= Key::digit_9;
    }
}

void RemoteScreen::begin(const gl::RenderTarget* picture, bool fresh) {
    picture_ = picture;
    fresh_ |= fresh;
}

Result<void> RemoteScreen::finish(live::Model model, const ShownMoment& moment) {
    was_asked_ = false;
    if (picture_ && (fresh_ || model.large != large_))
        send_picture(model, moment);
    std::string state = serve::state_text(model, settings_.extent, moment.reads_keyboard);
    if (state != told_)
        audience_.tell("state", text_message(state));
    told_ = std::move(state);
    return {};
}

void RemoteScreen::send_picture(const live::Model& model, const ShownMoment& moment) {
    // An unchanged picture is only read back, so its time counts from the start of this iteration.
    const double begun = std::exchange(fresh_, false) ? moment.begun : woken_at_;
    large_ = model.large;
    const live::PictureField* large = large_ ? &model.pictures[*large_] : nullptr;
    image::Image picture = large ? read_texture(large->texture, large->extent) : read_target(*picture_);
    const uint32_t number = 2 * pictures_++ + 1; // the number after it is for the encoder
    serve::PictureHead head{.number = number, .seconds = moment.seconds, .frame = moment.frame};
    for (const live::PictureField& field : model.pictures)
        head.costs.push_back(field.milliseconds);
    head.draw_ms = (now_seconds() - begun) * 1000;
    encoder_->push({std::move(picture), std::move(head)});
}

void RemoteScreen::set_title(const std::string& title) {
    audience_.tell("title", text_message(serve::line_text("title", title)));
}

void RemoteScreen::set_clipboard(const std::string& text) {
    audience_.tell_steering(text_message(serve::line_text("clipboard", text)));
}

} // namespace tidemark::cli
