#include "window/recorder.hpp"

#include "host/console.hpp"
#include "window/screen.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace tidemark::window {

using namespace host;

namespace {

/// Frames that may wait for the encoder.
constexpr size_t k_most_waiting = 8;

} // namespace

VideoRecording::VideoRecording(std::filesystem::path name, Extent extent, double fps, double now)
    : name_(std::move(name)), extent_(extent), fps_(fps), begun_(now) {}

Result<std::unique_ptr<VideoRecording>> VideoRecording::start(const std::filesystem::path& name,
                                                              Extent extent, double fps, double now,
                                                              const std::function<void()>& wake) {
    std::unique_ptr<VideoRecording> video(new VideoRecording(name, extent, fps, now));
    const OutputPath segment =
        OutputPath(name).beside(fmt::format(".part{}", image::segment_extension(name)));
    auto writer = TRY(image::SegmentWriter::create(segment, name, {extent, fps}));
    video->thread_ = std::jthread([&video = *video, writer = std::move(writer), segment, wake]() mutable {
        video.encode(std::move(writer), segment);
        video.done_ = true;
        wake();
    });
    return video;
}

VideoRecording::~VideoRecording() {
    if (!stopped_)
        stop(begun_ + next_ / fps_);
}

void VideoRecording::wait() {
    thread_.join();
}

int VideoRecording::number_at(double now) const {
    return int(std::floor((now - begun_) * fps_));
}

bool VideoRecording::wants(double now) const {
    return !stopped_ && number_at(now) >= next_;
}

void VideoRecording::show(image::Image picture, double now) {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= k_most_waiting) {
        ++dropped_;
        return;
    }
    const int number = next_ == 0 ? 0 : number_at(now);
    next_ = number_at(now) + 1;
    waiting_.push_back({std::make_shared<const image::Image>(std::move(picture)), number});
    changed_.notify_one();
}

void VideoRecording::stop(double now) {
    const std::lock_guard lock(mutex_);
    end_ = std::max(number_at(now), next_);
    stopped_ = true;
    changed_.notify_one();
}

void VideoRecording::encode(image::SegmentWriter writer, const OutputPath& segment) {
    auto written = write_frames(writer);
    if (written && *written == 0)
        written = fail(ErrorCode::write, "no frame was shown while it was recorded");
    if (written)
        if (auto finished = writer.finish(""); !finished)
            written = fail(std::move(finished.error()));
    if (written) {
        const image::SegmentFile file{segment.path(), size_t(*written)};
        if (auto joined = image::join_segments(OutputPath(name_), {&file, 1}, {extent_, fps_}, {}); !joined)
            written = fail(std::move(joined.error()));
    }
    std::error_code ignored;
    std::filesystem::remove(segment.path(), ignored);
    written_ = std::move(written);
}

/// Writes each frame as often as the time until the next one takes. Returns their number.
Result<int> VideoRecording::write_frames(image::SegmentWriter& writer) {
    std::shared_ptr<const image::Image> shown;
    int written = 0;
    while (true) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return stopped_ || !waiting_.empty(); });
        const bool last = waiting_.empty();
        const Frame next = last ? Frame{nullptr, end_} : waiting_.front();
        if (!last)
            waiting_.pop_front();
        lock.unlock();
        for (; shown && written < next.first; ++written)
            TRY(writer.push(*shown));
        if (last)
            return written;
        shown = next.picture;
    }
}

std::string VideoRecording::report() const {
    if (!written_)
        return to_string(written_.error());
    return fmt::format("recorded {}: {:.1f} s, {}x{}, without sound{}", name_.string(), *written_ / fps_,
                       extent_.width, extent_.height,
                       dropped_ > 0
                           ? fmt::format("; {} frames were left out because the encoder was behind", dropped_)
                           : "");
}

Recorder::Recorder(OutputPath file, std::optional<InputScript> script, const render::OrbitCamera& camera)
    : mode_(script         ? Mode::replaying
            : file.empty() ? Mode::live
                           : Mode::recording),
      file_(std::move(file)) {
    if (mode_ != Mode::live)
        replay_.emplace(std::move(script).value_or(InputScript{}), camera);
}

void Recorder::note(int frame, const ControlEvent& event) {
    if (mode_ == Mode::recording)
        replay_->note(frame, event);
}

void Recorder::go_back(int frame) {
    if (mode_ == Mode::recording)
        replay_->go_back(frame);
}

void Recorder::fill(render::FrameState& state, const Controls& controls) {
    if (replay_)
        replay_->fill(state);
    else
        controls.fill(state);
}

std::function<void(render::FrameState& state)> Recorder::filler() const {
    return [replay = replay_](render::FrameState& state) mutable {
        if (replay)
            replay->fill(state);
    };
}

Result<std::string> Recorder::save(KeptPicture picture, const std::filesystem::path& scene,
                                   const std::vector<std::filesystem::path>& spared) {
    if (!writer_)
        writer_ = std::make_unique<FrameWriter>(1U);
    std::string name = free_name(scene, fmt::format("-{:05}.png", picture.frame));
    if (!writer_->push({picture.frame, OutputPath(name).sparing(spared), std::move(picture.pixels),
                        std::move(picture.format)}))
        TRY(std::exchange(writer_, nullptr)->finish());
    return name;
}

std::string Recorder::free_name(const std::filesystem::path& scene, std::string_view ending) {
    std::string name = name_after_scene(scene, ending);
    const auto taken = [&] {
        std::error_code ignored;
        return saved_.contains(name) || exists(std::filesystem::symlink_status(name, ignored));
    };
    const size_t dot = ending.rfind('.');
    for (int number = 2; taken(); ++number)
        name = name_after_scene(scene,
                                fmt::format("{}-{}{}", ending.substr(0, dot), number, ending.substr(dot)));
    saved_.insert(name);
    return name;
}

Result<void> Recorder::start_video(const std::filesystem::path& scene, Extent extent, double fps, double now,
                                   const std::function<void()>& wake) {
    video_ = TRY(VideoRecording::start(free_name(scene, ".mp4"), extent, fps, now, wake));
    return {};
}

Result<void> Recorder::finish(const std::vector<std::filesystem::path>& spared) {
    if (mode_ == Mode::recording)
        TRY(write_file(file_.sparing(spared), to_string(replay_->script())));
    if (video_) { // its file is completed
        if (!video_->stopped())
            video_->stop(now_seconds());
        video_->wait();
        say(std::exchange(video_, nullptr)->report());
    }
    return writer_ ? writer_->finish() : Result<void>();
}

} // namespace tidemark::window
