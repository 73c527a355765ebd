#include "window/recorder.hpp"

#include <fmt/format.h>

#include <utility>

namespace tidemark::cli {

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
    std::string name = free_name(scene, picture.frame);
    if (!writer_->push({picture.frame, OutputPath(name).sparing(spared), std::move(picture.pixels),
                        std::move(picture.format)}))
        TRY(std::exchange(writer_, nullptr)->finish());
    return name;
}

/// Returns a name that neither a file nor a picture still to be written has.
std::string Recorder::free_name(const std::filesystem::path& scene, int frame) {
    std::string name = name_after_scene(scene, fmt::format("-{:05}.png", frame));
    const auto taken = [&] {
        std::error_code ignored;
        return saved_.contains(name) || exists(std::filesystem::symlink_status(name, ignored));
    };
    for (int number = 2; taken(); ++number)
        name = name_after_scene(scene, fmt::format("-{:05}-{}.png", frame, number));
    saved_.insert(name);
    return name;
}

Result<void> Recorder::finish(const std::vector<std::filesystem::path>& spared) {
    if (mode_ == Mode::recording)
        TRY(write_file(file_.sparing(spared), to_string(replay_->script())));
    return writer_ ? writer_->finish() : Result<void>();
}

} // namespace tidemark::cli
