// Resolves an input of ShaderToy's JSON to a Channel: its kind, its file or substitute, its sampler.
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

/// Reads the inputs of one project. Checks which media files exist; opens none.
class InputReader {
public:
    /// The names that an input can refer to.
    struct Context {
        const Project& project;
        const std::vector<std::string>& names; ///< names of its passes (pass_names)
        std::filesystem::path folder;          ///< the project's own files are relative to it
        const MediaFolder& media;
        const Bounds& bounds;
        std::string file; ///< the JSON, for messages
    };
    explicit InputReader(Context context) : context_(std::move(context)) {}

    /// PassOutput::pass is an index into the project's passes. Fails only on a file out of bounds.
    Result<Channel> read(const ProjectInput& input);

    /// Returns one warning for each missing file or live input.
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
    std::set<std::string> warned_; ///< sources and ids already warned of
};

} // namespace tidemark::scene
