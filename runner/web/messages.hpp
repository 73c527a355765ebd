// Messages to browsers: JSON for the panels, and encoded pictures.
//
// JSON for the page's panels: the overlay's model without the values that change with every picture.
#pragma once

#include "base/extent.hpp"
#include "host/overlay_model.hpp"
#include "media/image.hpp"
#include "web/audience.hpp"

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tidemark::web {

/// The input that the scene on show reads.
struct SceneInput {
    bool keyboard = false;   ///< all keys: the scene reads the keyboard
    bool every_move = false; ///< moves without a button too: the mouse follows the pointer
    bool camera = false;     ///< drags turn the orbit camera
};

/// Returns `{"state":{…}}`.
std::string state_text(const overlay::Model& model, Extent extent, SceneInput input);

/// Data sent before a picture in its message.
struct PictureHead {
    uint32_t number = 0; ///< from 1
    double seconds = 0;  ///< iTime
    int frame = 0;
    std::vector<std::optional<double>> costs{}; ///< milliseconds per pass, measured by the driver
    double draw_ms = 0; ///< milliseconds from the event that caused it, if there was one, to its pixels
    double encode_ms = 0;
};
std::string to_text(const PictureHead& head);

/// Returns a message with one line of text: `{"title":"…"}`.
std::string line_text(const char* name, const std::string& line);

// Encodes pictures for sending on a thread of its own, the newest first, so that drawing does not wait.

class PictureEncoder {
public:
    struct Job {
        image::Image picture; ///< RGBA, 8 bits per channel
        PictureHead head;
    };
    /// Callbacks, all called on the encoder's thread.
    struct Settings {
        std::function<std::string(const image::Image&)> encode; ///< returns a file; empty: encoding failed
        std::function<void(NumberedPicture)> done;
    };

    explicit PictureEncoder(Settings settings);
    PictureEncoder(const PictureEncoder&) = delete;
    PictureEncoder& operator=(const PictureEncoder&) = delete;
    ~PictureEncoder();

    /// Queues a picture; replaces one that is still waiting.
    void push(Job job);
    /// Returns whether no picture is waiting.
    bool has_room() const;

private:
    void run();
    NumberedPicture encoded(Job job) const;

    Settings settings_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> waiting_;
    bool ending_ = false;
    std::thread thread_;
};

/// Returns one message: the head's length in four bytes, lowest first, the head as JSON, the file.
SharedMessage picture_message(const PictureHead& head, const std::string& file);

} // namespace tidemark::web
