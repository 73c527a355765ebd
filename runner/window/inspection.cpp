#include "window/inspection.hpp"

#include "base/process.hpp"
#include "host/console.hpp"
#include "host/json.hpp"
#include "host/scene_report.hpp"
#include "window/screen.hpp"
#include "window/viewer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <utility>

namespace tidemark::cli {

std::vector<render::PassTimer>* PassCosts::next_frame() {
    frame_before_ = std::exchange(in_parts_, std::nullopt);
    for (const render::PassTimer& timer : timers_)
        if (const auto took = timer.time.milliseconds(); took) {
            milliseconds_[timer.pass] = *took;
            frame_before_ = frame_before_.value_or(0) + *took;
        }
    timers_.clear();
    return &timers_;
}

void PassCosts::took(size_t pass, double milliseconds) {
    milliseconds_[pass] = milliseconds;
    in_parts_ = in_parts_.value_or(0) + milliseconds;
}

void PassCosts::forget() {
    in_parts_.reset();
    timers_.clear();
    milliseconds_.clear();
    frame_before_.reset();
}

std::optional<double> PassCosts::of(size_t pass) const {
    const auto known = milliseconds_.find(pass);
    return known == milliseconds_.end() ? std::nullopt : std::optional(known->second);
}

namespace {

/// Pixels along a side of a cube's face in a thumbnail, and the most in a large picture.
constexpr int k_small_face = 64;
constexpr int k_large_face = 512;

/// Returns the side of a cube's face for the window, which shows four by three. More pixels cost time and
/// cannot be seen.
int face_in(Extent window) {
    return std::clamp(std::min(window.width / 4, window.height / 3), 1, k_large_face);
}

struct Source {
    std::string name;
    const gl::Texture* texture;
    std::optional<size_t> pass{}; ///< the pass that draws it
};

std::vector<Source> sources_of(const render::Renderer& renderer) {
    std::vector<Source> sources;
    const std::vector<scene::Pass>& passes = renderer.scene().passes;
    for (const render::PlannedPass& planned : renderer.plan().passes)
        sources.push_back(
            {passes[planned.pass].name, &renderer.target_of(planned.pass).texture, planned.pass});
    for (const render::PlannedPass& planned : renderer.plan().passes)
        for (const int channel : planned.channels) {
            const scene::Pass& pass = passes[planned.pass];
            const gl::Texture* texture = renderer.texture_at(planned.pass, channel);
            if (texture && !source_pass(pass.channels[size_t(channel)].input))
                sources.push_back({fmt::format("{} iChannel{}", pass.name, channel), texture});
        }
    return sources;
}

std::string size_of(const gl::Texture& texture) {
    const std::string size = fmt::format("{}x{}", texture.extent.width, texture.extent.height);
    return texture.target == GL_TEXTURE_CUBE_MAP ? "6 of " + size
           : texture.target == GL_TEXTURE_3D     ? fmt::format("{}x{}", size, texture.depth)
                                                 : size;
}

render::Look look_of(const live::LookField& field) {
    const live::ChannelChoice& choice = live::k_channel_choices[field.channels];
    return {choice.channel, choice.less, field.automatic ? 0 : field.stops, field.automatic};
}

} // namespace

/// Returns the flat view of a texture; null where it cannot be shown.
const gl::Texture* PictureViews::flat(const gl::Texture& picture, int face, std::optional<int> slice) {
    auto view = flat_.find(picture.id());
    if (view == flat_.end()) {
        auto made = render::FlatView::create(picture);
        if (!made) {
            say(to_string(made.error()));
            return nullptr;
        }
        view = flat_.emplace(picture.id(), *std::move(made)).first;
    }
    return view->second.draw(picture, slice.value_or(picture.depth / 2), face);
}

const gl::Texture& PictureViews::looked_at(const gl::Texture& picture, live::LookField& look) {
    const render::Look wanted = look_of(look);
    if (wanted.is_plain())
        return picture;
    if (!look_) {
        auto made = render::PictureLook::create();
        if (!made) {
            say(to_string(made.error()));
            look = {.slice = look.slice};
            return picture;
        }
        look_ = *std::move(made);
    }
    const gl::Texture* drawn = look_->draw(picture, wanted);
    look.stops = look_->stops();
    return drawn ? *drawn : picture;
}

std::vector<live::PictureField> PictureViews::fields(const render::Renderer& renderer, const PassCosts& costs,
                                                     Large& large, render::ShownFloats& floats,
                                                     const render::FrameInputs& inputs) {
    std::vector<live::PictureField> fields;
    for (const Source& source : sources_of(renderer)) {
        const bool is_large = large.index == fields.size();
        const gl::Texture* picture = source.texture;
        live::PictureField field{.name = source.name, .extent = {}, .size = size_of(*picture)};
        if (source.pass)
            field.milliseconds = costs.of(*source.pass);
        if (picture->target == GL_TEXTURE_3D)
            field.slices = picture->depth;
        if (render::FlatView::is_needed(*picture))
            picture = flat(*picture, is_large ? face_in(large.window) : k_small_face, large.look.slice);
        else if (is_large && source.pass == renderer.shown_index() && !look_of(large.look).is_plain())
            picture = &floats.draw(renderer, inputs, {0, 0, picture->extent});
        if (is_large && picture)
            picture = &looked_at(*picture, large.look);
        if (picture) {
            field.texture = picture->id();
            field.extent = picture->extent;
        }
        fields.push_back(std::move(field));
    }
    return fields;
}

namespace {

constexpr Extent k_cells{15, 9};

/// Fills the cells with `part`, as far as it lies within the texture.
void show_cells(const gl::Texture& texture, const Rectangle& part, live::MagnifierField& field) {
    const Rectangle known = part.within({0, 0, texture.extent});
    const std::vector<float> values = gl::read_part(texture, 0, known);
    field.cells = part.extent;
    field.colours.assign(part.extent.pixels(), std::nullopt);
    for (int row = 0; row < known.extent.height; ++row)
        for (int column = 0; column < known.extent.width; ++column) {
            const size_t cell = size_t(known.y - part.y + row) * size_t(part.extent.width) +
                                size_t(known.x - part.x + column);
            const size_t texel = size_t(row) * size_t(known.extent.width) + size_t(column);
            field.colours[cell] = live::colour_of(&values[4 * texel]);
        }
}

live::PixelValue value_at(const scene::Pass& pass, const gl::Texture& texture, const Rectangle& pixel) {
    live::PixelValue value{pass.name, gl::read_part(texture, 0, pixel)};
    if (pass.kind == scene::PassKind::image)
        value.channels.pop_back();
    return value;
}

} // namespace

bool Magnifier::follow(const platform::InputEvent& event) {
    const auto* moved = std::get_if<platform::PointerMoved>(&event);
    if (moved)
        pointer_ = moved->at;
    return moved && open_;
}

Rectangle Magnifier::pixel(Extent picture, Extent window) const {
    const auto at = [](double place, int pixels, int length) {
        return int(std::floor(place * pixels / std::max(length, 1)));
    };
    return {
        at(pointer_.x, picture.width, window.width), at(pointer_.y, picture.height, window.height), {1, 1}};
}

std::optional<live::MagnifierField> Magnifier::field(const render::Renderer& renderer,
                                                     const render::FrameInputs& inputs, Extent window,
                                                     render::ShownFloats& floats) const {
    const Extent picture = renderer.target().extent();
    const Rectangle under = pixel(picture, window);
    if (!open_ || !Rectangle{0, 0, picture}.contains(under.x, under.y))
        return std::nullopt;
    const Rectangle part{under.x - k_cells.width / 2, under.y - k_cells.height / 2, k_cells};
    const gl::Texture& shown = floats.draw(renderer, inputs, part);
    live::MagnifierField field{.pointer = pointer_, .x = under.x, .y = under.y};
    show_cells(shown, part, field);
    field.values.push_back(value_at(renderer.shown_pass(), shown, under));
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const scene::Pass& pass = renderer.scene().passes[planned.pass];
        const gl::Texture& texture = renderer.target_of(planned.pass).texture;
        if (planned.pass != renderer.shown_index() && texture.target == GL_TEXTURE_2D)
            field.values.push_back(value_at(pass, texture, under));
    }
    return field;
}

namespace {

constexpr double k_shortest_pause_seconds = 1;
/// Limits the checks to 1 % of the time.
constexpr double k_pause_per_second_of_looking = 100;

} // namespace

void FiniteWatch::begin_anew() {
    *this = {};
}

double FiniteWatch::due() const {
    return unseen_ && found_ == 0 ? next_ : std::numeric_limits<double>::infinity();
}

size_t FiniteWatch::look(const render::Renderer& renderer, double now) {
    image::Image picture = renderer.read_back();
    found_ = count_not_finite(renderer, picture);
    unseen_ = false;
    next_ = now + std::max(k_shortest_pause_seconds, k_pause_per_second_of_looking * (now_seconds() - now));
    return found_;
}

namespace {

constexpr const char* k_this_program = "/proc/self/exe";

/// Starts this program with its standard output connected to `pipe`. Returns 0 or an errno value.
int spawn(const std::vector<std::string>& words, int pipe, pid_t& child) {
    const std::vector<char*> arguments = argument_pointers(words);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, pipe, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = ::posix_spawn(&child, k_this_program, &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

std::string read_all(int pipe) {
    std::string text;
    std::array<char, 4096> piece{};
    for (ssize_t count = 0; (count = ::read(pipe, piece.data(), piece.size())) != 0;) {
        if (count > 0)
            text.append(piece.data(), size_t(count));
        else if (errno != EINTR)
            break;
    }
    return text;
}

} // namespace

Error origin_of(const std::string& json) {
    const auto report = parse_or_discard(json);
    if (!report.is_object())
        return {ErrorCode::check_failed, "the trace ended without a result: run check --trace to see why"};
    if (const auto ended = report.value("ended", ""); !ended.empty())
        return {ErrorCode::check_failed, "no origin was found: " + ended};
    const auto trace = report.value("trace", Json());
    if (!trace.is_object())
        return {ErrorCode::check_failed, "no origin was found: drawn again, the pixel is finite"};
    const auto fix = trace.value("fix", Json());
    const auto origin = fix.is_object() ? fix : trace.value("first", Json());
    if (!origin.is_object())
        return {ErrorCode::check_failed, "no operation of the shown pass made it: it was read from an input"};
    Error error{ErrorCode::check_failed, ""};
    error.diagnostics.push_back(
        {{origin.value("file", ""), origin.value("line", 0), origin.value("column", 0)},
         Severity::error,
         fmt::format("`{}` gave {}: {}", origin.value("statement", ""), origin.value("value", ""),
                     origin.value("reason", ""))});
    return error;
}

Result<std::unique_ptr<OriginSearch>> OriginSearch::start(const std::vector<std::string>& words,
                                                          std::function<void()> wake) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        return fail(ErrorCode::write, fmt::format("cannot start the trace: {}", std::strerror(errno)));
    pid_t child = 0;
    const int error = spawn(words, ends[1], child);
    ::close(ends[1]);
    if (error != 0) {
        ::close(ends[0]);
        return fail(ErrorCode::write, fmt::format("cannot start the trace: {}", std::strerror(error)));
    }
    return std::unique_ptr<OriginSearch>(new OriginSearch(child, ends[0], std::move(wake)));
}

OriginSearch::OriginSearch(int process, int pipe, std::function<void()> wake)
    : process_(process), reader_([this, pipe, wake = std::move(wake)] {
          printed_ = read_all(pipe);
          ::close(pipe);
          done_ = true;
          wake();
      }) {}

OriginSearch::~OriginSearch() {
    ::kill(process_, SIGKILL); // its children end with it
    reader_.join();
    ::waitpid(process_, nullptr, 0);
}

std::optional<std::string> OriginSearch::take() {
    return done_ ? std::optional(std::move(printed_)) : std::nullopt;
}

// Inspecting the picture: the pictures of passes and inputs, the magnifier, marks of pixels that are not
// finite or below zero, and the origin of such pixels.

void Viewer::toggle_magnifier() {
    magnifier_.toggle();
    forget_looking();
    stale_overlay_ = true;
}

void Viewer::toggle_marks() {
    marks_shown_ = !marks_shown_;
    if (marks_shown_ && drawing_would_hold())
        say("marks are off while a frame takes more than a second");
    forget_looking();
    stale_overlay_ = true;
}

render::ShownFloats& Viewer::floats() {
    if (!floats_)
        floats_.emplace();
    return *floats_;
}

std::optional<live::MagnifierField> Viewer::magnifier_field() {
    if (!magnifier_.is_open() || !stage_ || stepping_ || frozen_)
        return std::nullopt;
    return magnifier_.field(stage_->renderer(), inputs_on_show(), screen_->extent(), floats());
}

/// Returns the texture that the marks are drawn from, after drawing Image once more as a whole; null: no
/// marks.
const gl::Texture* Viewer::marked_picture() {
    if (!marks_shown_ || !stage_ || stepping_ || frozen_ || making_ || drawing_would_hold() ||
        stage_->renderer().target().texture.target != GL_TEXTURE_2D)
        return nullptr;
    if (!marks_) {
        auto made = render::NumberMarks::create();
        if (!made) {
            marks_shown_ = false;
            say(to_string(made.error()));
            return nullptr;
        }
        marks_.emplace(*std::move(made));
    }
    const render::Renderer& renderer = stage_->renderer();
    return &floats().draw(renderer, inputs_on_show(), {0, 0, renderer.target().extent()});
}

void Viewer::look_at_pictures(live::Model& model) {
    if (!pictures_)
        pictures_.emplace();
    PictureViews::Large large{large_, look_, screen_->extent()};
    model.pictures = pictures_->fields(stage_->renderer(), costs_, large, floats(), inputs_on_show());
    if (large_ && *large_ < model.pictures.size())
        model.large = large_;
    model.look = large.look;
}

/// Deletes objects that live in the Stage's context.
void Viewer::forget_looking() {
    pictures_.reset();
    floats_.reset();
    marks_.reset();
}

/// Traces the NaN of the magnified pixel; a second press hides the result.
void Viewer::trace_pixel() {
    if (!magnifier_.is_open() || !stage_ || frozen_)
        return;
    if (origin_.show(nullptr) || search_) {
        search_.reset();
        stale_overlay_ = true;
        return;
    }
    const Rectangle pixel = magnifier_.pixel(stage_->renderer().target().extent(), screen_->extent());
    std::vector<std::string> words = trace_words();
    words.insert(words.end(), {"--pixel", fmt::format("{},{}", pixel.x, pixel.y), "--json"});
    auto started = OriginSearch::start(words, [&on = *screen_] { on.wake(); });
    if (!started)
        return say(to_string(started.error()));
    search_ = *std::move(started);
    say(fmt::format("tracing pixel {},{}; press Enter to cancel", pixel.x, pixel.y));
}

void Viewer::take_origin() {
    const auto printed = search_ ? search_->take() : std::nullopt;
    if (!printed)
        return;
    search_.reset();
    const Error error = origin_of(*printed);
    stale_overlay_ |= origin_.show(&error);
    say(to_string(error));
}

} // namespace tidemark::cli
