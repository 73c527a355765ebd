// From an input as ShaderToy's JSON names it to a Channel: its kind, the file or the stand-in, the sampler.
#pragma once

#include "scene/bounds.hpp"
#include "scene/channel.hpp"
#include "scene/media.hpp"
#include "scene/project.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tidemark::scene {

/// Reads the inputs of one project. Looks which media files there are; opens none.
class InputReader {
public:
    /// What an input can mean in its project.
    struct Context {
        const Project& project;
        const std::vector<std::string>& names; ///< of its passes (pass_names)
        std::filesystem::path folder;          ///< files of the project's own are relative to it
        const MediaFolder& media;
        const Bounds& bounds;
        std::string file; ///< the JSON, for messages
    };
    explicit InputReader(Context context) : context_(std::move(context)) {}

    /// PassOutput::pass counts the project's passes. Fails only on a file out of bounds.
    Result<Channel> read(const ProjectInput& input);

    /// One for each file that is not here.
    std::vector<Diagnostic> take_warnings() { return std::move(warnings_); }

private:
    enum class Kind { none, picture, buffer, cubemap, volume, keyboard, music, microphone, video, webcam };

    static Kind kind_of(const ProjectInput& input);
    static const Media* media_of(const ProjectInput& input);
    static Sampling sampling_of(const ProjectInput& input, Kind kind);
    Result<ChannelInput> input_of(const ProjectInput& input, Kind kind);
    ChannelInput output_of(const ProjectInput& input) const;
    ChannelInput cube_output() const;
    Result<ChannelInput> media_input(const ProjectInput& input, MediaKind kind);
    Result<std::vector<std::filesystem::path>> files_of(const ProjectInput& input, MediaKind kind) const;
    ChannelInput live_input(const std::string& name, Substitute instead);
    ChannelInput instead_of(const ProjectInput& input, const Media* media, Substitute instead);

    Context context_;
    std::vector<Diagnostic> warnings_;
    std::set<std::string> warned_; ///< sources
};

} // namespace tidemark::scene
