// The files that a window makes: a recording of the user's input, and pictures that the user saves.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "host/frame_files.hpp"
#include "host/input_script.hpp"
#include "media/image.hpp"
#include "media/picture_file.hpp"
#include "media/video_output.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace tidemark::window {

/// A picture to be saved, with the metadata that reproduces it.
struct KeptPicture {
    int frame = 0;
    image::Image pixels;
    image::PictureFormat format;
};

/// A video of what is shown, which a thread encodes while frames are drawn: each shown frame fills the time
/// until the next one. Frames are left out, and counted, while the encoder is too slow.
class VideoRecording {
public:
    /// Starts to encode. `name`: of the file, which must not exist. `wake` is called on the thread when it is
    /// done. Fails without ffmpeg.
    static Result<std::unique_ptr<VideoRecording>> start(const std::filesystem::path& name, Extent extent,
                                                         double fps, double now,
                                                         const std::function<void()>& wake);
    ~VideoRecording();
    VideoRecording(const VideoRecording&) = delete;
    VideoRecording& operator=(const VideoRecording&) = delete;

    /// Returns whether a frame that is shown at that time begins a frame of the video.
    bool wants(double now) const;
    void show(image::Image picture, double now);
    /// Ends the video at that time.
    void stop(double now);
    bool stopped() const { return stopped_; }
    /// Returns whether the file is complete, or has failed.
    bool done() const { return done_; }
    /// Waits for that, after `stop`.
    void wait();
    /// Returns a line about the file, after `done`.
    std::string report() const;

    const std::filesystem::path& name() const { return name_; }
    Extent extent() const { return extent_; }
    size_t dropped() const { return dropped_; }
    double seconds(double now) const { return now - begun_; }

private:
    struct Frame {
        std::shared_ptr<const image::Image> picture;
        int first = 0; ///< number of the frame in the video that it begins
    };
    VideoRecording(std::filesystem::path name, Extent extent, double fps, double now);
    int number_at(double now) const;
    void encode(image::SegmentWriter writer, const OutputPath& segment);
    Result<int> write_frames(image::SegmentWriter& writer);

    std::filesystem::path name_;
    Extent extent_;
    double fps_;
    double begun_;
    int next_ = 0; ///< number of the frame in the video that the next shown one begins at the earliest
    size_t dropped_ = 0;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Frame> waiting_;
    int end_ = 0; ///< number of frames in the video, once it is stopped
    bool stopped_ = false;
    std::atomic<bool> done_ = false;
    Result<int> written_ = 0; ///< frames in the file; valid after `done_`
    std::jthread thread_;
};

class Recorder {
public:
    /// The source of the scene's input: the user, the recording in progress (so that a replay shows the same
    /// pictures), or a given recording.
    enum class Mode { live, recording, replaying };

    /// `file`: for the user's input; empty: it is not recorded. `script`: to be replayed; excludes `file`.
    Recorder(OutputPath file, std::optional<host::InputScript> script, const render::OrbitCamera& camera);

    Mode mode() const { return mode_; }
    const OutputPath& file() const { return file_; }

    /// Records an event that happens before `frame`.
    void note(int frame, const host::ControlEvent& event);
    /// Removes the recorded events after `frame`, the next one to be drawn, because time went back.
    void go_back(int frame);
    /// Sets mouse, keyboard, camera and knobs of a frame, from `controls` or from the recording.
    void fill(render::FrameState& state, const host::Controls& controls);
    /// Returns a function that sets them from the recording, for frames in any order; in Mode::live it keeps
    /// the state's own.
    std::function<void(render::FrameState& state)> filler() const;
    bool turns_knobs() const { return replay_ && host::turns_knobs(replay_->script()); }

    /// Starts to write a picture as SCENE-FRAME.png, or as SCENE-FRAME-2.png and so on where that exists;
    /// returns its name. `spared`: files that it must not replace. Fails where an earlier picture could not
    /// be written.
    Result<std::string> save(KeptPicture picture, const std::filesystem::path& scene,
                             const std::vector<std::filesystem::path>& spared);
    /// Returns a name with that ending, as in SCENE-2.mp4, that no file has and no picture gets.
    std::string free_name(const std::filesystem::path& scene, std::string_view ending);

    // A video of what is shown

    /// Starts a video of that size as SCENE.mp4, numbered. Fails without ffmpeg.
    Result<void> start_video(const std::filesystem::path& scene, Extent extent, double fps, double now,
                             const std::function<void()>& wake);
    /// Returns the video in progress, also while its file is being completed; null: none.
    VideoRecording* video() { return video_.get(); }
    const VideoRecording* video() const { return video_.get(); }
    void end_video() { video_.reset(); }

    /// Requests to save the next frame.
    void save_next() { save_next_ = true; }
    /// Returns whether that was requested, once.
    bool take_save() { return std::exchange(save_next_, false); }

    /// Writes the recording and all pictures. The recording must not replace `spared`.
    Result<void> finish(const std::vector<std::filesystem::path>& spared);

private:
    Mode mode_;
    OutputPath file_;
    std::optional<host::Replay> replay_;        ///< none in Mode::live
    std::unique_ptr<host::FrameWriter> writer_; ///< created by the first saved picture
    std::set<std::string> saved_;               ///< names of pictures, some of which are not written yet
    bool save_next_ = false;
    std::unique_ptr<VideoRecording> video_;
};

} // namespace tidemark::window
