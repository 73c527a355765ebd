// How a frame was drawn, in a few short hashes: the texts of the scene, the bytes of its inputs, its knobs,
// the state of the frame, how it is drawn and by what. Two frames with one fingerprint are the same picture;
// where two differ, the parts say in what.
#pragma once

#include "cli/json_dump.hpp"
#include "cli/requests.hpp"
#include "gl/capabilities.hpp"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::cli {

class Fingerprint {
public:
    /// Of a scene's texts and inputs, and of what draws them. Reads the files that the scene reads.
    static Fingerprint of_scene(const scene::Scene& scene, const std::vector<std::string>& defines,
                                const FrameSequence& frames, const gl::Capabilities& driver);
    /// And of something else that pictures depend on.
    void add(std::string part, const Json& facts);
    /// That of a frame of the run.
    Fingerprint of_frame(const render::FrameState& state) const;
    /// That of several, which are one file.
    Fingerprint of_frames(std::span<const render::FrameState> states) const;

    /// The parts of `of_scene` alone.
    Fingerprint of_scene() const;

    /// As in a picture's metadata: `text=0123456789abcdef inputs=…`.
    std::string text() const;
    static Fingerprint parse(std::string_view text);

    /// The names of the parts that are others, for people: "another text, other knobs"; empty: none is.
    std::string differences(const Fingerprint& other) const;

    /// The same, with the device of that one.
    Fingerprint on_device_of(const Fingerprint& other) const;

    /// The hash of the device alone; empty where there is none.
    std::string device() const;

    bool operator==(const Fingerprint&) const = default;

private:
    const std::string* find(std::string_view part) const;

    std::vector<std::pair<std::string, std::string>> parts_; ///< name, hash
};

} // namespace tidemark::cli
