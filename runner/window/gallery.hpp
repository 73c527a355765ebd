// Scenes to choose from: a folder of them, or several files. Draws a thumbnail of each in a process of its
// own, one after the other, so that a slow or broken scene affects no other.
#pragma once

#include "base/error.hpp"
#include "base/process.hpp"
#include "host/overlay_model.hpp"
#include "host/supervision.hpp"
#include "media/image.hpp"
#include "window/overlay.hpp"
#include "window/screen.hpp"

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tidemark::window {

class Gallery {
public:
    /// `options`: for drawing thumbnails, as for `capture`.
    Gallery(std::vector<std::filesystem::path> scenes, std::vector<std::string> options);
    ~Gallery();
    Gallery(const Gallery&) = delete;
    Gallery& operator=(const Gallery&) = delete;

    size_t size() const { return entries_.size(); }
    /// Returns the scene that is selected.
    const std::filesystem::path& selected() const { return entries_[selected_].scene; }
    /// Selects another scene, so many further, from the end to the begin.
    void move(int steps);
    /// Adds scenes that it does not have, and selects the first of `scenes`.
    void add(const std::vector<std::filesystem::path>& scenes);

    /// Shows the scenes until the user opens one, which is then selected. Returns false if the user closes
    /// the screen, or an interrupt is requested.
    Result<bool> run(Screen& screen, const host::Interrupt& interrupt);

private:
    struct Entry {
        std::filesystem::path scene;
        image::Image picture{}; ///< without pixels: none yet
        std::string error{};    ///< why there is none
    };
    /// A thumbnail in progress.
    struct Drawing {
        size_t index;
        ChildProcess child;
        std::vector<std::byte> bytes{};
        std::string words{}; ///< of standard error
        Result<void> ended{};
        std::atomic<bool> done = false;
        std::jthread thread{};
    };
    enum class Outcome { none, opened, closed };

    void draw_next(Screen& screen);
    void stop_drawing();
    bool take_drawn();
    Outcome handle(const host::InputEvent& event, Screen& screen, double now);
    Outcome press(host::Key key, bool control, Screen& screen, double now);
    overlay::Model model(double now);

    std::vector<Entry> entries_;
    std::vector<std::string> options_;
    size_t selected_ = 0;
    size_t columns_ = 1;
    Messages messages_;
    double escaped_at_;
    bool control_ = false;
    std::vector<std::optional<gl::Texture>> textures_;
    std::unique_ptr<Drawing> drawing_; ///< null: none in progress
};

} // namespace tidemark::window
