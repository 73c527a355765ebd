// The files that a window makes: a recording of the user's input, and pictures that the user saves.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "host/frame_files.hpp"
#include "host/input_script.hpp"
#include "media/image.hpp"
#include "media/picture_file.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tidemark::cli {

/// A picture to be saved, with the metadata that reproduces it.
struct KeptPicture {
    int frame = 0;
    image::Image pixels;
    image::PictureFormat format;
};

class Recorder {
public:
    /// The source of the scene's input: the user, the recording in progress (so that a replay shows the same
    /// pictures), or a given recording.
    enum class Mode { live, recording, replaying };

    /// `file`: for the user's input; empty: it is not recorded. `script`: to be replayed; excludes `file`.
    Recorder(OutputPath file, std::optional<InputScript> script, const render::OrbitCamera& camera);

    Mode mode() const { return mode_; }
    const OutputPath& file() const { return file_; }

    /// Records an event that happens before `frame`.
    void note(int frame, const ControlEvent& event);
    /// Removes the recorded events after `frame`, the next one to be drawn, because time went back.
    void go_back(int frame);
    /// Sets mouse, keyboard, camera and knobs of a frame, from `controls` or from the recording.
    void fill(render::FrameState& state, const Controls& controls);
    /// Returns a function that sets them from the recording, for frames in any order; in Mode::live it keeps
    /// the state's own.
    std::function<void(render::FrameState& state)> filler() const;
    bool turns_knobs() const { return replay_ && cli::turns_knobs(replay_->script()); }

    /// Starts to write a picture as SCENE-FRAME.png, or as SCENE-FRAME-2.png and so on where that exists;
    /// returns its name. `spared`: files that it must not replace. Fails where an earlier picture could not
    /// be written.
    Result<std::string> save(KeptPicture picture, const std::filesystem::path& scene,
                             const std::vector<std::filesystem::path>& spared);
    /// Requests to save the next frame.
    void save_next() { save_next_ = true; }
    /// Returns whether that was requested, once.
    bool take_save() { return std::exchange(save_next_, false); }

    /// Writes the recording and all pictures. The recording must not replace `spared`.
    Result<void> finish(const std::vector<std::filesystem::path>& spared);

private:
    std::string free_name(const std::filesystem::path& scene, int frame);

    Mode mode_;
    OutputPath file_;
    std::optional<Replay> replay_;        ///< none in Mode::live
    std::unique_ptr<FrameWriter> writer_; ///< created by the first saved picture
    std::set<std::string> saved_;         ///< names of pictures, some of which are not written yet
    bool save_next_ = false;
};

} // namespace tidemark::cli
