#include "window/gallery.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "scene/load_scene.hpp"
#include "scene/names.hpp"
#include "window/picture_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace tidemark::window {

using namespace host;
namespace {

namespace fs = std::filesystem;
using host::Key;

constexpr Extent k_thumbnail{192, 108};
constexpr std::chrono::seconds k_longest_drawing{20};
/// Esc closes the window when it is pressed again within this time.
constexpr double k_second_escape_seconds = 1;

/// Returns the most telling line of a failed capture's messages: the first error with a place, without the
/// folder; else the first error.
std::string error_in(const std::string& words, const fs::path& scene) {
    constexpr std::string_view k_error = "error: ", k_program = "tidemark: error: ";
    const std::string folder = scene.has_parent_path() ? (scene.parent_path() / "").string() : "";
    std::string last, first;
    for (size_t begin = 0; begin < words.size();) {
        const size_t end = std::min(words.find('\n', begin), words.size());
        std::string line = words.substr(begin, end - begin);
        begin = end + 1;
        if (line.starts_with(k_program)) {
            if (first.empty())
                first = line.substr(k_program.size());
        } else if (line.find(k_error) != std::string::npos) {
            return line.starts_with(folder) ? line.substr(folder.size()) : line;
        } else if (!line.empty()) {
            last = std::move(line);
        }
    }
    return !first.empty() ? first : !last.empty() ? last : "it cannot be drawn";
}

} // namespace

Gallery::Gallery(std::vector<fs::path> scenes, std::vector<std::string> options)
    : options_(std::move(options)), escaped_at_(-std::numeric_limits<double>::infinity()) {
    for (fs::path& scene : scenes)
        entries_.push_back({std::move(scene)});
}

Gallery::~Gallery() {
    stop_drawing();
}

void Gallery::stop_drawing() {
    if (drawing_)
        drawing_->child.stop();
    drawing_.reset();
}

void Gallery::move(int steps) {
    const auto count = std::ptrdiff_t(entries_.size());
    selected_ = size_t((std::ptrdiff_t(selected_) + steps % count + count) % count);
}

void Gallery::add(const std::vector<fs::path>& scenes) {
    for (const fs::path& scene : scenes)
        if (std::ranges::find(entries_, scene, &Entry::scene) == entries_.end())
            entries_.push_back({scene});
    const auto first = std::ranges::find(entries_, scenes.front(), &Entry::scene);
    selected_ = size_t(first - entries_.begin());
}

/// Starts to draw the next thumbnail, in a process that ends by itself if the scene takes too long.
void Gallery::draw_next(Screen& screen) {
    const auto next = std::ranges::find_if(entries_, [](const Entry& entry) {
        return entry.picture.extent.pixels() == 0 && entry.error.empty();
    });
    if (drawing_ || next == entries_.end())
        return;
    std::vector<std::string> words{"/proc/self/exe", "capture", file_word(next->scene)};
    words.insert(words.end(), options_.begin(), options_.end());
    for (const char* word : {"--time", "1", "--fps", "30", "--timeout", "10", "-o", "-"})
        words.emplace_back(word);
    words.insert(words.end(), {"--size", scene::to_string(k_thumbnail)});
    auto child = ChildProcess::start(words, ChildProcess::Input::none, "");
    if (!child) {
        next->error = child.error().message;
        return;
    }
    drawing_ = std::unique_ptr<Drawing>(new Drawing{size_t(next - entries_.begin()), *std::move(child)});
    drawing_->thread = std::jthread([&drawing = *drawing_, &screen] {
        const auto until = ChildProcess::Clock::now() + k_longest_drawing;
        drawing.bytes.resize(k_thumbnail.pixels() * 3 + 1);
        size_t filled = 0;
        while (true) {
            const auto count =
                drawing.child.read(std::span(drawing.bytes).subspan(filled), drawing.words, until);
            if (!count)
                drawing.ended = fail(count.error());
            if (!count || *count == 0 || (filled += *count) == drawing.bytes.size())
                break;
        }
        drawing.bytes.resize(filled);
        drawing.child.read_words(drawing.words);
        drawing.done = true;
        screen.wake();
    });
}

/// Takes a thumbnail that is drawn. Returns whether there was one.
bool Gallery::take_drawn() {
    if (!drawing_ || !drawing_->done)
        return false;
    drawing_->thread.join();
    drawing_->child.stop();
    Entry& entry = entries_[drawing_->index];
    if (drawing_->bytes.size() == k_thumbnail.pixels() * 3)
        entry.picture = flipped(image::Image(k_thumbnail, 3, image::SampleType::u8, drawing_->bytes));
    else
        entry.error = drawing_->ended
                          ? error_in(drawing_->words, entry.scene)
                          : fmt::format("it takes more than {} s to draw", k_longest_drawing.count());
    drawing_.reset();
    return true;
}

overlay::Model Gallery::model(double now) {
    overlay::Model model;
    textures_.resize(entries_.size());
    for (size_t i = 0; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        if (!textures_[i] && entry.picture.extent.pixels() > 0)
            textures_[i] = texture_of(entry.picture);
        fs::path named = entry.scene.lexically_normal();
        if (!named.has_filename())
            named = named.parent_path();
        model.gallery.push_back({named.filename().string(), entry.error,
                                 textures_[i] ? textures_[i]->id() : 0U, entry.picture.extent});
    }
    model.selected = selected_;
    model.messages = messages_.fields(now);
    return model;
}

Gallery::Outcome Gallery::press(Key key, bool control, Screen& screen, double now) {
    const auto last = int(entries_.size()) - 1;
    const auto step = [&](int steps) {
        selected_ = size_t(std::clamp(int(selected_) + steps, 0, last));
        return Outcome::none;
    };
    switch (key) {
    case Key::left: return step(-1);
    case Key::right: return step(1);
    case Key::up: return step(-int(columns_));
    case Key::down: return step(int(columns_));
    case Key::page_up: return step(-3 * int(columns_));
    case Key::page_down: return step(3 * int(columns_));
    case Key::home: return step(-last);
    case Key::end: return step(last);
    case Key::enter: return Outcome::opened;
    case Key::f: screen.toggle_full_screen(); return Outcome::none;
    case Key::escape:
        if (screen.is_full_screen()) {
            screen.toggle_full_screen();
            return Outcome::none;
        }
        if (now - std::exchange(escaped_at_, now) <= k_second_escape_seconds)
            return Outcome::closed;
        messages_.tell("quit", "Esc again, or Ctrl+Q, closes the window", now, k_second_escape_seconds);
        return Outcome::none;
    default: return control && key == Key('Q') ? Outcome::closed : Outcome::none;
    }
}

Gallery::Outcome Gallery::handle(const host::InputEvent& event, Screen& screen, double now) {
    if (const auto* dropped = std::get_if<host::FilesDropped>(&event)) {
        std::vector<fs::path> scenes;
        for (const std::string& path : dropped->paths)
            if (scene::is_scene_file(path))
                scenes.emplace_back(path);
        if (scenes = scene::scenes_of(scenes); !scenes.empty())
            add(scenes);
        else
            messages_.tell("dropped", "open a scene first: it can read the file", now);
        return Outcome::none;
    }
    if (const auto* released = std::get_if<host::KeyReleased>(&event))
        control_ = control_ && released->key != Key::control;
    const auto* pressed = std::get_if<host::KeyPressed>(&event);
    if (!pressed)
        return std::holds_alternative<host::CloseRequested>(event) ? Outcome::closed : Outcome::none;
    control_ = control_ || pressed->key == Key::control;
    return press(pressed->key, control_, screen, now);
}

Result<bool> Gallery::run(Screen& screen, const Interrupt& interrupt) {
    constexpr double k_until_an_event = 10;
    screen.enter();
    screen.set_title(fmt::format("{} scenes - tidemark", entries_.size()));
    textures_.clear();
    control_ = false;
    bool changed = true;
    Outcome outcome = Outcome::none;
    while (outcome == Outcome::none && !interrupt.requested()) {
        changed |= take_drawn();
        draw_next(screen);
        const double now = now_seconds();
        if (messages_.take_due(now) || screen.wants_frame() || std::exchange(changed, false)) {
            screen.begin(nullptr, true);
            if (auto shown = screen.finish(model(now), {}); !shown) {
                stop_drawing();
                return fail(std::move(shown.error()));
            }
        }
        const double wait =
            screen.wants_frame() ? 1 / 60.0 : std::min(k_until_an_event, messages_.due() - now);
        for (const host::InputEvent& event : screen.wait(std::max(wait, 0.0))) {
            const bool taken = screen.take(event);
            if (const Outcome happened = taken ? Outcome::none : handle(event, screen, now_seconds());
                outcome == Outcome::none)
                outcome = happened;
            changed = true;
        }
        for (const overlay::Command& command : screen.take_commands())
            if (const auto* opened = std::get_if<overlay::OpenScene>(&command)) {
                selected_ = std::min(opened->index, entries_.size() - 1);
                outcome = Outcome::opened;
            } else if (const auto* columns = std::get_if<overlay::GalleryColumns>(&command)) {
                columns_ = std::max<size_t>(columns->count, 1);
            }
    }
    textures_.clear();
    stop_drawing(); // it is started again if the user comes back
    return outcome == Outcome::opened;
}

} // namespace tidemark::window
